#include "assets_baked/bake/grid_crossings.h"

#include "app/image/image.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen {

namespace {

/// A crossing flatter than this to its line says nothing of the surface's place: cosine.
constexpr double least_cosine = 0.12;
/// How much better another direction must see a crossing to take it: cosine.
constexpr double shared_cosine = 0.06;
/// Two crossings nearer than this are one, met in two triangles: texels.
constexpr float least_distance = 1e-4F;

int lines_for(double extent_box, double texel_box) {
    const int cells =
        static_cast<int>(std::ceil(extent_box / texel_box)) + 1; // half a cell of rim on either side
    return (cells + block_cells - 1) / block_cells * block_cells + 1;
}

ReliefGrid grid_of(const DirectionFrame& frame, const glm::dvec3& size, double texel_box) {
    ReliefGrid grid{{frame.axis_u, frame.axis_v, frame.axis_n}, static_cast<double>(frame.sign), {}};
    const glm::dvec3 low(-0.5 * size.x, -0.5 * size.y, 0.0);
    grid.origin_box = low - 0.5 * texel_box;
    grid.origin_box[frame.axis_n] = low[frame.axis_n] + (frame.sign > 0.0F ? 0.0 : size[frame.axis_n]);
    return grid;
}

std::vector<glm::vec3> normals_of(const std::vector<ReliefDirection>& directions) {
    std::vector<glm::vec3> normals;
    for (const ReliefDirection direction : directions) {
        normals.push_back(frame_of(direction).normal());
    }
    return normals;
}

glm::u8vec4 codes_of(const glm::vec4& linear) {
    return {srgb8_from_linear(static_cast<double>(linear.r)),
            srgb8_from_linear(static_cast<double>(linear.g)),
            srgb8_from_linear(static_cast<double>(linear.b)), 255};
}

class Lines {
public:
    Lines(const BlockInput& input, const GridCrossings& grid, const glm::vec3& outward)
        : input_(input), grid_(grid), outward_(outward), normals_(normals_of(input.directions)),
          texel_box_(1.0 / input.texels), top_(input.box_size[grid.grid.axis[2]] / texel_box_ + 4.0) {}

    void cross(int column, int row, std::vector<Crossing>& found) const {
        const glm::vec3 origin(grid_.box_from_grid(column, row, top_, texel_box_));
        const auto texel = static_cast<float>(texel_box_);
        float after = 0.0F;
        for (;;) {
            const SurfaceHit hit = input_.surface.trace(origin, -outward_, after);
            if (!hit.hit) {
                return;
            }
            after = hit.distance + least_distance * texel;
            const double cosine = static_cast<double>(glm::dot(hit.normal, outward_));
            if (cosine > least_cosine) {
                found.push_back(crossing(hit, cosine));
            }
        }
    }

private:
    [[nodiscard]] Crossing crossing(const SurfaceHit& hit, double cosine) const {
        double best = 0.0;
        for (const glm::vec3& normal : normals_) {
            best = std::max(best, static_cast<double>(glm::dot(hit.normal, normal)));
        }
        const ReliefGrid& grid = grid_.grid;
        return {static_cast<float>(top_ - static_cast<double>(hit.distance) / texel_box_),
                static_cast<float>(-static_cast<double>(hit.normal[grid.axis[0]]) / cosine),
                static_cast<float>(-static_cast<double>(hit.normal[grid.axis[1]]) / cosine),
                cosine >= best - shared_cosine, codes_of(input_.surface.colour(hit))};
    }

    const BlockInput& input_;
    const GridCrossings& grid_;
    glm::vec3 outward_;
    std::vector<glm::vec3> normals_;
    double texel_box_;
    double top_; ///< texels above the box's bottom, beyond all of it
};

} // namespace

GridCrossings cross_grid(const BlockInput& input, ReliefDirection direction) {
    const DirectionFrame frame = frame_of(direction);
    const double texel_box = 1.0 / input.texels;
    GridCrossings grid;
    grid.grid = grid_of(frame, input.box_size, texel_box);
    grid.columns = lines_for(input.box_size[frame.axis_u], texel_box);
    grid.rows = lines_for(input.box_size[frame.axis_v], texel_box);
    const Lines lines(input, grid, frame.normal());
    std::vector<std::vector<Crossing>> rows(static_cast<std::size_t>(grid.rows));
    grid.first.assign(static_cast<std::size_t>(grid.columns) * rows.size() + 1, 0);
    parallel_for(rows.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            for (int column = 0; column < grid.columns; ++column) {
                lines.cross(column, static_cast<int>(row), rows[row]);
                grid.first[grid.line(column, static_cast<int>(row)) + 1] =
                    static_cast<std::uint32_t>(rows[row].size());
            }
        }
    });
    std::uint32_t before = 0;
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            grid.first[grid.line(column, row) + 1] += before;
        }
        const std::vector<Crossing>& found = rows[static_cast<std::size_t>(row)];
        grid.crossings.insert(grid.crossings.end(), found.begin(), found.end());
        before = static_cast<std::uint32_t>(grid.crossings.size());
    }
    return grid;
}

} // namespace frustumscreen

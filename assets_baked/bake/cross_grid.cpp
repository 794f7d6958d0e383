#include "assets_baked/bake/cross_grid.h"

#include "app/image/image.h"
#include "assets_baked/bake/sheet_ends.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::bake {

namespace {

/// A crossing at a flatter angle to its line does not locate the surface: cosine.
constexpr double min_cosine = 0.12;
/// Difference in cosine by which another direction must see a crossing better to take it.
constexpr double shared_cosine = 0.06;
/// Two crossings nearer than this are one, hit in two triangles: texels.
constexpr float min_distance = 1e-4F;

int lines_for(double extent_box, double texel_box) {
    const int cells =
        static_cast<int>(std::ceil(extent_box / texel_box)) + 1; // half a cell of rim on either side
    return (cells + relief::block_cells - 1) / relief::block_cells * relief::block_cells + 1;
}

relief::ReliefGrid grid_of(const DirectionFrame& frame, const glm::dvec3& size, double texel_box) {
    relief::ReliefGrid grid{{frame.axis_u, frame.axis_v, frame.axis_n}, static_cast<double>(frame.sign), {}};
    const glm::dvec3 low(-0.5 * size.x, -0.5 * size.y, 0.0);
    grid.origin_box = low - 0.5 * texel_box;
    grid.origin_box[frame.axis_n] = low[frame.axis_n] + (frame.sign > 0.0F ? 0.0 : size[frame.axis_n]);
    return grid;
}

std::vector<glm::vec3> normals_of(const std::vector<pack::ReliefDirection>& directions) {
    std::vector<glm::vec3> normals;
    for (const pack::ReliefDirection direction : directions) {
        normals.push_back(frame_of(direction).normal());
    }
    return normals;
}

glm::u8vec4 codes_of(const glm::vec4& linear) {
    return {image::srgb8_from_linear(static_cast<double>(linear.r)),
            image::srgb8_from_linear(static_cast<double>(linear.g)),
            image::srgb8_from_linear(static_cast<double>(linear.b)), 255};
}

/// Follows the line at (u, v) from the top of the range to its bottom, and visits its crossings from the
/// front: the hit, its height and the cosine between its normal and the line.
template <typename Visit>
void follow_line(const BlockInput& input, const relief::ReliefGrid& grid, const glm::dvec2& at,
                 const glm::dvec2& range, const Visit& visit) {
    const double texel_box = 1.0 / input.texels;
    const glm::vec3 origin(relief::box_from_grid(grid, texel_box) * glm::dvec4(at, range.y, 1.0));
    glm::vec3 outward(0.0F);
    outward[grid.axis[2]] = static_cast<float>(grid.sign);
    const auto end = static_cast<float>((range.y - range.x) * texel_box);
    float after = 0.0F;
    for (;;) {
        const SurfaceHit hit = input.surface.trace(origin, -outward, after, end);
        if (!hit.hit) {
            return;
        }
        after = hit.distance + min_distance * static_cast<float>(texel_box);
        const double cosine = static_cast<double>(glm::dot(hit.normal, outward));
        if (cosine > min_cosine) {
            visit(hit, range.y - static_cast<double>(hit.distance) / texel_box, cosine);
        }
    }
}

relief::LineCrossing crossing_of(const relief::ReliefGrid& grid, const SurfaceHit& hit, double w,
                                 double cosine) {
    return {static_cast<float>(w),
            static_cast<float>(-static_cast<double>(hit.normal[grid.axis[0]]) / cosine),
            static_cast<float>(-static_cast<double>(hit.normal[grid.axis[1]]) / cosine)};
}

/// True if no direction of `normals` sees the hit clearly better.
bool is_own(const std::vector<glm::vec3>& normals, const SurfaceHit& hit, double cosine) {
    double best = 0.0;
    for (const glm::vec3& normal : normals) {
        best = std::max(best, static_cast<double>(glm::dot(hit.normal, normal)));
    }
    return cosine >= best - shared_cosine;
}

} // namespace

void SceneLines::cross(int column, int row, const glm::dvec2& range, relief::CellCrossings& found) const {
    using relief::CellCrossings;
    found.crossings.clear();
    for (int j = 0; j < CellCrossings::lines_along; ++j) {
        for (int i = 0; i < CellCrossings::lines_along; ++i) {
            const glm::dvec2 at(column + double(i) / CellCrossings::parts,
                                row + double(j) / CellCrossings::parts);
            found.first[CellCrossings::line(i, j)] = static_cast<std::uint32_t>(found.crossings.size());
            follow_line(input_, grid_, at, range, [&](const SurfaceHit& hit, double w, double cosine) {
                found.crossings.push_back(crossing_of(grid_, hit, w, cosine));
            });
        }
    }
    found.first.back() = static_cast<std::uint32_t>(found.crossings.size());
}

std::optional<relief::Crossing> crossing_from(const BlockInput& input, const relief::ReliefGrid& grid,
                                              const SurfaceHit& hit) {
    const double cosine = grid.sign * static_cast<double>(hit.normal[grid.axis[2]]);
    if (!(cosine > min_cosine)) {
        return std::nullopt;
    }
    const double w = relief::grid_from_box(grid, hit.point, 1.0 / input.texels).z;
    return relief::Crossing{crossing_of(grid, hit, w, cosine),
                            is_own(normals_of(input.directions), hit, cosine),
                            codes_of(input.surface.colour(hit))};
}

relief::GridCrossings cross_grid(const BlockInput& input, pack::ReliefDirection direction) {
    const DirectionFrame frame = frame_of(direction);
    const double texel_box = 1.0 / input.texels;
    relief::GridCrossings grid;
    grid.grid = grid_of(frame, input.box_size, texel_box);
    grid.columns = lines_for(input.box_size[frame.axis_u], texel_box);
    grid.rows = lines_for(input.box_size[frame.axis_v], texel_box);
    const std::vector<glm::vec3> normals = normals_of(input.directions);
    const double top = input.box_size[frame.axis_n] / texel_box + 4.0; // above the whole box
    std::vector<std::vector<relief::Crossing>> rows(static_cast<std::size_t>(grid.rows));
    grid.first.assign(static_cast<std::size_t>(grid.columns) * rows.size() + 1, 0);
    parallel_for(rows.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            for (int column = 0; column < grid.columns; ++column) {
                follow_line(input, grid.grid, {column, row}, {-4.0, top},
                            [&](const SurfaceHit& hit, double w, double cosine) {
                                rows[row].push_back({crossing_of(grid.grid, hit, w, cosine),
                                                     is_own(normals, hit, cosine),
                                                     codes_of(input.surface.colour(hit))});
                            });
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
        const std::vector<relief::Crossing>& found = rows[static_cast<std::size_t>(row)];
        grid.crossings.insert(grid.crossings.end(), found.begin(), found.end());
        before = static_cast<std::uint32_t>(grid.crossings.size());
    }
    grid.ends = sheet_ends(input, grid.grid);
    return grid;
}

} // namespace frustumscreen::bake

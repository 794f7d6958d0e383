#include "assets_baked/bake/relief.h"

#include "assets_baked/bake/atlas.h"
#include "assets_baked/bake/relief_layers.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen {

namespace {

constexpr std::uint16_t empty_texel = 65535;
constexpr int border_texels = 1;

struct Piece {
    ReliefDirection direction;
    const DirectionLayers* layers;
    const std::vector<std::uint32_t>* members;
    glm::ivec2 low;
    glm::ivec2 size;
};

Piece piece_of(ReliefDirection direction, const DirectionLayers& layers,
               const std::vector<std::uint32_t>& members) {
    glm::ivec2 low(1 << 30);
    glm::ivec2 high(-1);
    for (const std::uint32_t m : members) {
        const glm::ivec2 at(layers.samples[m].x, layers.samples[m].y);
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    return {direction, &layers, &members, low, high - low + 1};
}

/// Grid position of an atlas texel, from the codes that the pack will hold.
class ReliefGeometry {
public:
    ReliefGeometry(const ReliefAtlas& atlas, const glm::dvec3& box_size)
        : atlas_(atlas), box_size_(box_size) {}

    [[nodiscard]] glm::vec3 position(const ReliefChart& chart, int x, int y) const {
        const DirectionFrame frame = frame_of(chart.direction);
        glm::vec3 p(0.0F);
        p[frame.axis_u] = chart.u0_box + static_cast<float>(x - chart.x) * atlas_.texel_box;
        p[frame.axis_v] = chart.v0_box + static_cast<float>(y - chart.y) * atlas_.texel_box;
        const float low = frame.axis_n == 2 ? 0.0F : -static_cast<float>(box_size_[frame.axis_n]) / 2.0F;
        p[frame.axis_n] = low + static_cast<float>(atlas_.relief.at(x, y)) / 65534.0F *
                                    static_cast<float>(box_size_[frame.axis_n]);
        return p;
    }

private:
    const ReliefAtlas& atlas_;
    const glm::dvec3& box_size_;
};

void place_piece(BakedRelief& relief, const Piece& piece, const glm::ivec2& corner,
                 const glm::dvec3& box_size) {
    const DirectionFrame frame = frame_of(piece.direction);
    const glm::vec3 low(-box_size.x / 2.0, -box_size.y / 2.0, 0.0);
    const float texel = relief.atlas.texel_box;
    ReliefChart chart;
    chart.direction = piece.direction;
    chart.x = static_cast<std::uint16_t>(corner.x);
    chart.y = static_cast<std::uint16_t>(corner.y);
    chart.width = static_cast<std::uint16_t>(piece.size.x);
    chart.height = static_cast<std::uint16_t>(piece.size.y);
    chart.u0_box = low[frame.axis_u] + (static_cast<float>(piece.low.x) + 0.5F) * texel;
    chart.v0_box = low[frame.axis_v] + (static_cast<float>(piece.low.y) + 0.5F) * texel;
    relief.atlas.charts.push_back(chart);
    for (const std::uint32_t m : *piece.members) {
        const ReliefSample& sample = piece.layers->samples[m];
        const glm::ivec2 at = corner + glm::ivec2(sample.x, sample.y) - piece.low;
        const double along = (sample.height - low[frame.axis_n]) / box_size[frame.axis_n];
        relief.atlas.relief.at(at.x, at.y) =
            static_cast<std::uint16_t>(std::lround(std::clamp(along, 0.0, 1.0) * 65534.0));
        relief.colour.at(at.x, at.y) = sample.colour;
    }
}

/// Two triangles for every square of linked texels, split along the flatter diagonal.
void triangulate(BakedRelief& relief, const ReliefChart& chart, const glm::dvec3& box_size) {
    constexpr float steepest = 9.0F; // texels; a little more than a link's, because of diagonals
    const ReliefGeometry geometry(relief.atlas, box_size);
    const DirectionFrame frame = frame_of(chart.direction);
    const float most_step = steepest * relief.atlas.texel_box;
    std::vector<std::uint32_t> ids(static_cast<std::size_t>(chart.width) * chart.height, 0xFFFFFFFFU);
    const auto vertex = [&](int x, int y) {
        std::uint32_t& id =
            ids[static_cast<std::size_t>(y - chart.y) * chart.width + static_cast<std::size_t>(x - chart.x)];
        if (id == 0xFFFFFFFFU) {
            id = static_cast<std::uint32_t>(relief.grid.positions.size());
            relief.grid.positions.push_back(geometry.position(chart, x, y));
            relief.grid.normals.push_back(frame.normal());
            relief.grid.uv_texels.emplace_back(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
        }
        return id;
    };
    const auto height = [&](const glm::ivec2& at) {
        return geometry.position(chart, at.x, at.y)[frame.axis_n];
    };
    const auto filled = [&](const glm::ivec2& at) {
        return relief.atlas.relief.at(at.x, at.y) != empty_texel;
    };
    // u x v is +n for +X and +Z and -n for +Y (x, z): counter-clockwise seen from outside needs the right
    // order.
    const bool u_cross_v_is_positive_axis = frame.axis_n != 1;
    const bool flip = (frame.sign > 0.0F) != u_cross_v_is_positive_axis;
    const auto emit = [&](glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
        if (!filled(a) || !filled(b) || !filled(c)) {
            return;
        }
        const auto [least, greatest] = std::minmax({height(a), height(b), height(c)});
        if (greatest - least > most_step) {
            return;
        }
        if (flip) {
            std::swap(b, c);
        }
        relief.grid.indices.insert(relief.grid.indices.end(),
                                   {vertex(a.x, a.y), vertex(b.x, b.y), vertex(c.x, c.y)});
    };
    for (int y = chart.y; y + 1 < chart.y + chart.height; ++y) {
        for (int x = chart.x; x + 1 < chart.x + chart.width; ++x) {
            const glm::ivec2 a(x, y);
            const glm::ivec2 b(x + 1, y);
            const glm::ivec2 c(x + 1, y + 1);
            const glm::ivec2 d(x, y + 1);
            const bool rising = filled(a) && filled(c);
            const bool falling = filled(b) && filled(d);
            const bool use_rising =
                rising && (!falling || std::abs(height(a) - height(c)) <= std::abs(height(b) - height(d)));
            if (use_rising) {
                emit(a, b, c);
                emit(a, c, d);
            } else {
                emit(a, b, d);
                emit(b, c, d);
            }
        }
    }
}

} // namespace

std::optional<BakedRelief> bake_relief(const SourceScene& source, const TriangleMesh& visible,
                                       const glm::dvec3& box_size,
                                       const std::vector<ReliefDirection>& directions,
                                       int texels_along_longest_edge, int largest_atlas) {
    const SourceMesh visible_mesh = as_source(visible);
    const std::vector<glm::dvec3> visible_points(visible.positions.begin(), visible.positions.end());
    const SourceScene visible_scene(visible_mesh, visible_points);
    LayerInput input{
        source, visible_scene, glm::vec3(box_size), 1.0F / static_cast<float>(texels_along_longest_edge), {}};
    for (const ReliefDirection direction : directions) {
        input.normals.push_back(frame_of(direction).normal());
    }
    std::vector<DirectionLayers> layers;
    layers.reserve(directions.size());
    for (const ReliefDirection direction : directions) {
        layers.push_back(make_layers(input, direction));
    }
    std::vector<Piece> pieces;
    std::vector<glm::ivec2> sizes;
    for (std::size_t d = 0; d < directions.size(); ++d) {
        for (const std::vector<std::uint32_t>& members : layers[d].charts) {
            pieces.push_back(piece_of(directions[d], layers[d], members));
            sizes.push_back(pieces.back().size + 2 * border_texels);
        }
    }
    if (pieces.empty() || pieces.size() > 65535) {
        return std::nullopt;
    }
    const AtlasLayout layout = pack_rectangles(sizes);
    if (layout.width > largest_atlas || layout.height > largest_atlas) {
        return std::nullopt;
    }
    BakedRelief relief;
    relief.atlas.texel_box = input.texel_box;
    relief.atlas.relief = Image16(layout.width, layout.height, empty_texel);
    relief.colour = ImageFloat(layout.width, layout.height, glm::vec3(0.0F));
    relief.grid.atlas_width = layout.width;
    relief.grid.atlas_height = layout.height;
    relief.grid.chart_count = pieces.size();
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        place_piece(relief, pieces[k], layout.corners[k] + border_texels, box_size);
        const auto first_vertex = static_cast<std::uint32_t>(relief.grid.positions.size());
        const auto first_index = static_cast<std::uint32_t>(relief.grid.indices.size());
        triangulate(relief, relief.atlas.charts.back(), box_size);
        relief.charts.push_back(
            {first_vertex, static_cast<std::uint32_t>(relief.grid.positions.size()) - first_vertex,
             first_index, static_cast<std::uint32_t>(relief.grid.indices.size()) - first_index});
    }
    if (relief.grid.indices.empty()) {
        return std::nullopt;
    }
    return relief;
}

ChartedMesh simplify_grid(const BakedRelief& relief, float tolerance_box) {
    // It goes chart by chart: rings of charts share positions, which must not tie one chart's vertices to
    // another's.
    ChartedMesh result = relief.grid;
    result.indices.clear();
    std::vector<std::uint32_t> local;
    std::vector<std::uint32_t> fewer;
    for (const BakedRelief::Range& range : relief.charts) {
        if (range.index_count == 0) {
            continue;
        }
        local.assign(relief.grid.indices.begin() + range.first_index,
                     relief.grid.indices.begin() + range.first_index + range.index_count);
        for (std::uint32_t& index : local) {
            index -= range.first_vertex;
        }
        const float* positions = &relief.grid.positions[range.first_vertex].x;
        const float scale = meshopt_simplifyScale(positions, range.vertex_count, sizeof(glm::vec3));
        fewer.resize(local.size());
        fewer.resize(meshopt_simplify(fewer.data(), local.data(), local.size(), positions, range.vertex_count,
                                      sizeof(glm::vec3), 0, tolerance_box / std::max(scale, 1e-20F), 0,
                                      nullptr));
        for (const std::uint32_t index : fewer) {
            result.indices.push_back(index + range.first_vertex);
        }
    }
    return result;
}

} // namespace frustumscreen

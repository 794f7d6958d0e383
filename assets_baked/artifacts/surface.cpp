#include "assets_baked/artifacts/surface.h"

#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace frustumscreen::artifacts {
namespace {

struct Cells {
    std::int64_t u = 0;
    std::int64_t v = 0;
};

std::int64_t triangles_of(const Patch& patch, const Cells& cells) {
    const int poles = (patch.pole_at_start ? 1 : 0) + (patch.pole_at_end ? 1 : 0);
    return 2 * cells.u * cells.v - poles * cells.u;
}

std::int64_t triangles_of(const std::vector<Patch>& patches, const std::vector<Cells>& cells) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
        sum += triangles_of(patches[i], cells[i]);
    }
    return sum;
}

void share_columns(const std::vector<Patch>& patches, std::vector<Cells>& cells) {
    for (std::size_t i = 0; i < patches.size(); ++i) {
        if (patches[i].columns_of >= 0) {
            cells[i].u = cells[static_cast<std::size_t>(patches[i].columns_of)].u;
        }
    }
}

std::vector<Cells> cells_at(const std::vector<Patch>& patches, double cells_per_mm) {
    std::vector<Cells> cells;
    cells.reserve(patches.size());
    for (const Patch& patch : patches) {
        cells.push_back(
            {std::max<std::int64_t>(patch.min_u, std::llround(patch.length_u_mm * cells_per_mm)),
             std::max<std::int64_t>(patch.min_v, std::llround(patch.length_v_mm * cells_per_mm))});
    }
    share_columns(patches, cells);
    return cells;
}

/// Finds even cells by bisection of their density, then adds or removes single rows until no step comes
/// closer to the number of triangles.
std::vector<Cells> share_budget(const std::vector<Patch>& patches, std::int64_t triangles) {
    double low = 0.0;
    double high = 1e4;
    for (int step = 0; step < 100; ++step) {
        const double middle = 0.5 * (low + high);
        (triangles_of(patches, cells_at(patches, middle)) <= triangles ? low : high) = middle;
    }
    std::vector<Cells> cells = cells_at(patches, low);
    for (int step = 0; step < 64; ++step) {
        const std::int64_t missing = triangles - triangles_of(patches, cells);
        std::int64_t nearest = std::abs(missing);
        std::size_t chosen = patches.size();
        int change = 0;
        for (std::size_t i = 0; i < patches.size(); ++i) {
            for (const int by : {-1, 1}) {
                const std::int64_t left = std::abs(missing - std::int64_t{by} * 2 * cells[i].u);
                if (left < nearest && cells[i].v + by >= patches[i].min_v) {
                    nearest = left;
                    chosen = i;
                    change = by;
                }
            }
        }
        if (chosen == patches.size()) {
            break;
        }
        cells[chosen].v += change;
    }
    return cells;
}

void append_vertices(const Patch& patch, const Cells& cells, bake::SourceMesh& mesh) {
    const auto columns = static_cast<std::size_t>(cells.u + 1);
    const std::size_t first = mesh.positions.size();
    mesh.positions.resize(first + columns * static_cast<std::size_t>(cells.v + 1));
    mesh.uvs.resize(mesh.positions.size());
    parallel_for(static_cast<std::size_t>(cells.v + 1), 1, [&](std::size_t row, std::size_t) {
        for (std::size_t column = 0; column < columns; ++column) {
            const SurfacePoint point = patch.at(static_cast<double>(column) / static_cast<double>(cells.u),
                                                static_cast<double>(row) / static_cast<double>(cells.v));
            const std::size_t index = first + row * columns + column;
            mesh.positions[index] = glm::dvec3(glm::vec3(point.position)); // rounded to 32 bits, as in a file
            mesh.uvs[index] = point.uv;
        }
    });
}

void append_triangles(const Patch& patch, const Cells& cells, std::uint32_t first, bake::SourceMesh& mesh) {
    const auto columns = static_cast<std::uint32_t>(cells.u + 1);
    for (std::uint32_t v = 0; v < static_cast<std::uint32_t>(cells.v); ++v) {
        const bool low_pole = patch.pole_at_start && v == 0;
        const bool high_pole = patch.pole_at_end && v + 1 == static_cast<std::uint32_t>(cells.v);
        for (std::uint32_t u = 0; u + 1 < columns; ++u) {
            const std::uint32_t a = first + v * columns + u;
            const std::uint32_t d = a + columns;
            if (!low_pole) {
                mesh.triangles.push_back({a, a + 1, high_pole ? d : d + 1});
            }
            if (!high_pole) {
                mesh.triangles.push_back({a, d + 1, d});
            }
        }
    }
}

} // namespace

bake::SourceMesh make_mesh(const std::vector<Patch>& patches, std::int64_t triangles, image::Image8 texture) {
    const std::vector<Cells> cells = share_budget(patches, triangles);
    bake::SourceMesh mesh;
    mesh.triangles.reserve(static_cast<std::size_t>(triangles_of(patches, cells)));
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        append_vertices(patches[i], cells[i], mesh);
        append_triangles(patches[i], cells[i], first, mesh);
    }
    mesh.triangle_materials.assign(mesh.triangles.size(), 0);
    mesh.textures.push_back(
        {std::make_shared<const image::Image8>(std::move(texture)), bake::Wrap::Repeat, bake::Wrap::Clamp});
    mesh.materials.push_back({.texture = 0});
    return mesh;
}

} // namespace frustumscreen::artifacts

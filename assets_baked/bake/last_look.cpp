#include "assets_baked/bake/last_look.h"

#include "assets_baked/bake/colour_looks.h"
#include "assets_baked/bake/coordinate_looks.h"
#include "assets_baked/bake/surface_parts.h"
#include "assets_baked/bake/winding.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

namespace frustumscreen::bake {

namespace {

constexpr double max_scrap_share = 0.001; ///< of the triangles, for all scraps together
constexpr double min_shrinkage = 0.8;     ///< largest ratio of sizes without and with scraps
constexpr double min_inside_out = 0.05;   ///< of the area

struct Bounds {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const Bounds& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    [[nodiscard]] double size() const {
        const glm::dvec3 edges = high - low;
        return std::max({edges.x, edges.y, edges.z, 0.0});
    }
};

struct Part {
    Bounds bounds;
    std::size_t triangles = 0;
};

/// The largest distance by which a part extends beyond `rest`.
double reach_beyond(const Bounds& part, const Bounds& rest) {
    const glm::dvec3 beyond = glm::max(part.high - rest.high, rest.low - part.low);
    return std::max({beyond.x, beyond.y, beyond.z});
}

} // namespace

Scraps find_scraps(const SourceMesh& mesh) {
    const auto [part_of, count] = connected_surfaces(mesh);
    std::vector<Part> parts(count);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Part& part = parts[part_of[t]];
        ++part.triangles;
        for (const std::uint32_t vertex : mesh.triangles[t]) {
            part.bounds.add({mesh.positions[vertex], mesh.positions[vertex]});
        }
    }
    // The largest parts are the artifact. Other parts may be scraps if they reach beyond it by more than a tenth of its
    // size.
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(parts[b].triangles, a) < std::pair(parts[a].triangles, b);
    });
    const auto few = static_cast<std::size_t>(max_scrap_share * static_cast<double>(mesh.triangles.size()));
    Bounds artifact;
    Bounds all;
    std::vector<bool> is_scrap_part(count, false);
    Scraps scraps;
    for (const std::uint32_t p : order) {
        const Part& part = parts[p];
        all.add(part.bounds);
        const bool is_far = reach_beyond(part.bounds, artifact) > 0.1 * artifact.size();
        if (part.triangles <= few && artifact.size() > 0.0 && is_far) {
            is_scrap_part[p] = true;
            scraps.triangles += part.triangles;
        } else {
            artifact.add(part.bounds);
        }
    }
    scraps.size_with = all.size();
    scraps.size_without = artifact.size();
    if (scraps.triangles == 0 || scraps.triangles > few ||
        scraps.size_without >= min_shrinkage * scraps.size_with) {
        return {};
    }
    for (const std::uint32_t part : part_of) {
        scraps.is_scrap.push_back(is_scrap_part[part]);
    }
    return scraps;
}

void remove_scraps(SourceMesh& mesh, const Scraps& scraps) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!scraps.is_scrap[t]) {
            mesh.triangles[kept] = mesh.triangles[t];
            mesh.triangle_materials[kept] = mesh.triangle_materials[t];
            if (!mesh.triangle_nodes.empty()) {
                mesh.triangle_nodes[kept] = mesh.triangle_nodes[t];
            }
            ++kept;
        }
    }
    mesh.triangles.resize(kept);
    mesh.triangle_materials.resize(kept);
    if (!mesh.triangle_nodes.empty()) {
        mesh.triangle_nodes.resize(kept);
    }
}

std::vector<SourceNote> last_look(const SourceMesh& mesh, const Scraps& scraps, Lighting lighting) {
    std::vector<std::string> guesses;
    if (scraps.triangles > 0) {
        guesses.push_back(
            fmt::format("{} of its {} triangles lie apart from the rest, and make the artifact {:.2g} "
                        "times as small as it could be: leave them out with --clean, "
                        "or cut them off in the scan",
                        scraps.triangles, mesh.triangles.size(), scraps.size_with / scraps.size_without));
    }
    if (const double share = inside_out_share(mesh); share > min_inside_out) {
        guesses.push_back(fmt::format(
            "about {:.0f} % of its surface is turned inside out, beside parts that are not: light has seams "
            "between them, and the levels need more triangles: --clean turns them in closed parts; turn "
            "those of "
            "open parts alike before it is exported (in MeshLab: Re-Orient all faces coherently)",
            100.0 * share));
    }
    for (const std::optional<std::string>& look :
         {look_for_black(mesh), look_for_one_colour(mesh),
          lighting == Lighting::Museum ? look_for_own_light(mesh) : std::nullopt, look_for_far_origin(mesh),
          look_for_few_decimals(mesh)}) {
        if (look) {
            guesses.push_back(*look);
        }
    }
    std::vector<SourceNote> notes;
    for (std::string& guess : guesses) {
        notes.push_back({SourceNote::Kind::Guessed, std::move(guess)});
    }
    return notes;
}

} // namespace frustumscreen::bake

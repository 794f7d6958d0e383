#include "assets_baked/bake/coordinate_looks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::bake {

namespace {

constexpr double max_step_share = 1.0 / 2000; ///< of the size: about a texel of the finest relief

struct Reach {
    double size = 0.0;     ///< longest edge of the bounding box
    double farthest = 0.0; ///< largest coordinate, without its sign
};

Reach reach_of(const SourceMesh& mesh) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-std::numeric_limits<double>::infinity());
    for (const glm::dvec3& position : mesh.positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    const glm::dvec3 edges = high - low;
    const glm::dvec3 farthest = glm::max(glm::abs(low), glm::abs(high));
    return {std::max({edges.x, edges.y, edges.z}), std::max({farthest.x, farthest.y, farthest.z})};
}

bool are_multiples(const SourceMesh& mesh, double step) {
    constexpr double tolerance = 2e-3; // of a step; 32 bits round a thousand steps by less
    const auto is_multiple = [&](double coordinate) {
        const double steps = coordinate / step;
        return std::abs(steps - std::round(steps)) <= tolerance;
    };
    return std::all_of(mesh.positions.begin(), mesh.positions.end(), [&](const glm::dvec3& p) {
        return is_multiple(p.x) && is_multiple(p.y) && is_multiple(p.z);
    });
}

/// True if the triangles are about as small as a step, and most are not along the axes.
bool is_fine_and_oblique(const SourceMesh& mesh, double step) {
    constexpr double max_steps = 10.0;
    constexpr double along_axis = 0.999; // cosine
    double edges = 0.0;
    std::size_t oblique = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::dvec3 ab = mesh.positions[b] - mesh.positions[a];
        const glm::dvec3 ac = mesh.positions[c] - mesh.positions[a];
        const glm::dvec3 normal = glm::abs(glm::cross(ab, ac));
        edges += glm::length(ab);
        oblique += std::max({normal.x, normal.y, normal.z}) < along_axis * glm::length(normal) ? 1 : 0;
    }
    return edges < max_steps * step * static_cast<double>(mesh.triangles.size()) &&
           2 * oblique > mesh.triangles.size();
}

} // namespace

std::optional<std::string> look_for_far_origin(const SourceMesh& mesh) {
    const Reach reach = reach_of(mesh);
    const bool is_single =
        std::all_of(mesh.positions.begin(), mesh.positions.end(),
                    [](const glm::dvec3& position) { return glm::dvec3(glm::vec3(position)) == position; });
    const double step = std::ldexp(reach.farthest, -23);
    if (!is_single || !(reach.size > 0.0) || step <= max_step_share * reach.size) {
        return std::nullopt;
    }
    return fmt::format("its points lie on a grid of {:.2g} of its size, because its coordinates are large "
                       "({:.3g}): move it to the origin before it is exported",
                       step / reach.size, reach.farthest);
}

std::optional<std::string> look_for_few_decimals(const SourceMesh& mesh) {
    constexpr int max_decimals = 9;
    constexpr int max_zeros = 9; // before the decimal point
    const double size = reach_of(mesh).size;
    for (int decimals = -max_zeros; decimals <= max_decimals; ++decimals) {
        const double step = std::pow(10.0, -decimals);
        if (step <= max_step_share * size) {
            return std::nullopt; // as fine as a picture shows
        }
        if (step < size && are_multiples(mesh, step)) {
            return is_fine_and_oblique(mesh, step)
                       ? std::optional(fmt::format("its points are rounded to {:.3g}, which is {:.2g} of its "
                                                   "size, so its surface has steps: "
                                                   "export it with more decimals, or in a smaller unit",
                                                   step, step / size))
                       : std::nullopt;
        }
    }
    return std::nullopt;
}

} // namespace frustumscreen::bake

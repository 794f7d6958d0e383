/// Worlds with shapes and colours for tests of patch reliefs, a ray cast that tries every triangle, and a patch drawn for an
/// eye.
///
/// Frames   window (app/ldi/triangle_world.h). Units: metres.
/// Threads  pure; any.
#pragma once

#include "app/image/image.h"
#include "app/ldi/hemisphere.h"
#include "app/ldi/patch_relief.h"
#include "app/ldi/triangle_world.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <random>
#include <vector>

namespace frustumscreen::ldi {

inline constexpr double half_window_m = 0.1;
inline constexpr double eye_distance_m = 0.5;

/// Ground, hills and houses behind a window, and a post that reaches before it. Colours change slowly on each surface.
[[nodiscard]] TriangleWorld town(unsigned seed);
/// Hills alone, with shades as of a photograph.
[[nodiscard]] TriangleWorld hills();
/// A wall all across the window, 0.1 m behind it, and before it posts a few tenths of a millimetre wide.
[[nodiscard]] TriangleWorld wires_before_a_wall();

/// A seeded eye in the patch, at the frozen distance.
[[nodiscard]] glm::dvec3 seeded_eye(const Hemisphere& hemisphere, std::size_t patch, std::mt19937& random);

/// An eye's view through the window, in pixels from the upper left; NaN and alpha 0 where there is nothing.
struct SeenWindow {
    int px = 0;
    std::vector<glm::vec3> points;
    image::Image8 colours;

    [[nodiscard]] bool hit(int x, int y) const;
    [[nodiscard]] const glm::vec3& point(int x, int y) const {
        return points[static_cast<std::size_t>(y) * static_cast<std::size_t>(px) +
                      static_cast<std::size_t>(x)];
    }
};
[[nodiscard]] SeenWindow ray_cast(const TriangleWorld& world, const glm::dvec3& eye, int px);
/// Drawn as a relief on a prop with one face, the window.
[[nodiscard]] SeenWindow drawn(const PatchRelief& patch, const glm::dvec3& eye, int px, int samples = 1);

/// In which order a maker of patches makes all of them; `calls`: of its `step`.
template <typename Maker> struct MakingOrder {
    std::vector<std::size_t> patches;
    std::size_t calls = 0;

    explicit MakingOrder(Maker& maker) {
        for (bool more = true; more; ++calls) {
            more = maker.step();
            for (std::size_t patch = 0; patch < patch_count; ++patch) {
                if (maker.patch(patch) && std::find(patches.begin(), patches.end(), patch) == patches.end()) {
                    patches.push_back(patch);
                }
            }
        }
    }
    /// All patches, none before one that is nearer to the first.
    [[nodiscard]] bool is_by_angle(const Hemisphere& hemisphere) const {
        return patches.size() == patch_count &&
               std::is_sorted(patches.begin(), patches.end(), [&](std::size_t a, std::size_t b) {
                   const glm::dvec3 first = hemisphere.middle_of(patches.front());
                   return glm::dot(first, hemisphere.middle_of(a)) >
                          glm::dot(first, hemisphere.middle_of(b)) + 1e-12;
               });
    }
};

} // namespace frustumscreen::ldi

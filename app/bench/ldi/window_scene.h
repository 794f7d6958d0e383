/// The scene of `frustumscreen-bench ldi`: a hill town, in the prop and frozen behind windows, and the eyes' paths.
///
/// The window lies over the town like a pane over a pit: the town's up direction leans by 15 degrees from the
/// window's normal, away from the eye that froze it, and the town's whole box is behind the window.
///
/// Frames   window (app/ldi/triangle_world.h); site (app/simulation/site.h).
/// Threads  pure; any. The same numbers and seed give the same scene on every machine.
/// Errors   none.
#pragma once

#include "app/ldi/hemisphere.h"
#include "app/ldi/triangle_world.h"
#include "app/scene/flat_screen.h"
#include "assets_baked/bake/source_mesh.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace frustumscreen::bench {

inline constexpr double window_side_m = 0.12;
inline constexpr double frozen_from_m =
    0.5;                              ///< the eye's distance from the window's middle when it is frozen
inline constexpr int max_windows = 4; ///< as in the report's Fig. 8

struct WindowScene {
    std::size_t triangles = 0;
    double size_m = 0.0;                              ///< of the site's box, its longest edge
    glm::dvec3 box_size{1.0};                         ///< of the site's box, in box units
    std::shared_ptr<const bake::SourceMesh> mesh;     ///< site frame
    std::shared_ptr<const ldi::TriangleWorld> world;  ///< window frame
    glm::dmat4 window_from_site{1.0};                 ///< rigid
    glm::dvec3 frozen_eye_m{0.0, 0.0, frozen_from_m}; ///< window frame
};
[[nodiscard]] WindowScene make_window_scene(std::size_t triangles, std::uint64_t seed);

/// The window as a flat screen of `pixels` x `pixels`, in its own frame.
[[nodiscard]] scene::FlatScreen window_screen(int pixels);

/// Where an eye is before each window, and before the prop, in one frame.
struct WindowFrame {
    std::array<glm::dvec3, max_windows> eyes_m{}; ///< window frame of each
};
/// Each eye goes through the centre and round the ring of its window's hemisphere, steadily, at 0.85 to 1.2 times the
/// distance of the frozen eye. Its start is drawn from `seed`.
[[nodiscard]] std::vector<WindowFrame> window_path(int frames, std::uint64_t seed);
/// The patch that the eye is in; beyond the cap, the one whose middle is nearest.
[[nodiscard]] std::size_t nearest_patch(const ldi::Hemisphere& hemisphere, const glm::dvec3& eye_m);
/// Eyes in one patch, spread over its directions.
[[nodiscard]] std::vector<glm::dvec3> eyes_in_patch(const ldi::Hemisphere& hemisphere, std::size_t patch,
                                                    int count, std::uint64_t seed);

} // namespace frustumscreen::bench

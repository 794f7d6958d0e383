/// Pins what an eye sees through the prop as a window that lies on the table.
///
/// Picture  for the eye that pins, the window shows what the prop showed: the eye's ray to the prop's middle becomes its ray to
///          the window's middle by a turn about the vertical and one about the horizontal axis across the ray, so that what
///          stood upright for the eye stands upright. Other eyes look around it, as through a window.
/// Place    the sphere around the world lies wholly behind the window and touches the table from below. It is as large as the
///          eye sees whole in the window, with a margin; its size and its distance from the eye follow from both.
/// Frames   table T; prop P; window: origin in its middle on the table, z up, y away from whoever pins it at yaw 0.
/// Units    metres.
/// Threads  pure; any. Nothing allocates into a view that was made before; `move_behind` neither if its target has the capacity.
/// Errors   nullopt, false: the eye is not above the table, or a number is not finite.
#pragma once

#include "app/scene/frame_plan.h"

#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::scene {

/// A ball around a world.
struct WorldBall {
    glm::dvec3 middle{0.0};
    double radius = 0.0;
};
/// Around all that the parts draw, in the frame that they are placed in. nullopt: they draw nothing.
[[nodiscard]] std::optional<WorldBall> ball_around(std::span<const Part> parts);
/// True if all that the parts draw lies in it.
[[nodiscard]] bool contains(const WorldBall& ball, std::span<const Part> parts);
/// The smallest one around both.
[[nodiscard]] WorldBall united(const WorldBall& a, const WorldBall& b);

/// A window's place on the table.
struct WindowPlace {
    glm::dvec2 middle_m{0.0};
    double yaw_rad = 0.0; ///< counter-clockwise seen from above
    double width_m = 0.12, depth_m = 0.12;
};
[[nodiscard]] geometry::RigidTransform table_from_window(const WindowPlace& place);

struct PinRequest {
    geometry::RigidTransform table_from_prop;
    glm::dvec3 prop_middle{0.0}; ///< PropShape::middle
    glm::dvec3 eye_m{0.0};       ///< table frame: of whoever pins
    WorldBall world;             ///< prop frame
    WindowPlace place;
    /// Another view of the world, chosen before it is pinned: a turn about its middle, prop frame, and a factor of its size.
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    double zoom = 1.0;
};

struct PinnedView {
    geometry::PropShape surface; ///< PlacedWindow::surface
    geometry::RigidTransform table_from_window;
    glm::dmat4 window_from_prop{1.0}; ///< a similarity
    double scale = 1.0;               ///< of it
};
[[nodiscard]] std::optional<PinnedView> pin_view(const PinRequest& request);
/// As above, into a view that may have been used before; after false its contents are undefined.
[[nodiscard]] bool pin_view(const PinRequest& request, PinnedView& view);

/// The face of a window: a rectangle that looks up.
[[nodiscard]] geometry::PropShape window_surface(double width_m, double depth_m);

/// The parts of a prop's world as they stand behind a window; each may show on the whole window.
void move_behind(const glm::dmat4& window_from_prop, std::span<const Part> parts, std::vector<Part>& moved);
/// A torch on the prop's world as it lights that world behind a window that now stands at `table_from_window`. In `torch` the pose is
/// that in the prop's frame, in the result that on the table.
[[nodiscard]] PlacedTorch moved_behind(const PinnedView& view,
                                       const geometry::RigidTransform& table_from_window,
                                       const PlacedTorch& torch);

} // namespace frustumscreen::scene

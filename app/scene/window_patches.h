/// The world behind a frozen window, as points for the eyes before it: drawn in place of its triangles or relief, in less time.
///
/// Frames   window: as PlacedWindow.
/// Units    metres.
/// Threads  values; any.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/ldi/hemisphere.h"
#include "app/ldi/point_patch.h"
#include "app/scene/frame_plan.h"
#include "app/scene/shader_key.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>

namespace frustumscreen::scene {

/// The points that an eye is shown.
struct ShownPoints {
    const ldi::PointPatch* points = nullptr; ///< null: the window's parts alone
    float share = 1.0F;                      ///< of the light; the rest is that of the window's parts
};

/// Fades from a window's parts to points and back, for one eye.
class PointFade {
public:
    static constexpr double fade_s = 0.5;

    /// `ready`: as points_for. `share`: the part of a whole fade that passes in this step; 1 or more ends the fade.
    /// One patch follows another without a fade, because neighbours are alike.
    void step(const ldi::PointPatch* ready, double share);
    [[nodiscard]] const ShownPoints& shown() const { return shown_; }
    /// True if the eye is shown both.
    [[nodiscard]] bool fades() const { return shown_.share > 0.0F && shown_.share < 1.0F; }

private:
    ShownPoints shown_{.points = nullptr, .share = 0.0F};
};

struct WindowPatches {
    ldi::Hemisphere hemisphere;
    geometry::Box box;                                              ///< around the world
    int samples = 1;                                                ///< a pixel
    std::array<const ldi::PointPatch*, ldi::patch_count> patches{}; ///< null: not made
    struct OfEye {
        glm::dvec3 eye{0.0};
        ShownPoints shown;
    };
    std::array<OfEye, 2> eyes{}; ///< the first `eye_count`: those that look at the window
    std::size_t eye_count = 0;   ///< 0: each eye sees the points that there are for it, without a fade
};

/// Null if there are no points for an eye, window's frame: its patch is not made, or it is too near or far (ldi/eye_cells.h).
[[nodiscard]] const ldi::PointPatch* points_for(const WindowPatches& patches, const glm::dvec3& eye);
/// The points that the nearest of `WindowPatches::eyes` is shown.
[[nodiscard]] ShownPoints shown_to(const WindowPatches& patches, const glm::dvec3& eye);

/// The points as a part of the window's world. If their share is below 1, they are to be drawn over the window's parts.
[[nodiscard]] Part part_of(const WindowPatches& patches, const ShownPoints& shown);

/// Adds to a renderer's needs those of drawing points.
[[nodiscard]] RenderNeeds with_points(RenderNeeds needs);

} // namespace frustumscreen::scene

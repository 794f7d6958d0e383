/// How the patches of a frozen window see its world: somewhat finer than the samples of its picture in the projector's pixels.
///
/// Frames   table T; window: as scene::PinnedView.
/// Units    metres.
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/ldi/patch_layers.h"
#include "app/scene/pinned_view.h"

namespace frustumscreen::show {

struct PatchViewRequest {
    const scene::PinnedView& view;
    const geometry::Pinhole& projector;
    const geometry::RigidTransform& table_from_projector;
    glm::dvec3 eye_m{0.0}; ///< that froze the window, table frame
    int samples = 1;       ///< a pixel, that its parts ask for
};

/// Points for each sample, along a side: a sample takes the colour of the point whose box holds it.
inline constexpr double points_along = 1.2;

struct PatchView {
    ldi::CameraView cameras;
    int samples = 1; ///< a pixel, of the window's picture
    double radius_m = 1.0;
    double samples_per_m = 1.0; ///< of the window's picture, in the world's middle
};
[[nodiscard]] PatchView patch_view(const PatchViewRequest& request);

} // namespace frustumscreen::show

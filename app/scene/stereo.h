/// The layout of the eyes' pictures in the display's picture. Stereo is two pictures of one scene: everything that
/// draws one eye's picture works for two, with another viewpoint in another part of the display's picture.
///
/// side_by_side, top_bottom   each eye has half of the pixels; the projector stretches them over its whole picture.
/// frame_sequential           the display's picture holds both eyes' pictures in full size, the left one above; the
///                            display shows one of them at each refresh (display.h).
/// anaglyph                   both in full size over each other: red for the left eye, green and blue for the right.
///
/// Units    pixels.
/// Threads  pure; any.
#pragma once

#include "app/scene/frame_plan.h"
#include "app/settings/settings.h"
#include "firmware_host/base/pixel_rectangle.h"

#include <array>
#include <cstddef>
#include <span>

namespace frustumscreen::scene {

struct StereoLayout {
    PixelSize display;         ///< of the display's picture
    geometry::Pinhole pinhole; ///< of one eye's picture; equal for both
    std::size_t count = 1;     ///< eyes
    /// The left eye's, then the right eye's.
    std::array<EyePicture, 2> pictures{};
};
[[nodiscard]] StereoLayout stereo_layout(const geometry::Pinhole& projector, settings::Stereo stereo);
/// `view` as each eye of the layout sees it: its own eye, pinhole and part of the display's picture. `eyes_m`: one for
/// each eye; it must outlive the views. The first `layout.count` are valid.
[[nodiscard]] std::array<PlanView, 2> views_of(const StereoLayout& layout, const PlanView& view,
                                               std::span<const glm::dvec3> eyes_m);
/// The eyes that the layout draws for: the one between them, or both, the left eye first. The points must outlive it.
[[nodiscard]] std::span<const glm::dvec3> drawn_eyes(const StereoLayout& layout, const glm::dvec3& between_m,
                                                     const std::array<glm::dvec3, 2>& both_m);
/// True if a picture for both eyes is shown in the projector's own pixels, where it can be measured: without stereo, and
/// as an anaglyph.
[[nodiscard]] bool keeps_pixels(settings::Stereo stereo);
/// The layout of the configured projector.
[[nodiscard]] StereoLayout stereo_layout(const settings::Settings& settings);

} // namespace frustumscreen::scene

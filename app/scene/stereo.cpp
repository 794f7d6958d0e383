#include "app/scene/stereo.h"

#include <cassert>

namespace frustumscreen::scene {

namespace {

PixelRectangle viewport_of(const geometry::Pinhole& pinhole, int x, int y) {
    return {.x = x, .y = y, .width = pinhole.width, .height = pinhole.height};
}

} // namespace

StereoLayout stereo_layout(const geometry::Pinhole& projector, settings::Stereo stereo) {
    const int width = projector.width;
    const int height = projector.height;
    StereoLayout layout{.display = {width, height}, .pinhole = projector, .count = 2};
    switch (stereo) {
    case settings::Stereo::Off:
        layout.count = 1;
        break;
    case settings::Stereo::SideBySide:
        layout.pinhole = projector.scaled_to(width / 2, height);
        layout.pictures[0].viewport = viewport_of(layout.pinhole, 0, 0);
        layout.pictures[1].viewport = viewport_of(layout.pinhole, width / 2, 0);
        break;
    case settings::Stereo::TopBottom:
        layout.pinhole = projector.scaled_to(width, height / 2);
        layout.pictures[0].viewport = viewport_of(layout.pinhole, 0, 0);
        layout.pictures[1].viewport = viewport_of(layout.pinhole, 0, height / 2);
        break;
    case settings::Stereo::FrameSequential:
        layout.display.height = 2 * height;
        layout.pictures[0].viewport = viewport_of(projector, 0, 0);
        layout.pictures[1].viewport = viewport_of(projector, 0, height);
        break;
    case settings::Stereo::Anaglyph:
        layout.pictures[0].channels = {true, false, false};
        layout.pictures[1].channels = {false, true, true};
        break;
    }
    return layout;
}

std::array<PlanView, 2> views_of(const StereoLayout& layout, const PlanView& view,
                                 std::span<const glm::dvec3> eyes_m) {
    assert(eyes_m.size() == layout.count);
    std::array<PlanView, 2> views{view, view};
    for (std::size_t eye = 0; eye < layout.count; ++eye) {
        views[eye].projector = layout.pinhole;
        views[eye].eyes_m = eyes_m.subspan(eye, 1);
        views[eye].dimming_eyes_m = eyes_m;
        views[eye].picture = layout.pictures[eye];
    }
    return views;
}

std::span<const glm::dvec3> drawn_eyes(const StereoLayout& layout, const glm::dvec3& between_m,
                                       const std::array<glm::dvec3, 2>& both_m) {
    return layout.count == 1 ? std::span(&between_m, 1) : std::span<const glm::dvec3>(both_m);
}

bool keeps_pixels(settings::Stereo stereo) {
    return stereo == settings::Stereo::Off || stereo == settings::Stereo::Anaglyph;
}

StereoLayout stereo_layout(const settings::Settings& settings) {
    return stereo_layout(settings.projector.pinhole, settings::stereo_of(settings));
}

} // namespace frustumscreen::scene

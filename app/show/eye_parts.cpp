#include "app/show/eye_parts.h"

namespace frustumscreen::show {

namespace {

/// `at` of a side of `from` pixels, on a side of `to` pixels, rounded.
int scaled(int at, int from, int to) {
    return (2 * at * to + from) / (2 * from);
}

} // namespace

EyeParts::EyeParts(const settings::Settings& settings)
    : layout_(scene::stereo_layout(settings)), picture_{settings.projector.pinhole.width,
                                                        settings.projector.pinhole.height} {}

PixelRectangle EyeParts::seen_by(std::size_t eye, const PixelRectangle& part) const {
    if (!are_apart()) {
        return part;
    }
    const PixelRectangle& viewport = layout_.pictures.at(eye).viewport;
    const auto x = [&](int at) { return scaled(at, picture_.width, viewport.width); };
    const auto y = [&](int at) { return scaled(at, picture_.height, viewport.height); };
    return {.x = viewport.x + x(part.x),
            .y = viewport.y + y(part.y),
            .width = x(part.x + part.width) - x(part.x),
            .height = y(part.y + part.height) - y(part.y)};
}

void EyeParts::show(render::PictureUpload& upload, unsigned framebuffer, const glm::ivec2& place) const {
    for (std::size_t eye = 0; eye < (are_apart() ? layout_.count : 1); ++eye) {
        show_to(eye, upload, framebuffer, place);
    }
}

void EyeParts::show_to(std::size_t eye, render::PictureUpload& upload, unsigned framebuffer,
                       const glm::ivec2& place) const {
    if (!are_apart()) {
        upload.show_again(framebuffer, place);
        return;
    }
    const auto [width, height] = upload.size();
    upload.show_in(framebuffer, seen_by(eye, {.x = place.x, .y = place.y, .width = width, .height = height}));
}

} // namespace frustumscreen::show

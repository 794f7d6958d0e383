#include "app/programs/frustumscreen/render/screen_painter.h"

#include "app/render/read_back.h"

namespace frustumscreen::programs {

Result<std::unique_ptr<ScreenPainter>> ScreenPainter::create(const settings::Settings& settings,
                                                             std::string_view eye, bool one_eye) {
    TRY(const EyeChoice choice, choose_eye(eye, settings::screen_stereo_of(settings), one_eye));
    const bool both = choice == EyeChoice::Both;
    const scene::FlatScreen screen =
        scene::flat_screen(settings.screen.corners_m, settings.screen.width, settings.screen.height);
    const scene::StereoLayout layout = scene::stereo_layout(
        screen.pinhole, both ? settings::screen_stereo_of(settings) : settings::Stereo::Off);
    std::unique_ptr<ScreenPainter> painter(new ScreenPainter(choice));
    TRY(painter->display_, display::SurfacelessDisplay::create(layout.display.width, layout.display.height));
    TRY(painter->room_, show::RoomShow::create(settings, {.both_eyes = both}));
    return painter;
}

ScreenPainter::~ScreenPainter() {
    if (display_) {
        static_cast<void>(display_->make_current()); // what is deleted now lives in its context
    }
}

void ScreenPainter::draw(double seconds, std::span<const glm::dvec3> eyes_m) {
    static_cast<void>(display_->make_current());
    static_cast<void>(room_->draw(seconds, eyes_m, {display_->framebuffer(), display_->buffer_age()},
                                  render::Redraw::Everything));
    static_cast<void>(display_->present(MonotonicTime{})); // cannot fail without a screen
}

image::Image8 ScreenPainter::picture() const {
    static_cast<void>(display_->make_current());
    return render::read_colour(display_->framebuffer(), display_->width(), display_->height());
}

} // namespace frustumscreen::programs

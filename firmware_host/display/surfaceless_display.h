/// A display without a screen: an OpenGL ES context through EGL without a window, and one framebuffer object.
///
/// For tests, the offline renderer and the headless exhibit. The framebuffer keeps each picture until the
/// next one is drawn, so its age is 1 after the first `present`.
///
/// Threads  the creating thread, on which the context is current.
/// Errors   EGL or OpenGL ES 3 missing; a picture larger than the driver allows.
#pragma once

#include "firmware_host/display/display.h"
#include "firmware_host/display/egl_context.h"
#include "firmware_host/display/picture_framebuffer.h"

#include <memory>

namespace frustumscreen::display {

class SurfacelessDisplay final : public Display {
public:
    [[nodiscard]] static Result<std::unique_ptr<SurfacelessDisplay>> create(int width, int height);

    [[nodiscard]] bool make_current() const override { return context_.make_current(); }
    [[nodiscard]] int width() const override { return picture_.width(); }
    [[nodiscard]] int height() const override { return picture_.height(); }
    [[nodiscard]] unsigned framebuffer() const override { return picture_.name(); }
    [[nodiscard]] int buffer_age() const override { return presented_ ? 1 : 0; }
    /// Waits until the picture is drawn. It is lit nowhere, so the returned time is `now`.
    [[nodiscard]] Result<MonotonicTime> present(MonotonicTime now) override;
    /// The driver's own name and version.
    [[nodiscard]] std::string name() const override { return gl_driver_name(); }

private:
    SurfacelessDisplay(EglContext context, PictureFramebuffer picture)
        : context_(std::move(context)), picture_(std::move(picture)) {}

    EglContext context_;
    PictureFramebuffer picture_;
    bool presented_ = false;
};

} // namespace frustumscreen::display

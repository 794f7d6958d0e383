/// A display without a screen: an OpenGL ES context through EGL on no window, and one framebuffer object.
///
/// For tests, the offline renderer and the headless exhibit. The picture stays in the framebuffer until the
/// next one is drawn, so its age is always 1.
///
/// Colour   SRGB8_ALPHA8: shaders write linear light, a read-back gives sRGB codes; depth 24, stencil 8.
/// Threads  the one that created it: the context is current there.
/// Errors   EGL or OpenGL ES 3 missing, a picture larger than the driver allows.
/// Source   EGL_MESA_platform_surfaceless, EGL_KHR_no_config_context, EGL_KHR_surfaceless_context.
#pragma once

#include "firmware_host/display/display.h"

#include <memory>

namespace frustumscreen {

class SurfacelessDisplay final : public Display {
public:
    [[nodiscard]] static Result<std::unique_ptr<SurfacelessDisplay>> create(int width, int height);
    ~SurfacelessDisplay() override;
    SurfacelessDisplay(const SurfacelessDisplay&) = delete;
    SurfacelessDisplay& operator=(const SurfacelessDisplay&) = delete;

    [[nodiscard]] int width() const override { return width_; }
    [[nodiscard]] int height() const override { return height_; }
    [[nodiscard]] unsigned framebuffer() const override { return framebuffer_; }
    [[nodiscard]] int buffer_age() const override { return presented_ ? 1 : 0; }
    /// Waits until the picture is drawn. Nothing lights it, so the time is `now`.
    [[nodiscard]] Result<MonotonicTime> present(MonotonicTime now) override;
    /// The driver's own name and version.
    [[nodiscard]] std::string name() const override;

private:
    SurfacelessDisplay() = default;
    [[nodiscard]] Result<void> make_context();
    [[nodiscard]] Result<void> make_framebuffer(int width, int height);

    void* egl_display_ = nullptr;
    void* context_ = nullptr;
    int width_ = 0;
    int height_ = 0;
    unsigned framebuffer_ = 0;
    unsigned colour_ = 0;
    unsigned depth_stencil_ = 0;
    bool presented_ = false;
};

} // namespace frustumscreen

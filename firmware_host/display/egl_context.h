/// An OpenGL ES 3 context that draws into framebuffer objects, without a window.
///
/// Threads  one context is current on one thread at a time.
/// Errors   EGL or OpenGL ES 3 missing.
/// Source   EGL_MESA_platform_surfaceless, EGL_KHR_platform_gbm, EGL_KHR_no_config_context,
///          EGL_KHR_surfaceless_context.
#pragma once

#include "firmware_host/base/result.h"

#include <memory>
#include <string>
#include <string_view>

namespace frustumscreen::display {

class EglContext {
public:
    /// A context without a screen; current afterwards.
    [[nodiscard]] static Result<EglContext> without_screen();
    /// A context on the card of a GBM device, which must outlive it; current afterwards.
    [[nodiscard]] static Result<EglContext> on_gbm(void* gbm_device);
    /// Another context with shared textures and buffers but its own state; not current.
    [[nodiscard]] Result<EglContext> sharing() const;

    ~EglContext();
    EglContext(EglContext&& other) noexcept;
    EglContext& operator=(EglContext&& other) noexcept;
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    [[nodiscard]] bool make_current() const;
    [[nodiscard]] bool has_extension(std::string_view name) const; ///< an extension of the EGL display
    [[nodiscard]] void* egl_display() const { return display_.get(); }

private:
    EglContext() = default;
    [[nodiscard]] static Result<EglContext> on(std::shared_ptr<void> display, void* share_with);

    std::shared_ptr<void> display_;
    void* context_ = nullptr;
};

/// The name and version of the current context's driver.
[[nodiscard]] std::string gl_driver_name();
/// Whether a driver of this name draws on the processor.
[[nodiscard]] bool draws_on_processor(std::string_view driver_name);
/// Whether the current context has this extension.
[[nodiscard]] bool has_gl_extension(std::string_view name);

} // namespace frustumscreen::display

#include "firmware_host/display/surfaceless_display.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl31.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace frustumscreen {

namespace {

tl::unexpected<Error> no_display(std::string_view what) {
    return fail(ErrorKind::BadConfiguration,
                fmt::format("display: {} (EGL error {:#06x}); install libegl1, libgles2 and libgl1-mesa-dri",
                            what, static_cast<unsigned>(eglGetError())));
}

bool has_extension(const char* list, std::string_view name) {
    const std::string_view all = list != nullptr ? list : "";
    for (std::size_t at = all.find(name); at != std::string_view::npos; at = all.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at == 0 || all[at - 1] == ' ') && (end == all.size() || all[end] == ' ')) {
            return true;
        }
    }
    return false;
}

} // namespace

Result<std::unique_ptr<SurfacelessDisplay>> SurfacelessDisplay::create(int width, int height) {
    std::unique_ptr<SurfacelessDisplay> display(new SurfacelessDisplay());
    if (Result<void> made = display->make_context(); !made) {
        return tl::unexpected<Error>(made.error());
    }
    if (Result<void> made = display->make_framebuffer(width, height); !made) {
        return tl::unexpected<Error>(made.error());
    }
    return display;
}

SurfacelessDisplay::~SurfacelessDisplay() {
    if (context_ != nullptr) {
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteRenderbuffers(1, &colour_);
        glDeleteRenderbuffers(1, &depth_stencil_);
        eglMakeCurrent(egl_display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(egl_display_, context_);
    }
    // The EGL display is shared by the whole process; terminating it would end other contexts.
}

Result<void> SurfacelessDisplay::make_context() {
    if (!has_extension(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless")) {
        return no_display("this EGL cannot draw without a screen (no EGL_MESA_platform_surfaceless)");
    }
    const auto get_platform_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (get_platform_display == nullptr) {
        return no_display("this EGL has no eglGetPlatformDisplayEXT");
    }
    egl_display_ = get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (egl_display_ == EGL_NO_DISPLAY || eglInitialize(egl_display_, nullptr, nullptr) != EGL_TRUE) {
        return no_display("EGL does not start without a screen");
    }
    const char* extensions = eglQueryString(egl_display_, EGL_EXTENSIONS);
    if (!has_extension(extensions, "EGL_KHR_no_config_context") ||
        !has_extension(extensions, "EGL_KHR_surfaceless_context")) {
        return no_display("this EGL makes no context without a window");
    }
    constexpr std::array<EGLint, 5> version{EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0,
                                            EGL_NONE};
    if (eglBindAPI(EGL_OPENGL_ES_API) != EGL_TRUE) {
        return no_display("this EGL has no OpenGL ES");
    }
    context_ = eglCreateContext(egl_display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version.data());
    if (context_ == EGL_NO_CONTEXT) {
        return no_display("the driver has no OpenGL ES 3");
    }
    if (eglMakeCurrent(egl_display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
        return no_display("the OpenGL ES context cannot be made current");
    }
    return {};
}

Result<void> SurfacelessDisplay::make_framebuffer(int width, int height) {
    GLint limit = 0;
    GLint renderbuffer_limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer_limit);
    limit = std::min(limit, renderbuffer_limit);
    if (width < 1 || height < 1 || width > limit || height > limit) {
        return fail(
            ErrorKind::BadConfiguration,
            fmt::format("display: a picture of {} x {} pixels; this driver draws 1 to {} on each side", width,
                        height, limit));
    }
    width_ = width;
    height_ = height;
    glGenFramebuffers(1, &framebuffer_);
    glGenRenderbuffers(1, &colour_);
    glGenRenderbuffers(1, &depth_stencil_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glBindRenderbuffer(GL_RENDERBUFFER, colour_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
    glBindRenderbuffer(GL_RENDERBUFFER, depth_stencil_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth_stencil_);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE || glGetError() != GL_NO_ERROR) {
        return fail(
            ErrorKind::BadConfiguration,
            fmt::format(
                "display: the driver cannot hold a picture of {} x {} pixels; configure a smaller one", width,
                height));
    }
    return {};
}

Result<MonotonicTime> SurfacelessDisplay::present(MonotonicTime now) {
    glFinish();
    presented_ = true;
    return now;
}

std::string SurfacelessDisplay::name() const {
    const auto text = [](GLenum which) {
        const GLubyte* s = glGetString(which);
        return s != nullptr ? std::string(reinterpret_cast<const char*>(s)) : std::string("unknown");
    };
    return text(GL_RENDERER) + ", " + text(GL_VERSION);
}

} // namespace frustumscreen

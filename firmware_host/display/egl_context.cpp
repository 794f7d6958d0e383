#include "firmware_host/display/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl31.h>
#include <fmt/format.h>

#include <array>
#include <utility>

namespace frustumscreen::display {

namespace {

tl::unexpected<Error> no_display(std::string_view what) {
    return fail(ErrorKind::BadConfiguration, "display.egl",
                "display: {} (EGL error {:#06x}); install libegl1, libgles2 and libgl1-mesa-dri", what,
                static_cast<unsigned>(eglGetError()));
}

bool lists(const char* list, std::string_view name) {
    const std::string_view all = list != nullptr ? list : "";
    for (std::size_t at = all.find(name); at != std::string_view::npos; at = all.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at == 0 || all[at - 1] == ' ') && (end == all.size() || all[end] == ' ')) {
            return true;
        }
    }
    return false;
}

EGLDisplay platform_display(EGLenum platform, void* native) {
    const auto get =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    return get != nullptr ? get(platform, native, nullptr) : EGL_NO_DISPLAY;
}

} // namespace

Result<EglContext> EglContext::without_screen() {
    if (!lists(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless")) {
        return no_display("this EGL cannot draw without a screen (no EGL_MESA_platform_surfaceless)");
    }
    EGLDisplay display = platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
        return no_display("EGL does not start without a screen");
    }
    // The whole process shares this display; terminating it would end other contexts.
    return on(std::shared_ptr<void>(display, [](void*) {}), nullptr);
}

Result<EglContext> EglContext::on_gbm(void* gbm_device) {
    EGLDisplay display = platform_display(EGL_PLATFORM_GBM_KHR, gbm_device);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
        return no_display("EGL does not start on the graphics card");
    }
    return on(std::shared_ptr<void>(display, [](void* shown) { eglTerminate(shown); }), nullptr);
}

Result<EglContext> EglContext::sharing() const {
    return on(display_, context_);
}

Result<EglContext> EglContext::on(std::shared_ptr<void> display, void* share_with) {
    EglContext context;
    context.display_ = std::move(display);
    if (!context.has_extension("EGL_KHR_no_config_context") ||
        !context.has_extension("EGL_KHR_surfaceless_context")) {
        return no_display("this EGL makes no context without a window");
    }
    constexpr std::array<EGLint, 5> version{EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0,
                                            EGL_NONE};
    if (eglBindAPI(EGL_OPENGL_ES_API) != EGL_TRUE) {
        return no_display("this EGL has no OpenGL ES");
    }
    context.context_ =
        eglCreateContext(context.display_.get(), EGL_NO_CONFIG_KHR, share_with, version.data());
    if (context.context_ == EGL_NO_CONTEXT) {
        return no_display("the driver has no OpenGL ES 3");
    }
    if (share_with == nullptr && !context.make_current()) {
        return no_display("the OpenGL ES context cannot be made current");
    }
    return context;
}

EglContext::~EglContext() {
    if (context_ == nullptr) {
        return;
    }
    if (eglGetCurrentContext() == context_) {
        eglMakeCurrent(display_.get(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglDestroyContext(display_.get(), context_);
}

EglContext::EglContext(EglContext&& other) noexcept
    : display_(std::move(other.display_)), context_(std::exchange(other.context_, nullptr)) {}

EglContext& EglContext::operator=(EglContext&& other) noexcept {
    std::swap(display_, other.display_);
    std::swap(context_, other.context_);
    return *this;
}

bool EglContext::make_current() const {
    return eglMakeCurrent(display_.get(), EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
}

bool EglContext::has_extension(std::string_view name) const {
    return lists(eglQueryString(display_.get(), EGL_EXTENSIONS), name);
}

std::string gl_driver_name() {
    const auto text = [](GLenum which) {
        const GLubyte* s = glGetString(which);
        return s != nullptr ? std::string(reinterpret_cast<const char*>(s)) : std::string("unknown");
    };
    return text(GL_RENDERER) + ", " + text(GL_VERSION);
}

/// The names of Mesa's three software renderers.
bool draws_on_processor(std::string_view driver_name) {
    return driver_name.starts_with("llvmpipe") || driver_name.starts_with("softpipe") ||
           driver_name.starts_with("Software Rasterizer");
}

bool has_gl_extension(std::string_view name) {
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint k = 0; k < count; ++k) {
        const GLubyte* listed = glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(k));
        if (listed != nullptr && name == reinterpret_cast<const char*>(listed)) {
            return true;
        }
    }
    return false;
}

} // namespace frustumscreen::display

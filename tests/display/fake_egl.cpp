// EGL on the fake kernel's GBM devices, by the linker's --wrap: Mesa's software renderer draws, under the
// GPU's name. All other displays are Mesa's own.
//
// Source   EGL_KHR_platform_gbm: the device outlives its display; EGL_KHR_image_base, EGL_KHR_image_pixmap.
#include "tests/display/fake_gbm.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES2/gl2.h>
#include <GLES2/gl2ext.h>
#include <GLES3/gl3.h>

using namespace frustumscreen;
using namespace frustumscreen::display;

extern "C" {
__eglMustCastToProperFunctionPointerType __real_eglGetProcAddress(const char* name);
EGLBoolean __real_eglInitialize(EGLDisplay display, EGLint* major, EGLint* minor);
EGLBoolean __real_eglTerminate(EGLDisplay display);
const char* __real_eglQueryString(EGLDisplay display, EGLint name);
EGLContext __real_eglCreateContext(EGLDisplay display, EGLConfig config, EGLContext shared,
                                   const EGLint* wanted);
EGLBoolean __real_eglDestroyContext(EGLDisplay display, EGLContext context);
EGLBoolean __real_eglMakeCurrent(EGLDisplay display, EGLSurface draw, EGLSurface read, EGLContext context);
const GLubyte* __real_glGetString(GLenum name);
}

namespace {

/// A display on a GBM device.
struct GbmDisplay {
    std::string renderer;
    EGLDisplay processor = EGL_NO_DISPLAY; ///< the renderer
};

std::map<const void*, GbmDisplay> displays; ///< by device pointer, which serves as the display's handle
std::map<EGLContext, const GbmDisplay*> contexts;

EGLDisplay real(EGLDisplay display) {
    const auto found = displays.find(display);
    return found != displays.end() ? found->second.processor : display;
}

bool fails(std::string_view call) {
    return FakeKernel::is_there() && FakeKernel::instance().enter(call) != 0;
}

EGLDisplay get_platform_display(EGLenum platform, void* native, const EGLint* wanted) {
    const auto get = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        __real_eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (fails("eglGetPlatformDisplayEXT")) {
        return EGL_NO_DISPLAY;
    }
    if (platform != EGL_PLATFORM_GBM_KHR) {
        return get(platform, native, wanted);
    }
    displays[native] = {static_cast<gbm_device*>(native)->renderer,
                        get(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)};
    return native;
}

EGLImageKHR create_image(EGLDisplay /*display*/, EGLContext /*context*/, EGLenum /*kind*/,
                         EGLClientBuffer buffer, const EGLint* /*wanted*/) {
    if (fails("eglCreateImageKHR")) {
        return EGL_NO_IMAGE_KHR;
    }
    const auto made = std::make_shared<gbm_bo>(*static_cast<gbm_bo*>(buffer));
    FakeKernel::instance().hand_out(made.get(), "EGL image", made);
    return made.get();
}

EGLBoolean destroy_image(EGLDisplay /*display*/, EGLImageKHR image) {
    FakeKernel::instance().give_back(image, "EGL image");
    return EGL_TRUE;
}

/// Without storage the framebuffer is incomplete, like memory that a driver cannot draw into.
void storage_of_image(GLenum target, GLeglImageOES image) {
    if (!fails("glEGLImageTargetRenderbufferStorageOES")) {
        const auto* buffer = static_cast<const gbm_bo*>(image);
        glRenderbufferStorage(target, GL_RGBA8, buffer->width, buffer->height);
    }
}

template <typename T> __eglMustCastToProperFunctionPointerType address_of(T* function) {
    return reinterpret_cast<__eglMustCastToProperFunctionPointerType>(function);
}

} // namespace

extern "C" {

__eglMustCastToProperFunctionPointerType __wrap_eglGetProcAddress(const char* name) {
    const std::string_view asked = name;
    if (asked == "eglGetPlatformDisplayEXT") {
        return address_of(get_platform_display);
    }
    if (asked == "eglCreateImageKHR") {
        return address_of(create_image);
    }
    if (asked == "eglDestroyImageKHR") {
        return address_of(destroy_image);
    }
    if (asked == "glEGLImageTargetRenderbufferStorageOES") {
        return address_of(storage_of_image);
    }
    return __real_eglGetProcAddress(name);
}

EGLBoolean __wrap_eglInitialize(EGLDisplay display, EGLint* major, EGLint* minor) {
    if (fails("eglInitialize") || __real_eglInitialize(real(display), major, minor) != EGL_TRUE) {
        return EGL_FALSE;
    }
    if (displays.contains(display)) {
        FakeKernel::instance().hand_out(&displays.at(display), "EGL display");
    }
    return EGL_TRUE;
}

/// The software renderer's display is shared and stays initialised.
EGLBoolean __wrap_eglTerminate(EGLDisplay display) {
    const auto found = displays.find(display);
    if (found == displays.end()) {
        return __real_eglTerminate(display);
    }
    FakeKernel& kernel = FakeKernel::instance();
    if (!kernel.handed_out(display)) {
        kernel.give_back(display, "GBM device"); // the device was destroyed before its display: an error
    }
    kernel.give_back(&found->second, "EGL display");
    displays.erase(found);
    return EGL_TRUE;
}

const char* __wrap_eglQueryString(EGLDisplay display, EGLint name) {
    return __real_eglQueryString(real(display), name);
}

EGLContext __wrap_eglCreateContext(EGLDisplay display, EGLConfig config, EGLContext shared,
                                   const EGLint* wanted) {
    if (fails("eglCreateContext")) {
        return EGL_NO_CONTEXT;
    }
    EGLContext context = __real_eglCreateContext(real(display), config, shared, wanted);
    contexts[context] = displays.contains(display) ? &displays.at(display) : nullptr;
    if (FakeKernel::is_there()) {
        FakeKernel::instance().hand_out(context, "EGL context");
    }
    return context;
}

EGLBoolean __wrap_eglDestroyContext(EGLDisplay display, EGLContext context) {
    contexts.erase(context);
    if (FakeKernel::is_there()) {
        FakeKernel::instance().give_back(context, "EGL context");
    }
    return __real_eglDestroyContext(real(display), context);
}

/// If it must fail, the context is released nevertheless: otherwise Mesa keeps the context that is destroyed
/// next.
EGLBoolean __wrap_eglMakeCurrent(EGLDisplay display, EGLSurface draw, EGLSurface read, EGLContext context) {
    const bool refused = fails("eglMakeCurrent");
    const bool done = (!refused || context == EGL_NO_CONTEXT) &&
                      __real_eglMakeCurrent(real(display), draw, read, context) == EGL_TRUE;
    return done && !refused ? EGL_TRUE : EGL_FALSE;
}

const GLubyte* __wrap_glGetString(GLenum name) {
    const auto current = contexts.find(eglGetCurrentContext());
    const GbmDisplay* const display = current != contexts.end() ? current->second : nullptr;
    return name == GL_RENDERER && display != nullptr && !display->renderer.empty()
               ? reinterpret_cast<const GLubyte*>(display->renderer.c_str())
               : __real_glGetString(name);
}

} // extern "C"

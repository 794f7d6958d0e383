/// Names of OpenGL objects as move-only values.
///
/// Threads  the render thread, with its context current, also at destruction.
#pragma once

#include <GLES3/gl31.h>

#include <utility>

namespace frustumscreen::gl {

template <typename Kind> class GlHandle {
public:
    GlHandle() = default;
    [[nodiscard]] static GlHandle generate() {
        GlHandle handle;
        handle.name_ = Kind::generate();
        return handle;
    }
    GlHandle(GlHandle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlHandle& operator=(GlHandle&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~GlHandle() {
        if (name_ != 0) {
            Kind::destroy(name_);
        }
    }
    [[nodiscard]] GLuint get() const { return name_; }

private:
    GLuint name_ = 0;
};

namespace gl_kind {
// glGenX and glDeleteX have one signature for most kinds of objects.
template <auto Generate, auto Destroy> struct Counted {
    static GLuint generate() {
        GLuint name = 0;
        Generate(1, &name);
        return name;
    }
    static void destroy(GLuint name) { Destroy(1, &name); }
};
struct Program {
    static GLuint generate() { return glCreateProgram(); }
    static void destroy(GLuint name) { glDeleteProgram(name); }
};
} // namespace gl_kind

using GlBuffer = GlHandle<gl_kind::Counted<glGenBuffers, glDeleteBuffers>>;
using GlTexture = GlHandle<gl_kind::Counted<glGenTextures, glDeleteTextures>>;
using GlVertexArray = GlHandle<gl_kind::Counted<glGenVertexArrays, glDeleteVertexArrays>>;
using GlFramebuffer = GlHandle<gl_kind::Counted<glGenFramebuffers, glDeleteFramebuffers>>;
using GlRenderbuffer = GlHandle<gl_kind::Counted<glGenRenderbuffers, glDeleteRenderbuffers>>;
using GlSampler = GlHandle<gl_kind::Counted<glGenSamplers, glDeleteSamplers>>;
using GlProgram = GlHandle<gl_kind::Program>;

} // namespace frustumscreen::gl

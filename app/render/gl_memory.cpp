#include "app/render/gl_memory.h"

#include <array>
#include <initializer_list>

namespace frustumscreen::render {

namespace {

std::uint64_t bytes_of(int width, int height, int bits) {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) *
           static_cast<std::uint64_t>(bits) / 8;
}

} // namespace

std::string renderer_name() {
    const GLubyte* const name = glGetString(GL_RENDERER);
    return name != nullptr ? reinterpret_cast<const char*>(name) : "an unnamed GPU";
}

std::uint64_t bytes_of_buffer(const gl::GlBuffer& buffer) {
    GLint64 bytes = 0;
    glBindBuffer(GL_COPY_READ_BUFFER, buffer.get());
    glGetBufferParameteri64v(GL_COPY_READ_BUFFER, GL_BUFFER_SIZE, &bytes);
    glBindBuffer(GL_COPY_READ_BUFFER, 0);
    return static_cast<std::uint64_t>(bytes);
}

std::uint64_t bytes_of_texture(const gl::GlTexture& texture) {
    if (texture.get() == 0) {
        return 0;
    }
    const auto ask = [](int level, GLenum what) {
        GLint value = 0;
        glGetTexLevelParameteriv(GL_TEXTURE_2D, level, what, &value);
        return value;
    };
    constexpr std::array<GLenum, 6> components{GL_TEXTURE_RED_SIZE,   GL_TEXTURE_GREEN_SIZE,
                                               GL_TEXTURE_BLUE_SIZE,  GL_TEXTURE_ALPHA_SIZE,
                                               GL_TEXTURE_DEPTH_SIZE, GL_TEXTURE_STENCIL_SIZE};
    glBindTexture(GL_TEXTURE_2D, texture.get());
    GLint levels = 0;
    glGetTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_IMMUTABLE_LEVELS, &levels);
    std::uint64_t bytes = 0;
    for (int level = 0; level < levels; ++level) {
        int bits = 0;
        for (const GLenum component : components) {
            bits += ask(level, component);
        }
        bytes += bytes_of(ask(level, GL_TEXTURE_WIDTH), ask(level, GL_TEXTURE_HEIGHT), bits);
    }
    return bytes;
}

std::uint64_t bytes_of_renderbuffer(const gl::GlRenderbuffer& renderbuffer) {
    if (renderbuffer.get() == 0) {
        return 0;
    }
    const auto ask = [](GLenum what) {
        GLint value = 0;
        glGetRenderbufferParameteriv(GL_RENDERBUFFER, what, &value);
        return value;
    };
    glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer.get());
    int bits = 0;
    for (const GLenum component : std::initializer_list<GLenum>{
             GL_RENDERBUFFER_RED_SIZE, GL_RENDERBUFFER_GREEN_SIZE, GL_RENDERBUFFER_BLUE_SIZE,
             GL_RENDERBUFFER_ALPHA_SIZE, GL_RENDERBUFFER_DEPTH_SIZE, GL_RENDERBUFFER_STENCIL_SIZE}) {
        bits += ask(component);
    }
    return bytes_of(ask(GL_RENDERBUFFER_WIDTH), ask(GL_RENDERBUFFER_HEIGHT), bits);
}

} // namespace frustumscreen::render

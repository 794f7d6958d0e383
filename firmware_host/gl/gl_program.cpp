#include "firmware_host/gl/gl_program.h"

#include <fmt/format.h>

#include <array>

namespace frustumscreen::gl {

namespace {

constexpr std::string_view prologue = "#version 300 es\n"
                                      "precision highp float;\n"
                                      "precision highp int;\n"
                                      "precision highp sampler2D;\n";

tl::unexpected<Error> refused(std::string_view what, std::string_view log) {
    return fail(ErrorKind::Internal, "gl.refused", "OpenGL: the driver refuses the {}: {}", what,
                log.substr(0, log.find('\n')));
}

Result<void> attach(GLuint program, GLenum stage, std::string_view defines, std::string_view body) {
    const GLuint shader = glCreateShader(stage);
    const std::array<const char*, 3> text{prologue.data(), defines.data(), body.data()};
    const std::array<GLint, 3> length{static_cast<GLint>(prologue.size()), static_cast<GLint>(defines.size()),
                                      static_cast<GLint>(body.size())};
    glShaderSource(shader, 3, text.data(), length.data());
    glCompileShader(shader);
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    std::array<char, 512> log{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    glAttachShader(program, shader);
    glDeleteShader(shader); // freed with the program
    if (compiled != GL_TRUE) {
        return refused(stage == GL_VERTEX_SHADER ? "vertex shader" : "fragment shader", log.data());
    }
    return {};
}

} // namespace

Result<GlProgram> make_program(std::string_view defines, std::string_view vertex, std::string_view fragment) {
    GlProgram program = GlProgram::generate();
    TRY_VOID(attach(program.get(), GL_VERTEX_SHADER, defines, vertex));
    TRY_VOID(attach(program.get(), GL_FRAGMENT_SHADER, defines, fragment));
    glLinkProgram(program.get());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.get(), GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
        std::array<char, 512> log{};
        glGetProgramInfoLog(program.get(), static_cast<GLsizei>(log.size()), nullptr, log.data());
        return refused("program", log.data());
    }
    return program;
}

} // namespace frustumscreen::gl

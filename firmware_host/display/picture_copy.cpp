#include "firmware_host/display/picture_copy.h"

#include <GLES2/gl2.h>
#include <GLES2/gl2ext.h>
#include <GLES3/gl31.h>

#include <array>
#include <string_view>
#include <utility>

namespace frustumscreen {

namespace {

/// One triangle over the whole viewport; `top_is_last` turns the picture upside down.
constexpr const char* vertex_shader = R"(#version 300 es
uniform bool top_is_last;
out highp vec2 at;
void main() {
    vec2 corner = vec2(float((gl_VertexID & 1) << 1), float(gl_VertexID & 2));
    at = vec2(corner.x, top_is_last ? 1.0 - corner.y : corner.y);
    gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
)";

constexpr const char* exact_shader = R"(#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D picture;
in vec2 at;
out vec4 code;
void main() {
    code = vec4(textureLod(picture, at, 0.0).rgb, 1.0);
}
)";

constexpr const char* scaled_shader = R"(#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D picture;
in vec2 at;
out vec4 code;
void main() {
    vec3 light = textureLod(picture, at, 0.0).rgb;
    vec3 low = 12.92 * light;
    vec3 high = 1.055 * pow(max(light, 0.0031308), vec3(1.0 / 2.4)) - 0.055;
    code = vec4(mix(high, low, lessThanEqual(light, vec3(0.0031308))), 1.0);
}
)";

bool has_extension(std::string_view name) {
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

unsigned compile(GLenum kind, const char* text) {
    const unsigned shader = glCreateShader(kind);
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    return shader;
}

/// 0: it does not link.
unsigned make_program(const char* fragment_text) {
    const unsigned vertex = compile(GL_VERTEX_SHADER, vertex_shader);
    const unsigned fragment = compile(GL_FRAGMENT_SHADER, fragment_text);
    unsigned program = glCreateProgram();
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
    glLinkProgram(program);
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
        glDeleteProgram(program);
        program = 0;
    }
    return program;
}

unsigned make_sampler(GLint filter) {
    unsigned sampler = 0;
    glGenSamplers(1, &sampler);
    glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, filter);
    glSamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, filter);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return sampler;
}

} // namespace

Result<PictureCopy> PictureCopy::create() {
    PictureCopy copy;
    const bool codes_as_they_are = has_extension("GL_EXT_texture_sRGB_decode");
    glGenVertexArrays(1, &copy.vertices_);
    copy.light_ = make_sampler(GL_LINEAR);
    copy.codes_ = make_sampler(GL_NEAREST);
    if (codes_as_they_are) {
        glSamplerParameteri(copy.codes_, GL_TEXTURE_SRGB_DECODE_EXT, GL_SKIP_DECODE_EXT);
    }
    copy.exact_ = make_program(codes_as_they_are ? exact_shader : scaled_shader);
    copy.scaled_ = make_program(scaled_shader);
    if (copy.exact_ == 0 || copy.scaled_ == 0) {
        return fail(ErrorKind::BadConfiguration,
                    "display: the driver does not take the shaders that copy the picture to the screen; "
                    "another driver is needed");
    }
    return copy;
}

PictureCopy::~PictureCopy() {
    if (vertices_ != 0) {
        glDeleteProgram(exact_);
        glDeleteProgram(scaled_);
        glDeleteVertexArrays(1, &vertices_);
        glDeleteSamplers(1, &codes_);
        glDeleteSamplers(1, &light_);
    }
}

PictureCopy::PictureCopy(PictureCopy&& other) noexcept
    : exact_(other.exact_), scaled_(other.scaled_), vertices_(std::exchange(other.vertices_, 0U)),
      codes_(other.codes_), light_(other.light_) {}

PictureCopy& PictureCopy::operator=(PictureCopy&& other) noexcept {
    std::swap(exact_, other.exact_);
    std::swap(scaled_, other.scaled_);
    std::swap(vertices_, other.vertices_);
    std::swap(codes_, other.codes_);
    std::swap(light_, other.light_);
    return *this;
}

void PictureCopy::draw(const PictureFramebuffer& picture, PixelSize target, TopRow top,
                       const PixelPlace& part) const {
    const PixelSize size{picture.width(), picture.height()};
    const PixelPlace place = letterbox(size, target);
    const bool same = size == target;
    if (part == PixelPlace{0, 0, size.width, size.height} &&
        !(place == PixelPlace{0, 0, target.width, target.height})) {
        glDisable(GL_SCISSOR_TEST);
        glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
        glClear(GL_COLOR_BUFFER_BIT);
    }
    const auto first_row = [&](const PixelPlace& of) {
        return top == TopRow::First ? of.y : target.height - of.y - of.height;
    };
    const PixelPlace changed = part_on_screen(part, size, place);
    glEnable(GL_SCISSOR_TEST);
    glScissor(changed.x, first_row(changed), changed.width, changed.height);
    glViewport(place.x, first_row(place), place.width, place.height);
    const unsigned program = same ? exact_ : scaled_;
    glUseProgram(program);
    glUniform1i(glGetUniformLocation(program, "top_is_last"), top == TopRow::Last ? 1 : 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, picture.texture());
    glBindSampler(0, same ? codes_ : light_);
    glBindVertexArray(vertices_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindTexture(GL_TEXTURE_2D, 0);
}

} // namespace frustumscreen

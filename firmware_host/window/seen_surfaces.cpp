#include "firmware_host/window/seen_surfaces.h"

#include "firmware_host/gl/gl_program.h"

#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace frustumscreen::window {

namespace {

constexpr std::string_view vertex_shader = R"(
layout(location = 0) in vec4 clip;
layout(location = 1) in vec3 picture_at;
layout(location = 2) in float gain;
layout(location = 3) in vec3 own;
out vec3 at;
out float picture_gain;
out vec3 own_light;
void main() {
    at = picture_at;
    picture_gain = gain;
    own_light = own;
    gl_Position = clip;
}
)";

constexpr std::string_view fragment_shader = R"(
uniform sampler2D picture;
in vec3 at;
in float picture_gain;
in vec3 own_light;
out vec4 code;
void main() {
    vec2 uv = at.xy / at.z;
    bool inside = all(greaterThanEqual(uv, vec2(0.0))) && all(lessThanEqual(uv, vec2(1.0)));
    vec3 light = own_light + (inside ? picture_gain * textureLod(picture, uv, 0.0).rgb : vec3(0.0));
    light = clamp(light, 0.0, 1.0);
    vec3 high = 1.055 * pow(max(light, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
    code = vec4(mix(high, 12.92 * light, lessThanEqual(light, vec3(0.0031308))), 1.0);
}
)";

void attribute(GLuint location, GLint numbers, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, numbers, GL_FLOAT, GL_FALSE, sizeof(SeenVertex),
                          reinterpret_cast<const void*>(offset)); // NOLINT(performance-no-int-to-ptr)
}

} // namespace

Result<SeenSurfacesPass> SeenSurfacesPass::create() {
    TRY(gl::GlProgram program, gl::make_program("", vertex_shader, fragment_shader));
    return SeenSurfacesPass(std::move(program));
}

SeenSurfacesPass::SeenSurfacesPass(gl::GlProgram program) : program_(std::move(program)) {
    for (const GLenum filter : std::initializer_list<GLenum>{GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
        glSamplerParameteri(sampler_.get(), filter, GL_LINEAR);
    }
    for (const GLenum wrap : std::initializer_list<GLenum>{GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
        glSamplerParameteri(sampler_.get(), wrap, GL_CLAMP_TO_EDGE);
    }
    glBindVertexArray(vertices_.get());
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.get());
    attribute(0, 4, offsetof(SeenVertex, clip));
    attribute(1, 3, offsetof(SeenVertex, picture));
    attribute(2, 1, offsetof(SeenVertex, gain));
    attribute(3, 3, offsetof(SeenVertex, own));
    glBindVertexArray(0);
}

void SeenSurfacesPass::draw(const std::vector<SeenVertex>& vertices, GLenum shape) const {
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(SeenVertex)),
                 vertices.data(), GL_STREAM_DRAW);
    glDrawArrays(shape, 0, static_cast<GLsizei>(vertices.size()));
}

void SeenSurfacesPass::draw(const display::PictureFramebuffer& picture, const SeenSurfaces& seen,
                            const PixelRectangle& place) const {
    glEnable(GL_SCISSOR_TEST);
    glScissor(place.x, place.y, place.width, place.height);
    glViewport(place.x, place.y, place.width, place.height);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    glUseProgram(program_.get());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, picture.texture());
    glBindSampler(0, sampler_.get());
    glBindVertexArray(vertices_.get());
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.get());
    draw(seen.triangles, GL_TRIANGLES);
    draw(seen.lines, GL_LINES);
    glBindVertexArray(0);
    glBindTexture(GL_TEXTURE_2D, 0);
}

} // namespace frustumscreen::window

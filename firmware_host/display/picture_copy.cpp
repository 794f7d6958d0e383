#include "firmware_host/display/picture_copy.h"

#include "firmware_host/base/probe_code.h"
#include "firmware_host/display/egl_context.h"
#include "firmware_host/gl/gl_program.h"

#include <GLES2/gl2.h>
#include <GLES2/gl2ext.h>
#include <GLES3/gl31.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace frustumscreen::display {

namespace {

/// One triangle that covers the viewport; `top_is_last` turns the picture upside down. `rows`: the first row shown and the
/// number of rows, as shares of the picture.
constexpr std::string_view vertex_shader = R"(
uniform bool top_is_last;
uniform vec2 rows;
out vec2 at;
void main() {
    vec2 corner = vec2(float((gl_VertexID & 1) << 1), float(gl_VertexID & 2));
    at = vec2(corner.x, rows.x + rows.y * (top_is_last ? 1.0 - corner.y : corner.y));
    gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
)";

/// `inside`: the first and the last row that the interpolation may touch, as shares of the picture.
constexpr std::string_view shader_of_codes = R"(
uniform sampler2D picture;
uniform vec2 inside;
in vec2 at;
out vec4 code;
void main() {
    code = vec4(textureLod(picture, vec2(at.x, clamp(at.y, inside.x, inside.y)), 0.0).rgb, 1.0);
}
)";

/// For drivers without EXT_texture_sRGB_decode, which decode every texel they read.
constexpr std::string_view shader_of_light = R"(
uniform sampler2D picture;
uniform vec2 inside;
in vec2 at;
out vec4 code;
void main() {
    vec3 light = textureLod(picture, vec2(at.x, clamp(at.y, inside.x, inside.y)), 0.0).rgb;
    vec3 low = 12.92 * light;
    vec3 high = 1.055 * pow(max(light, 0.0031308), vec3(1.0 / 2.4)) - 0.055;
    code = vec4(mix(high, low, lessThanEqual(light, vec3(0.0031308))), 1.0);
}
)";

gl::GlSampler make_sampler(GLint filter, bool of_codes) {
    gl::GlSampler sampler = gl::GlSampler::generate();
    glSamplerParameteri(sampler.get(), GL_TEXTURE_MIN_FILTER, filter);
    glSamplerParameteri(sampler.get(), GL_TEXTURE_MAG_FILTER, filter);
    glSamplerParameteri(sampler.get(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(sampler.get(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    if (of_codes) {
        glSamplerParameteri(sampler.get(), GL_TEXTURE_SRGB_DECODE_EXT, GL_SKIP_DECODE_EXT);
    }
    return sampler;
}

} // namespace

Result<PictureCopy> PictureCopy::create(int stacked) {
    const bool of_codes = has_gl_extension("GL_EXT_texture_sRGB_decode");
    TRY(gl::GlProgram program,
        gl::make_program("", vertex_shader, of_codes ? shader_of_codes : shader_of_light));
    return PictureCopy(stacked, std::move(program), make_sampler(GL_NEAREST, of_codes),
                       make_sampler(GL_LINEAR, of_codes));
}

PictureCopy::PictureCopy(int stacked, gl::GlProgram program, gl::GlSampler nearest,
                         gl::GlSampler interpolated)
    : stacked_(stacked), program_(std::move(program)), nearest_(std::move(nearest)),
      interpolated_(std::move(interpolated)) {}

/// Draws picture number `number` of `count` above each other at `place`, but writes only the pixels of `part`; rows are the
/// target's.
struct PictureCopy::Pass {
    bool exact = true;
    TopRow top = TopRow::First;
    PixelRectangle place;
    PixelRectangle part;
    int number = 0;
    int count = 1;
};

void PictureCopy::draw(const PictureFramebuffer& picture, const Pass& pass) const {
    glEnable(GL_SCISSOR_TEST);
    glScissor(pass.part.x, pass.part.y, pass.part.width, pass.part.height);
    glViewport(pass.place.x, pass.place.y, pass.place.width, pass.place.height);
    glUseProgram(program_.get());
    glUniform1i(glGetUniformLocation(program_.get(), "top_is_last"), pass.top == TopRow::Last ? 1 : 0);
    const float rows = 1.0F / static_cast<float>(pass.count);
    const float first = rows * static_cast<float>(pass.number);
    const float edge = pass.count > 1 ? 0.5F / static_cast<float>(picture.height()) : 0.0F;
    glUniform2f(glGetUniformLocation(program_.get(), "rows"), first, rows);
    glUniform2f(glGetUniformLocation(program_.get(), "inside"), first + edge, first + rows - edge);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, picture.texture());
    glBindSampler(0, (pass.exact ? nearest_ : interpolated_).get());
    glBindVertexArray(vertices_.get());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindTexture(GL_TEXTURE_2D, 0);
}

PixelRectangle PictureCopy::draw(const PictureFramebuffer& picture, PixelSize target, TopRow top,
                                 const PixelRectangle& part) const {
    const PixelSize size{picture.width(), picture.height()};
    const PixelRectangle screen{.x = 0, .y = 0, .width = target.width, .height = target.height};
    const bool same = size == target;
    const int count = same ? 1 : stacked_;
    const PixelSize one{size.width, size.height / count};
    const PixelSize space{target.width, std::max(target.height / count, 1)};
    const PixelRectangle place = letterbox(one, space);
    PixelRectangle drawn;
    if (part == PixelRectangle{.x = 0, .y = 0, .width = size.width, .height = size.height} &&
        !(place == PixelRectangle{.x = 0, .y = 0, .width = space.width, .height = space.height})) {
        glDisable(GL_SCISSOR_TEST);
        glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
        glClear(GL_COLOR_BUFFER_BIT);
        drawn = screen;
    }
    const auto in_target = [&](const PixelRectangle& of) {
        const int first_row = top == TopRow::First ? of.y : target.height - of.y - of.height;
        return PixelRectangle{.x = of.x, .y = first_row, .width = of.width, .height = of.height};
    };
    for (int number = 0; number < count; ++number) {
        PixelRectangle own =
            intersected(part, {.x = 0, .y = number * one.height, .width = one.width, .height = one.height});
        if (own.empty()) {
            continue;
        }
        own.y -= number * one.height;
        const auto below = [&](PixelRectangle of) {
            of.y += number * space.height;
            return of;
        };
        const PixelRectangle there = below(part_on_screen(own, one, place));
        draw(picture, {.exact = same,
                       .top = top,
                       .place = in_target(below(place)),
                       .part = in_target(there),
                       .number = number,
                       .count = count});
        drawn = united(drawn, there);
    }
    if (same) {
        return drawn;
    }
    const PixelRectangle code{
        .x = 0, .y = 0, .width = std::min({probe_pixels, size.width, target.width}), .height = 1};
    draw(picture, {.exact = true,
                   .top = top,
                   .place = in_target({.x = 0, .y = 0, .width = size.width, .height = size.height}),
                   .part = in_target(code)});
    return united(drawn, code);
}

} // namespace frustumscreen::display

#include "app/bench/techniques/floor.h"

#include "app/image/image.h"
#include "firmware_host/gl/gl_program.h"

#include <glm/gtc/type_ptr.hpp>

#include <array>
#include <string_view>

namespace frustumscreen {

namespace {

constexpr int texels = 1024;

constexpr std::string_view vertex = R"(
uniform vec4 corners[4];
out vec2 at;
void main() {
    gl_Position = corners[gl_VertexID];
    at = vec2(gl_VertexID == 1 || gl_VertexID == 2 ? 1.0 : 0.0, gl_VertexID >= 2 ? 1.0 : 0.0);
}
)";
constexpr std::string_view fragment = R"(
in vec2 at;
uniform sampler2D colour;
out vec4 result;
void main() { result = vec4(texture(colour, at).rgb, 1.0); }
)";

GlTexture make_texture() {
    Image8 image(texels, texels);
    for (int y = 0; y < texels; ++y) {
        for (int x = 0; x < texels; ++x) {
            const auto grey = static_cast<std::uint8_t>((x ^ y) & 0xFF);
            image.at(x, y) = {grey, grey, grey, 255};
        }
    }
    GlTexture texture = GlTexture::generate();
    glBindTexture(GL_TEXTURE_2D, texture.get());
    glTexStorage2D(GL_TEXTURE_2D, 11, GL_SRGB8_ALPHA8, texels, texels);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, texels, texels, GL_RGBA, GL_UNSIGNED_BYTE, image.texels.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

} // namespace

Result<Floor> Floor::create() {
    Result<GlProgram> program = make_program("", vertex, fragment);
    if (!program) {
        return tl::unexpected<Error>(program.error());
    }
    Floor floor;
    floor.program_ = std::move(*program);
    floor.corners_ = glGetUniformLocation(floor.program_.get(), "corners");
    floor.texture_ = make_texture();
    floor.no_attributes_ = GlVertexArray::generate();
    glUseProgram(floor.program_.get());
    glUniform1i(glGetUniformLocation(floor.program_.get(), "colour"), 0);
    return floor;
}

int Floor::draw(const PropShape& prop, const PlanView& view, unsigned framebuffer) const {
    const RigidTransform projector_from_prop = view.table_from_projector.inverse() * view.table_from_prop;
    const glm::dmat4 clip_from_prop = view.projector.clip_from_point() * projector_from_prop.matrix();
    const glm::dvec3 projector = projector_from_prop.inverse().translation;
    const glm::dvec3 eye = view.table_from_prop.inverse().point(view.eyes_m[0]);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, view.projector.width, view.projector.height);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_CULL_FACE);
    glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    glClearDepthf(1.0F);
    glClearStencil(0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glUseProgram(program_.get());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture_.get());
    glBindVertexArray(no_attributes_.get());
    int drawn = 0;
    for (const PropFace& face : prop.faces) {
        if (!(face.plane.distance(eye) > 0.0) || !(face.plane.distance(projector) > 0.0)) {
            continue;
        }
        std::array<glm::vec4, 4> corners{};
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const glm::dvec4 corner = clip_from_prop * glm::dvec4(face.corners[k], 1.0);
            corners[k] = glm::vec4(glm::dvec4(corner.x, corner.y, 0.0, corner.w));
        }
        glUniform4fv(corners_, 4, glm::value_ptr(corners[0]));
        glDrawArrays(GL_TRIANGLE_FAN, 0, 4);
        ++drawn;
    }
    glBindVertexArray(0);
    return drawn;
}

} // namespace frustumscreen

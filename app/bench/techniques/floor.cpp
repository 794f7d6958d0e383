#include "app/bench/techniques/floor.h"

#include "app/bench/techniques/peer_gl.h"
#include "app/image/image.h"
#include "firmware_host/gl/gl_program.h"

#include <glm/gtc/type_ptr.hpp>

#include <array>
#include <limits>
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

class Floor final : public Technique {
public:
    Floor(const Stage& stage, GlProgram program) : stage_(stage), program_(std::move(program)) {
        glUseProgram(program_.get());
        glUniform1i(glGetUniformLocation(program_.get(), "colour"), 0);
    }

    [[nodiscard]] std::string name() const override { return "floor"; }
    void draw(const BenchPose& pose) override {
        const PeerView view = peer_view(stage_, pose);
        begin_picture(stage_.framebuffer, stage_.width(), stage_.height());
        glUseProgram(program_.get());
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, texture_.get());
        glBindVertexArray(no_attributes_.get());
        for (const PropFace* face : view.faces) {
            std::array<glm::vec4, 4> corners{};
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const glm::dvec4 corner = view.clip_from_prop * glm::dvec4(face->corners[k], 1.0);
                corners[k] = glm::vec4(glm::dvec4(corner.x, corner.y, 0.0, corner.w));
            }
            glUniform4fv(corners_, 4, glm::value_ptr(corners[0]));
            glDrawArrays(GL_TRIANGLE_FAN, 0, 4);
        }
        glBindVertexArray(0);
    }
    [[nodiscard]] Result<ImageFloat> hit_points(const BenchPose&) override {
        return ImageFloat(stage_.width(), stage_.height(),
                          glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    }

private:
    const Stage& stage_;
    GlProgram program_;
    GLint corners_ = glGetUniformLocation(program_.get(), "corners");
    GlTexture texture_ = make_texture();
    GlVertexArray no_attributes_ = GlVertexArray::generate();
};

} // namespace

Result<std::unique_ptr<Technique>> make_floor(const Stage& stage) {
    Result<GlProgram> program = make_program("", vertex, fragment);
    if (!program) {
        return tl::unexpected<Error>(program.error());
    }
    return std::make_unique<Floor>(stage, std::move(*program));
}

} // namespace frustumscreen

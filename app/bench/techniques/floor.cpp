#include "app/bench/techniques/floor.h"

#include "app/bench/techniques/peer_gl.h"
#include "app/image/image.h"
#include "app/scene/face_view.h"
#include "firmware_host/gl/gl_program.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

namespace frustumscreen::bench {

namespace {

constexpr int texels = 1024;
constexpr int last_level = 10;

constexpr std::string_view vertex = R"(
uniform vec4 corners[MAX_CORNERS];
uniform vec2 places[MAX_CORNERS];
out vec2 at;
void main() {
    gl_Position = corners[gl_VertexID];
    at = places[gl_VertexID];
}
)";
constexpr std::string_view fragment = R"(
in vec2 at;
uniform sampler2D colour;
out vec4 result;
void main() { result = vec4(texture(colour, at).rgb, 1.0); }
)";

/// Bars and squares of every size, in codes; each mip level averages the texels of the level below.
image::Image8 pattern(int level) {
    const int side = texels >> level;
    const int step = std::min(1 << level, 256);
    image::Image8 image(side, side);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const auto grey = static_cast<std::uint8_t>((((x ^ y) * step) & 0xFF) + (step - 1) / 2);
            image.at(x, y) = {grey, grey, grey, 255};
        }
    }
    return image;
}

gl::GlTexture make_texture(const image::Image8& image, GLsizei levels, GLint min_filter) {
    gl::GlTexture texture = gl::GlTexture::generate();
    glBindTexture(GL_TEXTURE_2D, texture.get());
    glTexStorage2D(GL_TEXTURE_2D, levels, GL_RGBA8, image.width, image.height);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE,
                    image.texels.data());
    if (levels > 1) {
        glGenerateMipmap(GL_TEXTURE_2D);
    }
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, min_filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

/// One texture with all mip levels, or each level as its own texture.
std::vector<gl::GlTexture> make_textures(FloorFilter filter) {
    std::vector<gl::GlTexture> textures;
    if (filter == FloorFilter::Trilinear) {
        textures.push_back(make_texture(pattern(0), 1 + last_level, GL_LINEAR_MIPMAP_LINEAR));
        return textures;
    }
    for (int level = 0; level <= last_level; ++level) {
        textures.push_back(make_texture(pattern(level), 1, GL_LINEAR));
    }
    return textures;
}

/// Where the texture's picture lies on a face: on all of a quadrilateral; other faces cut it out of the picture's circle.
geometry::PerCorner<glm::vec2> places_of(std::size_t corners) {
    if (corners == 4) {
        return {glm::vec2(0.0F, 0.0F), {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}};
    }
    geometry::PerCorner<glm::vec2> places;
    for (std::size_t k = 0; k < corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
        places.push_back(glm::vec2(0.5 + 0.5 * std::cos(angle), 0.5 + 0.5 * std::sin(angle)));
    }
    return places;
}

/// Area of a convex polygon given in clip coordinates, in pixels.
double area_px(const geometry::PerCorner<glm::dvec4>& corners, int width, int height) {
    double twice = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const glm::dvec4& a = corners[k];
        const glm::dvec4& b = corners[corners.next(k)];
        twice += (a.x * b.y - b.x * a.y) / (a.w * b.w);
    }
    return 0.5 * std::abs(twice) * 0.25 * width * height;
}

/// The mip level with texels of about one pixel.
std::size_t level_of(double pixels) {
    const double level = 0.5 * std::log2(double{texels} * texels / std::max(pixels, 1.0));
    return static_cast<std::size_t>(std::clamp(std::lround(level), 0L, long{last_level}));
}

class Floor final : public Technique {
public:
    Floor(const Kiosk& kiosk, gl::GlProgram program, FloorFilter filter)
        : kiosk_(kiosk), program_(std::move(program)), filter_(filter) {
        glUseProgram(program_.get());
        glUniform1i(glGetUniformLocation(program_.get(), "colour"), 0);
    }

    [[nodiscard]] std::string name() const override {
        return filter_ == FloorFilter::Trilinear ? "floor (trilinear)" : "floor (one mip level)";
    }
    void draw(const BenchPose& pose) override {
        const PeerView view = peer_view(kiosk_, pose);
        begin_codes(kiosk_.framebuffer, kiosk_.width(), kiosk_.height());
        glUseProgram(program_.get());
        glActiveTexture(GL_TEXTURE0);
        glBindVertexArray(no_attributes_.get());
        for (const geometry::PropFace* face : view.faces) {
            geometry::PerCorner<glm::dvec4> exact;
            geometry::PerCorner<glm::vec4> corners;
            for (const glm::dvec3& corner : face->corners) {
                exact.push_back(view.clip_from_prop * glm::dvec4(corner, 1.0));
                corners.push_back(scene::corner_in_clip(corner, view.clip_from_prop));
            }
            const auto count = static_cast<GLsizei>(corners.size());
            const std::size_t level = filter_ == FloorFilter::Trilinear
                                          ? 0
                                          : level_of(area_px(exact, kiosk_.width(), kiosk_.height()));
            glBindTexture(GL_TEXTURE_2D, textures_[level].get());
            glUniform4fv(corners_, count, glm::value_ptr(corners[0]));
            glUniform2fv(places_, count, glm::value_ptr(places_of(corners.size())[0]));
            glDrawArrays(GL_TRIANGLE_FAN, 0, count);
        }
        glBindVertexArray(0);
        end_codes();
    }
    [[nodiscard]] Result<image::ImageFloat> hit_points(const BenchPose&) override {
        return image::ImageFloat(kiosk_.width(), kiosk_.height(),
                                 glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    }

private:
    const Kiosk& kiosk_;
    gl::GlProgram program_;
    FloorFilter filter_;
    GLint corners_ = glGetUniformLocation(program_.get(), "corners");
    GLint places_ = glGetUniformLocation(program_.get(), "places");
    std::vector<gl::GlTexture> textures_ = make_textures(filter_);
    gl::GlVertexArray no_attributes_ = gl::GlVertexArray::generate();
};

} // namespace

Result<std::unique_ptr<Technique>> make_floor(const Kiosk& kiosk, FloorFilter filter) {
    TRY(gl::GlProgram program,
        gl::make_program(fmt::format("#define MAX_CORNERS {}\n", geometry::max_face_corners), vertex,
                         fragment));
    return std::make_unique<Floor>(kiosk, std::move(program), filter);
}

} // namespace frustumscreen::bench

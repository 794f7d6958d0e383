#include "app/bench/techniques/supersampled.h"

#include "app/bench/techniques/peer_gl.h"
#include "app/render/sample_grid.h"
#include "firmware_host/base/pixel_rectangle.h"
#include "firmware_host/gl/gl_program.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace frustumscreen {

namespace {

constexpr std::string_view vertex = R"(
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
})";
/// As the exhibit averages: a bilinear fetch where texels meet is their mean; the sampler decodes before it.
constexpr std::string_view fragment = R"(
uniform sampler2D samples;
uniform vec2 grid;
uniform vec2 first; // of a pixel's samples, the place of the first fetch
out vec4 result;
void main() {
    vec2 size = vec2(textureSize(samples, 0));
    vec2 at = floor(gl_FragCoord.xy) * grid + first;
    vec3 sum = texture(samples, at / size).rgb;
    if (grid.y > 2.0) {
        sum = 0.5 * (sum + texture(samples, (at + vec2(0.0, 2.0)) / size).rgb);
    }
    result = vec4(sum, 1.0);
})";

/// The pixels that the prop's corners span.
PixelRectangle pixels_of_prop(const Stage& stage, const BenchPose& pose) {
    const Pinhole& pinhole = stage.settings.projector.pinhole;
    const RigidTransform projector_from_prop =
        stage.settings.projector.table_from_projector.inverse() * pose.table_from_prop;
    glm::dvec2 low(pinhole.width, pinhole.height);
    glm::dvec2 high(0.0);
    for (const glm::dvec3& corner : stage.prop.corners) {
        const std::optional<glm::dvec2> pixel = pinhole.pixel(projector_from_prop.point(corner));
        if (!pixel) {
            return {0, 0, pinhole.width, pinhole.height};
        }
        low = glm::max(glm::min(low, glm::floor(*pixel)), glm::dvec2(0.0));
        high = glm::min(glm::max(high, glm::ceil(*pixel)), glm::dvec2(pinhole.width, pinhole.height));
    }
    const glm::ivec2 size = glm::max(glm::ivec2(high - low), glm::ivec2(0));
    return {static_cast<int>(low.x), static_cast<int>(low.y), size.x, size.y};
}

class Supersampled final : public Technique {
public:
    Supersampled(const Stage& stage, const glm::ivec2& grid, OffscreenTarget samples, GlProgram average)
        : stage_(stage), grid_(grid), samples_(std::move(samples)), average_(std::move(average)),
          fine_(stage) {
        fine_.framebuffer = samples_.framebuffer.get();
        fine_.settings.projector.pinhole =
            stage.settings.projector.pinhole.scaled_to(samples_.width, samples_.height);
    }
    /// The peer on the larger picture, and on the stage's own for places.
    [[nodiscard]] Result<void> prepare(const MakePeer& make) {
        Result<std::unique_ptr<Technique>> peer = make(fine_);
        Result<std::unique_ptr<Technique>> places = make(stage_);
        if (!peer || !places) {
            return tl::unexpected<Error>(peer ? places.error() : peer.error());
        }
        peer_ = std::move(*peer);
        places_ = std::move(*places);
        return {};
    }

    [[nodiscard]] std::string name() const override {
        return fmt::format("{} ({} samples)", peer_->name(), grid_.x * grid_.y);
    }
    void draw(const BenchPose& pose) override {
        peer_->draw(pose);
        begin_codes(stage_.framebuffer, stage_.width(), stage_.height());
        end_codes();
        const PixelRectangle lit = pixels_of_prop(stage_, pose);
        glEnable(GL_SCISSOR_TEST);
        glScissor(lit.x, lit.y, lit.width, lit.height);
        glUseProgram(average_.get());
        glUniform2fv(glGetUniformLocation(average_.get(), "grid"), 1, glm::value_ptr(glm::vec2(grid_)));
        glUniform2f(glGetUniformLocation(average_.get(), "first"), grid_.x == 1 ? 0.5F : 1.0F, 1.0F);
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, samples_.colour.get());
        glBindVertexArray(no_attributes_.get());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glBindVertexArray(0);
        glDisable(GL_SCISSOR_TEST);
    }
    [[nodiscard]] Result<ImageFloat> hit_points(const BenchPose& pose) override {
        return places_->hit_points(pose);
    }

private:
    const Stage& stage_;
    glm::ivec2 grid_;
    OffscreenTarget samples_;
    GlProgram average_;
    Stage fine_;
    std::unique_ptr<Technique> peer_, places_; ///< after the stage that the peer is on
    GlVertexArray no_attributes_ = GlVertexArray::generate();
};

} // namespace

Result<std::unique_ptr<Technique>> make_supersampled(const Stage& stage, int samples, const MakePeer& make) {
    const glm::ivec2 grid = SampleGrid::of(samples);
    Result<OffscreenTarget> target =
        make_target(stage.width() * grid.x, stage.height() * grid.y, GL_SRGB8_ALPHA8);
    if (!target) {
        return tl::unexpected<Error>(target.error());
    }
    glBindTexture(GL_TEXTURE_2D, target->colour.get());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    Result<GlProgram> average = make_program("", vertex, fragment);
    if (!average) {
        return tl::unexpected<Error>(average.error());
    }
    auto made = std::make_unique<Supersampled>(stage, grid, std::move(*target), std::move(*average));
    if (const Result<void> ready = made->prepare(make); !ready) {
        return tl::unexpected<Error>(ready.error());
    }
    return made;
}

} // namespace frustumscreen

#include "app/bench/peer_samples.h"

#include "app/render/gl_program.h"
#include "app/render/sample_grid.h"

#include <algorithm>

namespace frustumscreen {

namespace {

constexpr std::string_view corner_vertex = R"(
void main() { // one triangle over the whole picture
    gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
})";

// A bilinear fetch where up to four texels meet is their average.
constexpr std::string_view average_fragment = R"(
uniform sampler2D larger;
uniform ivec2 grid;
out vec4 result;
void main() {
    ivec2 fetches = max(grid / 2, ivec2(1));
    vec2 texels = vec2(grid / fetches);
    vec2 corner = floor(gl_FragCoord.xy) * vec2(grid);
    vec2 size = vec2(textureSize(larger, 0));
    vec3 sum = vec3(0.0);
    for (int y = 0; y < fetches.y; ++y) {
        for (int x = 0; x < fetches.x; ++x) {
            sum += texture(larger, (corner + (vec2(x, y) + 0.5) * texels) / size).rgb;
        }
    }
    result = vec4(sum / float(fetches.x * fetches.y), 1.0);
})";

void scissor(const PixelRect& part, const glm::ivec2& grid) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(part.left * grid.x, part.top * grid.y, std::max(part.right - part.left, 0) * grid.x,
              std::max(part.bottom - part.top, 0) * grid.y);
}

} // namespace

Result<PeerSamples> PeerSamples::create(int width, int height, int samples) {
    PeerSamples result;
    result.grid_ = SampleGrid::of(samples);
    if (result.grid_.x == 0) {
        return bad_input("a peer takes 2, 4, 8 or 16 samples a pixel");
    }
    Result<GlProgram> average = make_program("", corner_vertex, average_fragment);
    Result<OffscreenTarget> target =
        make_target(width * result.grid_.x, height * result.grid_.y, GL_SRGB8_ALPHA8);
    if (!average || !target) {
        return tl::unexpected<Error>(average ? target.error() : average.error());
    }
    glBindTexture(GL_TEXTURE_2D, target->colour.get());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    result.average_ = std::move(*average);
    result.target_ = std::move(*target);
    result.no_attributes_ = GlVertexArray::generate();
    return result;
}

void PeerSamples::begin(const PixelRect& part) const {
    glBindFramebuffer(GL_FRAMEBUFFER, target_.framebuffer.get());
    glViewport(0, 0, target_.width, target_.height);
    scissor(part, grid_);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

void PeerSamples::average(const PixelRect& part, GLuint framebuffer) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, target_.width / grid_.x, target_.height / grid_.y);
    scissor(part, {1, 1});
    glUseProgram(average_.get());
    glUniform2i(glGetUniformLocation(average_.get(), "grid"), grid_.x, grid_.y);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, target_.colour.get());
    glBindVertexArray(no_attributes_.get());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glDisable(GL_SCISSOR_TEST);
}

} // namespace frustumscreen

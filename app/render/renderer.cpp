#include "app/render/renderer.h"

#include "app/render/gl_program.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen {

namespace {

void set_scissor(const PixelRectangle& r, const glm::ivec2& grid = {1, 1}) {
    glScissor(r.x * grid.x, r.y * grid.y, r.width * grid.x, r.height * grid.y);
}

// A bilinear fetch where four texels meet is their average; the sampler decodes sRGB before it. A pixel of
// more than 2 x 2 samples takes one fetch for each 2 x 2.
constexpr std::string_view average_vertex = R"(
out vec2 at;
void main() {
    at = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
    gl_Position = vec4(2.0 * at - 1.0, 0.0, 1.0);
}
)";
constexpr std::string_view average_fragment = R"(
in vec2 at;
uniform sampler2D enlarged;
uniform ivec2 fetches;
uniform vec2 scale;
out vec4 result;
void main() {
    vec2 step_between = 2.0 / vec2(textureSize(enlarged, 0));
    vec2 first = at * scale - 0.5 * vec2(fetches - 1) * step_between;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < fetches.y; ++y) {
        for (int x = 0; x < fetches.x; ++x) {
            sum += textureLod(enlarged, first + vec2(x, y) * step_between, 0.0);
        }
    }
    result = sum / float(fetches.x * fetches.y);
}
)";

/// Samples along a pixel's sides; zero for a number that has no grid.
glm::ivec2 grid_of(int samples) {
    switch (samples) {
    case 1:
        return {1, 1};
    case 2:
        return {1, 2};
    case 4:
        return {2, 2};
    case 8:
        return {2, 4};
    case 16:
        return {4, 4};
    default:
        return {0, 0};
    }
}

void clear(GLbitfield what) {
    glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    glClearDepthf(1.0F);
    glClearStencil(0);
    glStencilMask(0xFF);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClear(what);
}

} // namespace

Result<Renderer> Renderer::create(const RendererOptions& options) {
    Result<FacePass> pass = FacePass::create(FaceOutput::Colour);
    if (!pass) {
        return tl::unexpected<Error>(pass.error());
    }
    Result<CaptionPass> caption = CaptionPass::create();
    if (!caption) {
        return tl::unexpected<Error>(caption.error());
    }
    Renderer renderer(std::move(*pass), std::move(*caption));
    renderer.options_ = options;
    if (options.samples > 1) {
        if (Result<void> made = renderer.make_enlarged(); !made) {
            return tl::unexpected<Error>(made.error());
        }
    }
    return renderer;
}

Result<void> Renderer::make_enlarged() {
    grid_ = grid_of(options_.samples);
    if (grid_.x == 0) {
        return fail(
            ErrorKind::BadConfiguration,
            fmt::format("render: {} samples a pixel; allowed are 1, 2, 4, 8 and 16", options_.samples));
    }
    const glm::ivec2 size = grid_ * glm::ivec2(options_.width, options_.height);
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (std::max(size.x, size.y) > most) {
        return fail(
            ErrorKind::BadConfiguration,
            fmt::format(
                "render: {} x {} pixels of {} samples; this driver draws up to {} on each side: use fewer "
                "samples",
                options_.width, options_.height, options_.samples, most));
    }
    Result<GlProgram> average = make_program("", average_vertex, average_fragment);
    if (!average) {
        return tl::unexpected<Error>(average.error());
    }
    average_ = std::move(*average);
    average_fetches_ = glGetUniformLocation(average_.get(), "fetches");
    average_scale_ = glGetUniformLocation(average_.get(), "scale");
    no_attributes_ = GlVertexArray::generate();
    enlarged_ = GlFramebuffer::generate();
    enlarged_colour_ = GlTexture::generate();
    enlarged_depth_stencil_ = GlRenderbuffer::generate();
    glBindTexture(GL_TEXTURE_2D, enlarged_colour_.get());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, size.x, size.y);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindRenderbuffer(GL_RENDERBUFFER, enlarged_depth_stencil_.get());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, size.x, size.y);
    glBindFramebuffer(GL_FRAMEBUFFER, enlarged_.get());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, enlarged_colour_.get(), 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                              enlarged_depth_stencil_.get());
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE || glGetError() != GL_NO_ERROR) {
        return fail(ErrorKind::BadConfiguration,
                    fmt::format("render: the driver cannot hold {} x {} pixels of {} samples; use 1 sample",
                                options_.width, options_.height, options_.samples));
    }
    return {};
}

PixelRectangle Renderer::to_redraw(const FramePlan& plan, const RenderTarget& target, Redraw redraw) const {
    const auto age = static_cast<std::size_t>(std::max(target.buffer_age, 0));
    if (redraw == Redraw::Everything || age == 0 || age > pictures_) {
        return {0, 0, options_.width, options_.height};
    }
    return united(history_[age - 1].bounds, lit_bounds(plan));
}

DrawResult Renderer::draw(const FramePlan& plan, const Shows& shows, const RenderTarget& target,
                          Redraw redraw) {
    if (redraw == Redraw::Changes && target.buffer_age > 0 && pictures_ > 0 &&
        history_[0].hash == plan.hash) {
        return {};
    }
    const int samples = plan.samples > 0 ? std::min(plan.samples, options_.samples) : options_.samples;
    DrawResult result{true, to_redraw(plan, target, redraw), 0};
    glViewport(0, 0, options_.width, options_.height);
    glEnable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    if (!result.redrawn.empty()) {
        set_scissor(result.redrawn);
        const GLbitfield masks = samples > 1 ? 0 : GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT;
        clear(GL_COLOR_BUFFER_BIT | masks);
    }
    if (!plan.caption.bounds.empty()) {
        set_scissor(plan.caption.bounds);
        result.draw_calls += caption_.draw(plan.caption, shows.caption);
    }
    if (!plan.bounds.empty()) {
        set_scissor(plan.bounds);
        if (samples > 1) {
            draw_smooth(plan, grid_of(samples), shows, target, result);
        } else {
            result.draw_calls += pass_.draw(plan, shows.artifact);
        }
    }
    glDisable(GL_SCISSOR_TEST);
    std::move_backward(history_.begin(), history_.end() - 1, history_.end());
    history_[0] = {plan.hash, lit_bounds(plan)};
    pictures_ = std::min(pictures_ + 1, history_.size());
    return result;
}

/// The artifact's rectangle, drawn larger, then averaged into the picture.
void Renderer::draw_smooth(const FramePlan& plan, const glm::ivec2& grid, const Shows& shows,
                           const RenderTarget& target, DrawResult& result) const {
    glBindFramebuffer(GL_FRAMEBUFFER, enlarged_.get());
    glViewport(0, 0, options_.width * grid.x, options_.height * grid.y);
    set_scissor(plan.bounds, grid);
    clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    if (!plan.caption.bounds.empty()) {
        result.draw_calls += caption_.draw(plan.caption, shows.caption);
    }
    result.draw_calls += pass_.draw(plan, shows.artifact, grid);
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    glViewport(0, 0, options_.width, options_.height);
    set_scissor(plan.bounds);
    glUseProgram(average_.get());
    const glm::ivec2 fetches = glm::max(grid / 2, glm::ivec2(1));
    const glm::vec2 scale = glm::vec2(grid) / glm::vec2(grid_);
    glUniform2i(average_fetches_, fetches.x, fetches.y);
    glUniform2f(average_scale_, scale.x, scale.y);
    glBindTexture(GL_TEXTURE_2D, enlarged_colour_.get());
    glBindVertexArray(no_attributes_.get());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
}

} // namespace frustumscreen

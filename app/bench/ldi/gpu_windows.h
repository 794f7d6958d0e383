/// Pictures with depth that the GPU warps, as an engine does today (window_technique.h).
///
/// Grid     each picture is a grid of triangles with a vertex at each pixel's middle. Where the depth jumps between
///          neighbours, the triangles are stretched across the jump and cover what is hidden behind it. With a grid
///          cut there, more than a third of the town is missing from most eyes.
/// Points   squares of the picture, as large as the pixel's surface is from straight ahead, and half a pixel more.
/// Threads  that of the set.
/// Errors   the driver has no memory, or refuses a shader.
#pragma once

#include "app/bench/ldi/window_set.h"
#include "app/bench/ldi/window_technique.h"
#include "app/ldi/depth_picture.h"

#include <span>
#include <vector>

namespace frustumscreen::bench {

/// Vertices and triangles in the GPU's memory, and what draws them into a window's picture.
class GpuWindow {
public:
    struct Vertex {
        glm::vec3 at_m{0.0F};
        glm::u8vec4 colour{0}; ///< sRGB
        float size_m = 0.0F;   ///< of a point
    };
    [[nodiscard]] static Result<GpuWindow> create(WindowSet& set, std::span<const Vertex> vertices,
                                                  std::span<const std::uint32_t> indices);
    /// Triangles, or points where there are no indices.
    void draw(const glm::dvec3& eye_m) { draw_into(set_->target().framebuffer, eye_m, Output::Colour); }
    [[nodiscard]] image::ImageFloat hit_points(const glm::dvec3& eye_m);
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

private:
    void draw_into(unsigned framebuffer, const glm::dvec3& eye_m, Output output);

    WindowSet* set_ = nullptr;
    OutputPrograms programs_;
    gl::GlVertexArray array_;
    gl::GlBuffer vertices_, indices_;
    OffscreenTarget points_;
    GLsizei count_ = 0;
    bool as_points_ = false;
    std::uint64_t bytes_ = 0;
};

/// Five sides of a cube around the window's middle, each of the window's pixels.
[[nodiscard]] Result<std::unique_ptr<WindowTechnique>> make_cube_depth(WindowSet& set);
/// One picture through the window from the frozen eye.
[[nodiscard]] Result<std::unique_ptr<WindowTechnique>> make_view_depth(WindowSet& set);

} // namespace frustumscreen::bench

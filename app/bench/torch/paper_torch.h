/// The paper's torch, drawn over a picture of polygons: the triangles that meet the beam are split, get the attenuation at
/// their corners, and are drawn once more (torch/splitting.h).
///
/// Advantages  it takes the triangles that the exhibit's plan found for this eye, so it culls none itself; it draws in
///          the same context, over the depth and stencil of the picture that is there; its mesh is kept while neither
///          the torch nor the plan changes; a triangle's corner is transformed once, however many triangles share it.
/// Content  white, laid over the colours by the intensity; the beam's shape at each pixel, by (s, t, q).
/// Pixels   one sample a pixel: the picture's own depth is in the framebuffer.
/// Threads  the one whose context is current.
/// Errors   on creation: the driver refuses the shader.
#pragma once

#include "app/bench/torch/torch_set.h"
#include "app/torch/splitting.h"
#include "firmware_host/gl/gl_handle.h"

#include <vector>

namespace frustumscreen::bench {

class PaperTorch {
public:
    [[nodiscard]] static Result<PaperTorch> create();

    /// `plan` was drawn last, into `framebuffer`. `torch_from_prop` and `beam`: of the torch.
    void draw(const TorchSet& set, const scene::FramePlan& plan, const glm::dmat4& torch_from_prop,
              const torch::Beam& beam, const torch::Splitting& splitting, unsigned framebuffer);
    /// The latest picture's triangles, after splitting.
    [[nodiscard]] std::size_t triangles() const { return lit_.size() / 3; }

private:
    PaperTorch() = default;
    void build(const TorchSet& set, const scene::FramePlan& plan, const glm::dmat4& torch_from_prop,
               const torch::Splitting& splitting, const torch::Beam& beam);
    void build_draw(const std::vector<glm::dvec3>& positions, const scene::FramePlan& plan,
                    const scene::Draw& draw, const glm::dmat4& torch_from_unit,
                    const torch::TriangleSplitter& splitter, const torch::Splitting& splitting);

    /// The inputs that a mesh depends on: it is built again when one changes.
    struct Key {
        std::uint64_t plan = 0;
        glm::dmat4 torch_from_prop{0.0};
        double tolerance = 0.0;
        torch::Splitting::By by = torch::Splitting::By::Length;
        [[nodiscard]] bool operator==(const Key&) const = default;
    };
    struct Range {
        std::size_t draw = 0; ///< index into FramePlan::draws
        std::size_t first = 0, count = 0;
    };

    gl::GlProgram program_;
    GLint clip_from_unit_ = -1, beam_from_unit_ = -1, shape_ = -1;
    gl::GlVertexArray array_;
    gl::GlBuffer buffer_;
    Key key_;
    std::vector<torch::LitCorner> lit_;
    std::vector<Range> ranges_;
    std::vector<torch::MeshCorner> corners_; ///< of a draw's vertices
    std::vector<std::uint32_t> made_;        ///< the draw that made each of them
    std::uint32_t number_ = 0;               ///< of the present draw
};

} // namespace frustumscreen::bench

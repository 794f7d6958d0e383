/// The full source mesh on the GPU, with its materials and textures: what the peers draw.
///
/// Frame    prop frame, metres, placed in 64-bit.
/// Colour   base colour * texture (trilinear) * vertex colour, linear light; MASK cut, BLEND opaque,
/// two-sided. Threads  the one whose context is current.
#pragma once

#include "app/bench/peer_gl.h"
#include "app/geometry/collineation.h"
#include "assets_baked/bake/source_mesh.h"

#include <array>
#include <memory>
#include <vector>

namespace frustumscreen {

class PeerMesh {
public:
    enum class Output { Colour, Point }; ///< Point: prop-frame position, alpha 1

    [[nodiscard]] static Result<std::unique_ptr<PeerMesh>> upload(const SourceMesh& mesh,
                                                                  const glm::dmat4& prop_from_artifact);
    /// Into the bound framebuffer with the state as it is, but for culling: the backs of a closed mesh are
    /// left out. `front`: GL_CCW, or GL_CW where the clip matrix mirrors (row 0 of the projector's picture is
    /// its top).
    void draw(const glm::dmat4& clip_from_prop, Output output, GLenum front) const;
    /// Also of a mesh that is not closed, if its triangles are only to be seen from outside.
    void leave_out_backs() { closed_ = true; }
    [[nodiscard]] const Box& box() const { return box_; }

private:
    struct Part { ///< the triangles of one material
        glm::vec4 base_colour{1.0F};
        std::size_t texture = 0; ///< 0 is white
        float cutoff = -1.0F;    ///< below 0: not masked
        std::size_t first_index = 0;
        std::size_t index_count = 0;
    };

    PeerMesh() = default;
    [[nodiscard]] Result<void> make_programs();
    void upload_vertices(const SourceMesh& mesh, const glm::dmat4& prop_from_artifact);
    void upload_parts(const SourceMesh& mesh);

    Box box_;
    bool closed_ = false;
    GlVertexArray array_;
    std::vector<GlBuffer> buffers_;
    std::vector<GlTexture> textures_;
    std::vector<Part> parts_;
    std::array<std::array<GlProgram, 2>, 2> programs_; ///< [output][masked]
};

} // namespace frustumscreen

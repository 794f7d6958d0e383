/// The full source mesh on the GPU, with its materials and textures: what the peers draw.
///
/// Frame    prop frame, metres, placed in 64-bit.
/// Colour   base colour * texture (trilinear) * vertex colour, linear light; MASK cut, BLEND opaque,
///          two-sided.
/// Threads  the one whose context is current.
#pragma once

#include "app/bench/techniques/peer_culling.h"
#include "app/bench/techniques/peer_gl.h"
#include "app/geometry/collineation.h"
#include "assets_baked/bake/source_mesh.h"

#include <array>
#include <memory>
#include <vector>

namespace frustumscreen {

class PeerMesh {
public:
    /// `from_outside`: its triangles are drawn only from outside, even if it is not closed.
    [[nodiscard]] static Result<std::shared_ptr<const PeerMesh>>
    upload(const SourceMesh& mesh, const glm::dmat4& prop_from_artifact, bool from_outside = false);
    /// Draws into the bound framebuffer and changes no state but culling: it leaves out the backs of a closed
    /// mesh. `front`: GL_CCW, or GL_CW where the clip matrix mirrors (row 0 of the projector's picture is its
    /// top).
    void draw(const glm::dmat4& clip_from_prop, Output output, GLenum front) const;
    /// Draws only what was found to be visible on a face of the view.
    void draw(const glm::dmat4& clip_from_prop, Output output, GLenum front, const VisibleParts& visible,
              std::size_t face) const;
    [[nodiscard]] const PeerTriangles& triangles() const { return triangles_; }
    [[nodiscard]] const Box& box() const { return box_; }

private:
    struct Part { ///< the triangles of one material
        glm::vec4 base_colour{1.0F};
        std::size_t texture = 0; ///< 0 is white
        float cutoff = -1.0F;    ///< below 0: not masked
        IndexRange all;          ///< of the mesh's own indices
    };

    PeerMesh() = default;
    /// Positions as they were uploaded.
    std::vector<glm::vec3> upload_vertices(const SourceMesh& mesh, const glm::dmat4& prop_from_artifact);
    void upload_parts(const SourceMesh& mesh, std::span<const glm::vec3> positions_m);
    void begin(GLenum front) const;
    void draw_part(const Part& part, const IndexRange& range, const glm::mat4& clip, Output output) const;

    Box box_;
    bool closed_ = false;
    GlVertexArray array_;
    std::vector<GlBuffer> buffers_;
    std::vector<GlTexture> textures_;
    std::vector<Part> parts_;
    GlBuffer indices_;
    PeerTriangles triangles_;
    std::array<OutputPrograms, 2> programs_; ///< [masked]
};

} // namespace frustumscreen

/// The full source mesh on the GPU, with its materials and textures: what the peers draw.
///
/// Frame    prop frame, metres, placed in 64-bit.
/// Colour   base colour * texture * vertex colour as sRGB codes, which the shader passes on: base colours are multiplied
///          into the textures in linear light, vertex colours in codes, which a power law allows. One mip level for a draw, whose texels
///          are as large as a pixel, as the exhibit has it. MASK cut, BLEND opaque, two-sided.
/// Vertices 16 bits a coordinate over the mesh's box, as the exhibit's.
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

/// One picture of a mesh, or a face's part of one.
struct PeerPass {
    glm::dmat4 clip_from_prop{1.0};
    glm::ivec2 size{1}; ///< of the picture, pixels
    Output output = Output::Colour;
    /// GL_CCW, or GL_CW where the clip matrix mirrors (row 0 of the projector's picture is its top).
    GLenum front = 0;
};

class PeerMesh {
public:
    /// `from_outside`: its triangles are drawn only from outside, even if it is not closed.
    [[nodiscard]] static Result<std::shared_ptr<const PeerMesh>>
    upload(const SourceMesh& mesh, const glm::dmat4& prop_from_artifact, bool from_outside = false);
    /// Draws into the bound framebuffer and changes no state but culling: it leaves out the backs of a closed
    /// mesh.
    void draw(const PeerPass& pass) const;
    /// Draws only what was found to be visible on a face of the view.
    void draw(const PeerPass& pass, const VisibleParts& visible, std::size_t face) const;
    [[nodiscard]] const PeerTriangles& triangles() const { return triangles_; }
    [[nodiscard]] const Box& box() const { return box_; }

private:
    struct Part {                  ///< the triangles of one material
        std::size_t texture = 0;   ///< of textures_
        double texels_per_m = 0.0; ///< of its surface's mean texel
        float cutoff = -1.0F;      ///< below 0: not masked
        IndexRange all;            ///< of the mesh's own indices
    };

    struct Program { ///< with its uniforms' places
        Program() = default;
        explicit Program(GlProgram made);
        GlProgram program;
        GLint clip_from_unit = -1, cutoff = -1, low = -1, extent = -1;
    };

    PeerMesh() = default;
    /// Positions as they were uploaded.
    std::vector<glm::vec3> upload_vertices(const SourceMesh& mesh, const glm::dmat4& prop_from_artifact);
    void upload_parts(const SourceMesh& mesh, std::span<const glm::vec3> positions_m);
    void begin(GLenum front) const;
    void draw_part(const Part& part, const IndexRange& range, const PeerPass& pass) const;

    Box box_;
    bool closed_ = false;
    GlVertexArray array_;
    std::vector<GlBuffer> buffers_;
    std::vector<GlTexture> textures_;
    std::vector<Part> parts_;
    GlBuffer indices_;
    PeerTriangles triangles_;
    std::array<std::array<Program, 2>, 2> programs_; ///< [masked][output]
};

} // namespace frustumscreen

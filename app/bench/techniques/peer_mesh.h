/// The full source mesh on the GPU, with its materials and textures, as drawn by the peers.
///
/// Frame    prop frame, metres, placed in 64-bit.
/// Colour   base colour * texture * vertex colour as sRGB codes, which the shader passes on: base colours are
///          multiplied into the textures in linear light, vertex colours in codes, which is exact for a power
///          law. One mip level per draw, with texels as large as a pixel, as in the exhibit. MASK cut, BLEND
///          opaque, two-sided.
/// Vertices 16 bits per coordinate over the mesh's box, as in the exhibit.
/// Threads  the one whose context is current.
#pragma once

#include "app/bench/techniques/peer_culling.h"
#include "app/bench/techniques/peer_gl.h"
#include "app/geometry/collineation.h"
#include "assets_baked/bake/source_mesh.h"

#include <array>
#include <memory>
#include <vector>

namespace frustumscreen::bench {

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
    /// `from_outside`: draws its triangles only from outside, even if it is not closed.
    [[nodiscard]] static Result<std::shared_ptr<const PeerMesh>>
    upload(const bake::SourceMesh& mesh, const glm::dmat4& prop_from_artifact, bool from_outside = false);
    /// Draws into the bound framebuffer and changes no state except culling: it culls the back faces of a
    /// closed mesh.
    void draw(const PeerPass& pass) const;
    /// Draws only the triangles found visible on a face of the view.
    void draw(const PeerPass& pass, const VisibleParts& visible, std::size_t face) const;
    [[nodiscard]] const PeerTriangles& triangles() const { return triangles_; }
    [[nodiscard]] const geometry::Box& box() const { return box_; }

private:
    struct Part {                  ///< the triangles of one material
        std::size_t texture = 0;   ///< index into textures_
        double texels_per_m = 0.0; ///< mean over its surface
        float cutoff = -1.0F;      ///< negative: not masked
        scene::IndexRange all;     ///< in the mesh's own indices
    };

    struct Program { ///< with its uniforms' locations
        Program() = default;
        explicit Program(gl::GlProgram made);
        gl::GlProgram program;
        GLint clip_from_unit = -1, cutoff = -1, low = -1, extent = -1;
    };

    PeerMesh() = default;
    /// Returns the positions as uploaded.
    std::vector<glm::vec3> upload_vertices(const bake::SourceMesh& mesh,
                                           const glm::dmat4& prop_from_artifact);
    void upload_parts(const bake::SourceMesh& mesh, std::span<const glm::vec3> positions_m);
    void begin(GLenum front) const;
    void draw_part(const Part& part, const scene::IndexRange& range, const PeerPass& pass) const;

    geometry::Box box_;
    bool closed_ = false;
    gl::GlVertexArray array_;
    std::vector<gl::GlBuffer> buffers_;
    std::vector<gl::GlTexture> textures_;
    std::vector<Part> parts_;
    gl::GlBuffer indices_;
    PeerTriangles triangles_;
    std::array<std::array<Program, 2>, 2> programs_; ///< [masked][output]
};

} // namespace frustumscreen::bench

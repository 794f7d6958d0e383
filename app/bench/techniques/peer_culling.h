/// The triangles that a peer's mesh shows on each face, found on the CPU exactly as for the exhibit's own
/// levels (visible_triangles.h), so the peers get equal treatment.
///
/// Frame    prop frame outside, divided by the box's longest edge inside.
/// Threads  PeerTriangles: pure. VisibleParts: the one whose context is current.
#pragma once

#include "app/bench/techniques/peer_gl.h"
#include "app/geometry/collineation.h"
#include "app/scene/frame_plan.h"

#include <span>
#include <vector>

namespace frustumscreen::bench {

/// Made once per mesh.
struct PeerTriangles {
    scene::LevelTriangles triangles;
    std::vector<std::size_t> first_cluster; ///< of each part (material); plus one for the end
    double metres_per_box = 1.0;
};
/// Sorts the indices of each part into clusters, in place. Triangles of a mesh that is not closed are visible
/// from both sides: only the faces' pyramids cull them.
[[nodiscard]] PeerTriangles peer_triangles(std::span<const glm::vec3> positions_m, const geometry::Box& box,
                                           std::span<const std::span<std::uint32_t>> parts, bool closed);

/// The potentially visible triangles, in a buffer; found again for every picture.
class VisibleParts {
public:
    VisibleParts() : buffer_(gl::GlBuffer::generate()) {}
    void find(const PeerTriangles& mesh, const geometry::Box& box, const PeerView& view);
    void bind() const { glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer_.get()); }
    /// The faces that show anything, with bounds around what they show.
    [[nodiscard]] const std::vector<PeerFace>& faces() const { return faces_; }
    /// The triangles of a part on face number `face` of `faces()`.
    [[nodiscard]] const scene::IndexRange& range(std::size_t face, std::size_t part) const {
        return ranges_[face][part];
    }
    /// Every pixel that the triangles may light.
    [[nodiscard]] const scene::LitTiles& lit() const { return lit_; }

private:
    gl::GlBuffer buffer_;
    scene::FrontTriangles front_;
    std::vector<std::uint32_t> indices_;
    std::vector<PeerFace> faces_;
    std::vector<std::vector<scene::IndexRange>> ranges_; ///< [face][part]
    scene::LitTiles lit_;
};

} // namespace frustumscreen::bench

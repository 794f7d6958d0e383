/// The file's own normals, which say where the surface is smooth and where it has an edge.
///
/// A triangle whose normals all lie within `max_lean_deg` of its plane's normal has the light that they say: an edge is
/// hard if the normals on its two sides differ. Elsewhere, such as where a program averaged normals over a sharp edge,
/// the angle of the edge decides (corner_normals).
///
/// Frame    out: box.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/source_scene.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen::bake {

class FileNormals {
public:
    /// Half of the sharpest edge that a person would draw smooth.
    static constexpr double max_lean_deg = 40.0;

    FileNormals(const SourceMesh& mesh, const BoxFrame& frame);

    /// The file's normal at a hit on the mesh, on the side of `normal`; `normal` itself if the file has none that fits.
    [[nodiscard]] glm::vec3 at(const SurfaceHit& hit, const glm::vec3& normal) const;

private:
    const SourceMesh& mesh_;
    std::vector<glm::vec3> normals_; ///< empty or one per position of the mesh
};

} // namespace frustumscreen::bake

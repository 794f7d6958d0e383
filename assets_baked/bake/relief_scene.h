/// A relief's surface for rays: where the cut cells have nothing, and through backs, they pass.
///
/// Frame    box.
/// Threads  const; any. The relief must outlive it.
#pragma once

#include "app/relief/block_relief.h"
#include "assets_baked/bake/level.h"
#include "assets_baked/bake/source_scene.h"
#include "assets_baked/bake/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace frustumscreen {

/// Two triangles for each cell that is there, whole where it is cut.
[[nodiscard]] TriangleMesh surface_of(const BlockRelief& relief);

class ReliefScene {
public:
    explicit ReliefScene(const BlockRelief& relief);
    ReliefScene(const ReliefScene&) = delete;
    ReliefScene& operator=(const ReliefScene&) = delete;

    /// Of whole cells.
    [[nodiscard]] const SourceScene& scene() const { return scene_; }
    /// What is cast.
    [[nodiscard]] SurfaceHit trace(const glm::vec3& eye, const glm::vec3& direction) const;
    /// As measure_colour, of the blocks' corners instead of a texture.
    [[nodiscard]] float colour_rmse(const SourceSamples& samples) const;

    /// A cell that is there, in the order of the surface's triangles.
    struct Cell {
        std::uint32_t block = 0;
        std::uint32_t cell = 0;  ///< 8 row + column
        glm::vec3 outward{0.0F}; ///< of its direction
    };

private:
    [[nodiscard]] bool is_drawn(const SurfaceHit& hit, const glm::vec3& direction) const;

    const BlockRelief& relief_;
    TriangleMesh surface_;
    SourceMesh mesh_;
    SourceScene scene_;
    std::vector<Cell> cells_;
};

} // namespace frustumscreen

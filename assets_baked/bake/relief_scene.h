/// A relief's surface for rays, which pass through backs and through the empty parts of cut cells.
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

namespace frustumscreen::bake {

/// Two triangles for each existing cell; cut cells are whole.
[[nodiscard]] TriangleMesh surface_of(const relief::BlockRelief& relief);

class ReliefScene {
public:
    explicit ReliefScene(const relief::BlockRelief& relief);
    ReliefScene(const ReliefScene&) = delete;
    ReliefScene& operator=(const ReliefScene&) = delete;

    /// The surface with whole cells.
    [[nodiscard]] const SourceScene& scene() const { return scene_; }
    /// The first hit on the surface as it is rasterized.
    [[nodiscard]] SurfaceHit trace(const glm::vec3& eye, const glm::vec3& direction) const;
    /// As measure_colour, with the colours of the blocks' corners instead of a texture.
    [[nodiscard]] float colour_rmse(const SourceSamples& samples) const;

    /// An existing cell, in the order of the surface's triangles.
    struct Cell {
        std::uint32_t block = 0;
        std::uint32_t cell = 0;  ///< 8 row + column
        glm::vec3 outward{0.0F}; ///< outward axis of its direction
    };

private:
    [[nodiscard]] bool is_drawn(const SurfaceHit& hit, const glm::vec3& direction) const;

    const relief::BlockRelief& relief_;
    TriangleMesh surface_;
    SourceMesh mesh_;
    SourceScene scene_;
    std::vector<Cell> cells_;
};

} // namespace frustumscreen::bake

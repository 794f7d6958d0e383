/// The levels of a mesh while it is baked: its surface, simplified step by step and measured; the texture that the levels
/// share; and the reliefs.
///
/// Frame    box, unless stated otherwise.
/// Threads  as bake.h.
#pragma once

#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/file_normals.h"
#include "assets_baked/bake/layer_parts.h"
#include "assets_baked/bake/level.h"
#include "assets_baked/bake/measured_reliefs.h"
#include "assets_baked/bake/site_curtains.h"
#include "assets_baked/bake/texture_bake.h"
#include "assets_baked/bake/triangle_mesh.h"

#include <span>
#include <vector>

namespace frustumscreen::bake {

/// Simplified triangles that become a level.
struct Surface {
    TriangleMesh mesh;
    float tolerance_box = 0.0F;
    pack::LevelError error;
};

/// Levels that share a texture; `PackLevel::texture` is left at 0.
struct TexturedLevels {
    std::vector<pack::PackLevel> levels;
    image::Image8 texture;
    std::vector<image::Image8> layers; ///< of the mesh, in place of the texture
};

/// Tells `options.progress` that a step begins.
void begin_stage(const BakeOptions& options, const BakeStage& stage);

class LevelBakery {
public:
    /// All of them must outlive it. `curtains`: of a region of a site, in the mesh's own frame; they hide its underside.
    LevelBakery(const SourceMesh& mesh, const BoxFrame& frame, const BakeOptions& options,
                std::span<const CurtainTriangle> curtains);

    [[nodiscard]] Result<void> check() const { return check_surface(welded_); }
    /// The mesh's corners.
    [[nodiscard]] const std::vector<glm::dvec3>& points() const { return points_; }
    [[nodiscard]] const SourceScene& source() const { return source_; }
    /// The error of the source itself, which was reduced before.
    [[nodiscard]] const pack::LevelError& reduction() const { return reduction_; }
    /// The errors that are seen of a region of a site.
    [[nodiscard]] pack::SeenErrors seen_in_region(const pack::Pack& pack) const;

    /// From fine to coarse. Call it first.
    [[nodiscard]] std::vector<Surface> surfaces();
    /// `surfaces` from fine to coarse.
    [[nodiscard]] TexturedLevels mesh_levels(const std::vector<Surface>& surfaces) const;
    /// For the reliefs; `meshes` must outlive it.
    [[nodiscard]] ReliefSource relief_source(const TexturedLevels& meshes) const;
    /// The pack's reliefs, in addition to the levels.
    [[nodiscard]] std::vector<pack::MeasuredRelief> reliefs(const TexturedLevels& meshes) const;

private:
    [[nodiscard]] SourceMesh curtain_mesh() const;
    [[nodiscard]] TriangleMesh seen_sides(const TriangleMesh& mesh) const;
    [[nodiscard]] Surface measured(const TriangleMesh& mesh, float tolerance_box) const;
    void add_simplified(std::vector<Surface>& surfaces) const;
    [[nodiscard]] std::vector<LayerColour>
    layer_colours_of(const ChartedMesh& mesh, const image::Image<AtlasTexel>& texels, float reach) const;
    void light(const ChartedMesh& mesh, const image::Image<AtlasTexel>& texels, float reach,
               image::ImageFloat& colour, std::vector<LayerColour>& layers) const;

    const BakeOptions& options_;
    std::span<const CurtainTriangle> curtains_;
    const BoxFrame& frame_;
    std::vector<glm::dvec3> points_;
    SourceScene source_;
    FileNormals normals_;
    TriangleMesh welded_;
    float texel_box_;
    pack::LevelError reduction_;
    TriangleMesh finest_;
    TriangleMesh visible_;
    SourceSamples samples_;
};

} // namespace frustumscreen::bake

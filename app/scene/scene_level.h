/// A mesh level as one scene needs it, without the parts that no pose of the plan can show. Second half of
/// the scene plan, made once the level has been read.
///
/// Triangles  a triangle is left out if the zone of the eyes does not reach above its plane, with the same
///            slack as in each frame's own culling, which would cull it in every frame. The order stays, so
///            that equal depths are resolved in the same way.
/// Detail     if all views are known, each is planned, and the finest mip level and the most samples that any
///            of them takes are known exactly. A prop that may be turned always has faces that are nearly
///            edge-on to the eye and stretched by the projector without bound: then all detail stays.
///
/// Frames   box (pack.h).
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include "app/pack/pack.h"
#include "app/scene/scene_plan.h"

#include <cstdint>

namespace frustumscreen::scene {

/// Texels along one box unit: the edge of the surface's mean texel, inverted.
[[nodiscard]] double texels_per_box(const pack::PackLevel& level, const image::Image8& texture,
                                    const glm::dvec3& box_size);

/// The mip level whose texels are as large as a sample, so that no sample skips a texel; 0 = the finest.
/// `samples_per_box` as Draw::pixels_per_box, times the samples along a pixel's side.
[[nodiscard]] int mip_level(double texels_per_box, double samples_per_box);
/// Coarser mip levels would mix neighbouring charts of the atlas.
inline constexpr int coarsest_mip_level = 4;

struct SceneLevel {
    std::uint32_t level = 0;
    pack::PackLevel mesh;        ///< the triangles that may be seen
    double texels_per_box = 0.0; ///< of the whole level
    bool cut_out = false;        ///< the texture has cut-out texels (alpha below one half)
    int finest_mip = 0;          ///< finer mip levels are never sampled
    int samples = 0;             ///< a pixel, the most that a view takes; 0 = unknown
    std::size_t unseen_triangles = 0;
    std::size_t unseen_clusters = 0;
    std::size_t unseen_vertices = 0;
};
/// The whole level, for every pose.
[[nodiscard]] SceneLevel whole_level(const pack::Pack& pack, std::uint32_t level);
[[nodiscard]] SceneLevel scene_level(const pack::Pack& pack, std::uint32_t level, const ScenePlan& plan);

/// Describes the parts of the level that were left out.
[[nodiscard]] std::vector<LeftOut> left_out_of(const ScenePlan& plan, const SceneLevel& level,
                                               const image::Image8& texture);

/// The plan's needs, with no more samples than the level takes. They are never increased: a view that takes
/// more samples than fit is drawn elsewhere in the larger picture and rounds differently.
[[nodiscard]] RenderNeeds needs_of(const ScenePlan& plan, const SceneLevel& level);

/// Bytes of GPU memory: vertices and mip levels of a level; the larger picture for several samples a pixel; a
/// caption with its mip levels.
[[nodiscard]] std::uint64_t gpu_bytes(const SceneLevel& level, const image::Image8& texture);
[[nodiscard]] std::uint64_t gpu_bytes(const RenderNeeds& needs, int width, int height);
[[nodiscard]] std::uint64_t caption_gpu_bytes(int width, int height);
/// A picture on the table with its mip levels.
[[nodiscard]] inline std::uint64_t picture_gpu_bytes(int width, int height) {
    return 4 * caption_gpu_bytes(width, height);
}

} // namespace frustumscreen::scene

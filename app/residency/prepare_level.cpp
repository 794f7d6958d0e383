// Levels read and culled, ready to upload.
#include "app/render/block_upload.h"
#include "app/residency/run_levels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace frustumscreen::residency {

PreparedLevel prepare_level(const pack::Pack& pack, std::uint32_t level, const scene::ScenePlan& plan,
                            std::span<const PreparedLevel> before, double max_samples_per_box) {
    scene::SceneLevel kept = scene::scene_level(pack, level, plan);
    const image::Image8& texture = pack.textures[kept.mesh.texture];
    const auto longest = static_cast<unsigned>(std::max(texture.width, texture.height));
    const int needed = std::min(scene::mip_level(kept.texels_per_box, max_samples_per_box),
                                static_cast<int>(std::bit_width(longest)) - 1);
    const bool is_cut = needed > kept.finest_mip;
    kept.finest_mip = std::max(kept.finest_mip, needed);
    PreparedLevel made;
    made.use = {.level = level,
                .triangles = kept.mesh.indices.size() / 3,
                .unseen_triangles = kept.unseen_triangles,
                .unseen_clusters = kept.unseen_clusters,
                .texture =
                    glm::max(glm::ivec2(1), glm::ivec2(texture.width, texture.height) >> kept.finest_mip),
                .finest_mip = kept.finest_mip,
                .planned_gpu_bytes = scene::gpu_bytes(kept, texture),
                .gpu_bytes = 0};
    made.seen = plan.seen[level];
    made.box_size = pack.box_size;
    made.samples = pack.samples;
    made.triangles = std::make_shared<scene::LevelTriangles>(scene::triangles_of(kept.mesh, pack.box_size));
    made.needs = scene::needs_of(plan, kept);
    made.left_out = scene::left_out_of(plan, kept, texture);
    made.texture = kept.mesh.texture;
    if (is_cut) {
        made.sharp_to = kept.texels_per_box / (std::exp2(needed - 1) * max_samples_per_box);
    }
    const auto same = std::find_if(before.begin(), before.end(), [&](const PreparedLevel& other) {
        return other.triangles && !other.data.texture_of && other.texture == made.texture &&
               other.use.finest_mip == kept.finest_mip;
    });
    if (same == before.end()) {
        made.data = scene::level_data(kept, texture);
        return made;
    }
    made.data = scene::mesh_data(kept);
    made.data.texture_of = static_cast<std::size_t>(same - before.begin());
    made.use.shares_texture = true;
    made.use.planned_gpu_bytes = kept.mesh.vertices.size() * sizeof(pack::PackVertex);
    return made;
}

void note_gpu_bytes(const render::GpuStore& store, const scene::Drawable& drawable, LevelUse& use) {
    use.gpu_bytes = store.bytes(drawable) - (use.shares_texture ? store.bytes(drawable.material.texture) : 0);
}

bool draws_relief(const scene::ScenePlan& plan, std::size_t place, bool on_gpu) {
    const scene::QualityLevel shown{
        .level = plan.reliefs[place].texels, .samples = 1, .enough = false, .relief = true, .on_gpu = on_gpu};
    return std::any_of(
        plan.quality_levels.begin(), plan.quality_levels.end(),
        [&](const scene::QualityLevel& quality_level) { return quality_level.shows_as(shown); });
}

PreparedLevel prepare_relief(const pack::PackDescription& pack, std::size_t place,
                             std::shared_ptr<const relief::BlockRelief> relief, bool on_gpu,
                             const scene::ScenePlan& plan) {
    PreparedLevel made;
    made.use.level = plan.reliefs[place].texels;
    made.use.blocks = relief->blocks.size();
    made.use.on_gpu = on_gpu;
    made.use.planned_gpu_bytes = on_gpu ? render::gpu_bytes(*relief) : 0;
    made.seen = plan.seen_reliefs[place];
    made.box_size = pack.box_size;
    made.samples = pack.samples;
    made.needs = plan.needs;
    made.data.relief = std::move(relief);
    made.data.on_gpu = on_gpu;
    return made;
}

} // namespace frustumscreen::residency

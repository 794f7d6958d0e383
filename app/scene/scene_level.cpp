#include "app/scene/scene_level.h"

#include "app/scene/frame_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace frustumscreen::scene {

namespace {

/// With more views than this, views are not planned one by one.
constexpr std::size_t max_planned_views = 64;

/// For each triangle, whether some eye of the zone may see it.
std::vector<bool> seen_triangles(const LevelTriangles& triangles, const PointZone& eyes,
                                 double metres_per_box) {
    // Twice a frame's tolerance for single precision (visible_triangles.h).
    const double epsilon = std::numeric_limits<float>::epsilon();
    const double slack = 2.0 * (edge_on_box + 4.0 * epsilon * (1.0 + eyes.farthest() / metres_per_box));
    std::vector<bool> seen(triangles.distance.size());
    for (std::size_t t = 0; t < seen.size(); ++t) {
        const glm::dvec3 normal(triangles.normal_x[t], triangles.normal_y[t], triangles.normal_z[t]);
        seen[t] =
            !(eyes.reach(normal) / metres_per_box - static_cast<double>(triangles.distance[t]) < -slack);
    }
    return seen;
}

/// The marked triangles, the vertices that they use and the clusters that keep some of them, in order.
pack::PackLevel part_of(const pack::PackLevel& level, const std::vector<bool>& marked) {
    pack::PackLevel part{.technique = level.technique,
                         .error = level.error,
                         .texture = level.texture,
                         .vertices = {},
                         .indices = {},
                         .clusters = {}};
    constexpr auto none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> new_name(level.vertices.size(), none);
    for (const pack::PackCluster& cluster : level.clusters) {
        pack::PackCluster kept = cluster;
        kept.first_index = static_cast<std::uint32_t>(part.indices.size());
        for (std::size_t k = cluster.first_index; k < cluster.first_index + cluster.index_count; ++k) {
            if (marked[k / 3]) {
                part.indices.push_back(level.indices[k]);
                new_name[level.indices[k]] = 0;
            }
        }
        kept.index_count = static_cast<std::uint32_t>(part.indices.size()) - kept.first_index;
        if (kept.index_count > 0) {
            part.clusters.push_back(kept);
        }
    }
    for (std::size_t v = 0; v < level.vertices.size(); ++v) {
        if (new_name[v] != none) {
            new_name[v] = static_cast<std::uint32_t>(part.vertices.size());
            part.vertices.push_back(level.vertices[v]);
        }
    }
    for (std::uint32_t& index : part.indices) {
        index = new_name[index];
    }
    return part;
}

/// Detail that the views need of a level, planned with the most samples of any quality level.
void measure_detail(const pack::Pack& pack, const ScenePlan& plan, SceneLevel& level) {
    PlacedLevel placed{.triangles = std::make_shared<LevelTriangles>(triangles_of(level.mesh, pack.box_size)),
                       .box_size = pack.box_size,
                       .metres_per_box = plan.metres_per_box,
                       .drawable = {},
                       .samples = 0};
    for (const QualityLevel& quality_level : plan.quality_levels) {
        placed.samples = std::max(placed.samples, quality_level.samples);
    }
    FramePlan frame = make_plan(plan.prop, placed);
    const image::Image8& texture = pack.textures[level.mesh.texture];
    const auto longest = static_cast<unsigned>(std::max(texture.width, texture.height));
    const auto mips = static_cast<int>(std::bit_width(longest));
    level.finest_mip = std::min(coarsest_mip_level, mips - 1);
    level.samples = 1;
    for (const KnownView& view : plan.visibility.views) {
        plan_frame(plan.prop, placed,
                   {.projector = plan.projector,
                    .table_from_projector = plan.table_from_projector,
                    .table_from_prop = view.table_from_prop,
                    .eyes_m = {&view.eye_m, 1}},
                   frame);
        level.samples = std::max(level.samples, frame.samples);
        for (const Draw& draw : frame.draws) {
            const double samples_per_box =
                std::sqrt(static_cast<double>(frame.samples)) * draw.pixels_per_box;
            level.finest_mip = std::min(level.finest_mip, mip_level(level.texels_per_box, samples_per_box));
        }
    }
}

} // namespace

double texels_per_box(const pack::PackLevel& level, const image::Image8& texture,
                      const glm::dvec3& box_size) {
    const auto position = [&](std::uint32_t vertex) {
        const auto& q = level.vertices[vertex].position;
        return glm::dvec3(q[0], q[1], q[2]) * box_size;
    };
    const auto texel = [&](std::uint32_t vertex) {
        const auto& q = level.vertices[vertex].uv;
        return glm::dvec3(q[0], q[1], 0) * glm::dvec3(texture.width, texture.height, 0);
    };
    const auto doubled_area = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        return glm::length(glm::cross(b - a, c - a));
    };
    double texels = 0.0;
    double surface = 0.0;
    for (std::size_t k = 0; k + 2 < level.indices.size(); k += 3) {
        const std::array<std::uint32_t, 3> v{level.indices[k], level.indices[k + 1], level.indices[k + 2]};
        texels += doubled_area(texel(v[0]), texel(v[1]), texel(v[2]));
        surface += doubled_area(position(v[0]), position(v[1]), position(v[2]));
    }
    return surface > 0.0 ? std::sqrt(texels / surface) : 0.0;
}

int mip_level(double texels_per_box, double samples_per_box) {
    const double texels_per_sample = texels_per_box / samples_per_box;
    if (!(texels_per_sample > 1.0)) { // also for NaN
        return 0;
    }
    // A tie goes to the finer level, as in OpenGL.
    const double level = std::ceil(std::log2(texels_per_sample));
    return static_cast<int>(std::fmin(level, coarsest_mip_level));
}

SceneLevel whole_level(const pack::Pack& pack, std::uint32_t level) {
    const pack::PackLevel& mesh = pack.levels[level];
    SceneLevel whole;
    whole.level = level;
    whole.mesh = mesh;
    const image::Image8& texture = pack.textures[mesh.texture];
    whole.texels_per_box = texels_per_box(mesh, texture, pack.box_size);
    whole.cut_out = image::has_cut_texels(texture);
    return whole;
}

SceneLevel scene_level(const pack::Pack& pack, std::uint32_t level, const ScenePlan& plan) {
    SceneLevel made = whole_level(pack, level);
    if ((plan.cull_kinds & UnseenTriangles) != 0 && !plan.visibility.eyes.anywhere) {
        const LevelTriangles triangles = triangles_of(made.mesh, pack.box_size);
        pack::PackLevel seen =
            part_of(made.mesh, seen_triangles(triangles, plan.visibility.eyes, plan.metres_per_box));
        made.unseen_triangles = (made.mesh.indices.size() - seen.indices.size()) / 3;
        made.unseen_clusters = made.mesh.clusters.size() - seen.clusters.size();
        made.unseen_vertices = made.mesh.vertices.size() - seen.vertices.size();
        made.mesh = std::move(seen);
    }
    const std::size_t views = plan.visibility.views.size();
    if ((plan.cull_kinds & UnusedDetail) != 0 && views > 0 && views <= max_planned_views) {
        measure_detail(pack, plan, made);
    }
    return made;
}

std::vector<LeftOut> left_out_of(const ScenePlan& plan, const SceneLevel& level,
                                 const image::Image8& texture) {
    std::vector<LeftOut> left_out;
    if (level.unseen_triangles > 0) {
        left_out.push_back(
            {UnseenTriangles,
             fmt::format("{} of the {} triangles of level {}, {} of its {} clusters as a whole",
                         level.unseen_triangles, level.mesh.indices.size() / 3 + level.unseen_triangles,
                         level.level, level.unseen_clusters,
                         level.mesh.clusters.size() + level.unseen_clusters),
             plan.visibility.views.empty() ? "they look away from every eye that the settings allow"
                                           : "they look away from the eye at every pose there is"});
    }
    if (level.finest_mip > 0) {
        left_out.push_back(
            {UnusedDetail,
             fmt::format("the {} x {} texels of level {}'s texture, down to {} x {}", texture.width,
                         texture.height, level.level, std::max(1, texture.width >> level.finest_mip),
                         std::max(1, texture.height >> level.finest_mip)),
             "the projector's pixels are never so fine"});
    }
    if (const int samples = needs_of(plan, level).samples; samples < plan.needs.samples) {
        left_out.push_back(
            {UnusedDetail,
             fmt::format("space for {} samples a pixel; space for {} is enough", plan.needs.samples, samples),
             "no pose is seen so slantingly that it takes more"});
    }
    return left_out;
}

RenderNeeds needs_of(const ScenePlan& plan, const SceneLevel& level) {
    RenderNeeds needs = plan.needs;
    needs.samples = level.samples > 0 ? std::min(level.samples, needs.samples) : needs.samples;
    if (level.cut_out) {
        for (ShaderKey key : plan.needs.draws) {
            key.cut_out = key.pass == ShaderKey::Pass::Surface && !key.blocks;
            needs.draws.insert(key);
        }
    }
    return needs;
}

std::uint64_t gpu_bytes(const SceneLevel& level, const image::Image8& texture) {
    constexpr std::uint64_t bytes_per_texel = 4;
    std::uint64_t bytes = level.mesh.vertices.size() * sizeof(pack::PackVertex);
    const int longest = std::max(texture.width, texture.height);
    for (int mip = level.finest_mip; mip <= coarsest_mip_level && (longest >> mip) > 0; ++mip) {
        bytes += bytes_per_texel * static_cast<std::uint64_t>(std::max(1, texture.width >> mip)) *
                 static_cast<std::uint64_t>(std::max(1, texture.height >> mip));
    }
    return bytes;
}

std::uint64_t gpu_bytes(const RenderNeeds& needs, int width, int height) {
    constexpr std::uint64_t bytes_per_sample = 4 + 4; // colour; depth and stencil
    const std::uint64_t bytes_per_texel =             // colours, and depth
        !needs.rasterizes  ? 0
        : needs.interlocks ? 4 + 4
                           : 4;
    const auto area = [](const PixelSize& size) {
        return static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
    };
    const PixelSize picture{width, height};
    const std::uint64_t samples =
        needs.samples > 1 ? static_cast<std::uint64_t>(needs.samples) * area(needs.outline.value_or(picture))
                          : 0;
    return bytes_per_texel * area(picture) + bytes_per_sample * samples;
}

std::uint64_t caption_gpu_bytes(int width, int height) {
    std::uint64_t bytes = 0;
    for (int mip = 0; (std::max(width, height) >> mip) > 0; ++mip) {
        bytes += static_cast<std::uint64_t>(std::max(1, width >> mip)) *
                 static_cast<std::uint64_t>(std::max(1, height >> mip));
    }
    return bytes;
}

} // namespace frustumscreen::scene

#include "app/bench/measures/technique_set.h"

#include "app/bench/techniques/floor.h"
#include "app/bench/techniques/level_of_detail.h"
#include "app/bench/techniques/pack_cells.h"
#include "app/bench/techniques/ray_cast.h"
#include "app/bench/techniques/relief/relief_peers.h"
#include "app/bench/techniques/relief_raster.h"
#include "app/pack/pack_relief.h"
#include "app/render/read_back.h"
#include "app/scene/scene_plan.h"
#include "firmware_host/base/quantile.h"
#include "firmware_host/display/surfaceless_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace frustumscreen::bench {

namespace {

/// Covers every kind.
constexpr std::array<std::pair<TechniqueKind, std::string_view>, 13> kind_names = {{
    {TechniqueKind::Floor, "floor"},
    {TechniqueKind::PackLevel, "pack level"},
    {TechniqueKind::PackRelief, "pack relief"},
    {TechniqueKind::Auto, "auto"},
    {TechniqueKind::Cells, "cells"},
    {TechniqueKind::FullMesh, "full mesh"},
    {TechniqueKind::TwoPass, "two-pass"},
    {TechniqueKind::RayCast, "ray cast"},
    {TechniqueKind::Lod, "LOD"},
    {TechniqueKind::TwoPassLod, "two-pass LOD"},
    {TechniqueKind::Relief, "relief"},
    {TechniqueKind::ReliefRaster, "relief cast"},
    {TechniqueKind::ReliefGpu, "relief on GPU"},
}};

TechniqueResult described(TechniqueKind kind, int level, std::uint64_t triangles) {
    TechniqueResult result;
    result.kind = kind;
    result.level = level;
    result.triangles = triangles;
    return result;
}

/// Includes the texture, without mip levels.
std::uint64_t bytes_of(const pack::PackLevel& level, const pack::Pack& pack) {
    return level.vertices.size() * sizeof(pack::PackVertex) +
           level.indices.size() * sizeof(level.indices[0]) + 4 * pack.textures[level.texture].texels.size();
}

std::string level_name(const pack::Pack& pack, std::uint32_t level) {
    return fmt::format("{} {}{}",
                       pack.levels[level].technique == pack::LevelTechnique::Relief ? "relief" : "mesh",
                       level, level == pack.default_level ? " (default)" : "");
}

/// The first match, which is the best quality level of its kind.
std::optional<scene::QualityLevel> quality_level_that(const std::vector<scene::QualityLevel>& quality_levels,
                                                      bool is_raster) {
    const auto found =
        std::find_if(quality_levels.begin(), quality_levels.end(),
                     [is_raster](const scene::QualityLevel& each) { return each.relief == is_raster; });
    return found != quality_levels.end() ? std::optional(*found) : std::nullopt;
}

} // namespace

std::string_view name_of(TechniqueKind kind) {
    const auto* const named = std::find_if(kind_names.begin(), kind_names.end(),
                                           [kind](const auto& one) { return one.first == kind; });
    return named->second;
}

Result<std::unique_ptr<TechniqueSet>> TechniqueSet::open(const SetUp& set_up) {
    const geometry::Pinhole& pinhole = set_up.settings.projector.pinhole;
    TRY(std::unique_ptr<display::SurfacelessDisplay> display,
        display::SurfacelessDisplay::create(pinhole.width, pinhole.height));
    const unsigned framebuffer = display->framebuffer();
    std::unique_ptr<TechniqueSet> set(new TechniqueSet(
        std::move(display), Kiosk{set_up.settings, settings::make_prop(set_up.settings.prop), framebuffer}));
    for (const FloorFilter filter : {FloorFilter::Trilinear, FloorFilter::OneLevel}) {
        TRY_VOID(set->add(make_floor(set->kiosk_, filter), described(TechniqueKind::Floor, -1, 0)));
    }
    return set;
}

Result<void> TechniqueSet::add(Result<std::unique_ptr<Technique>> technique, TechniqueResult result) {
    TRY_VOID(technique);
    result.name = (*technique)->name();
    results_.push_back(std::move(result));
    techniques_.push_back(std::move(*technique));
    return {};
}

Result<void> TechniqueSet::add_sampled(const MakePeer& make, const TechniqueResult& result,
                                       const std::vector<int>& samples) {
    for (const int each : samples) {
        std::shared_ptr<const PeerSamples>& shared = peer_samples_[each];
        if (each > 1 && !shared) {
            TRY(shared, PeerSamples::create(kiosk_, each));
        }
        TechniqueResult sampled = result;
        sampled.samples = each;
        TRY_VOID(add(make(shared), std::move(sampled)));
    }
    return {};
}

Result<void> TechniqueSet::add_level(const pack::Pack& pack, std::uint32_t level,
                                     const PictureOptions& usual) {
    PictureOptions options = usual;
    options.samples = options.samples > 0 ? options.samples : pack.samples;
    if (level + 1 == pack.levels.size()) {
        options.samples =
            std::max(options.samples, render::finest_samples); // as `render --technique finest` draws it
    }
    TechniqueResult result =
        described(TechniqueKind::PackLevel, static_cast<int>(level), pack.levels[level].indices.size() / 3);
    result.bytes = bytes_of(pack.levels[level], pack);
    if (level == pack.default_level || level + 1 == pack.levels.size()) {
        TRY(result.drawn_as, keep_drawn(pack, level));
    }
    result.samples = options.samples;
    return add(make_pack_level(kiosk_, pack, level, options, level_name(pack, level)), std::move(result));
}

Result<void> TechniqueSet::add_auto(const pack::Pack& pack, const PictureOptions& options) {
    scene::SceneRequest request;
    request.light = options.lit;
    request.samples = options.samples;
    TRY(const scene::ScenePlan plan, scene::plan_scene(kiosk_.settings, pack::outline_of(pack), request));
    const Result<void> added =
        add_auto_mesh(pack, quality_level_that(plan.quality_levels, false).value(), options);
    const std::optional<scene::QualityLevel> relief = quality_level_that(plan.quality_levels, true);
    if (!added || !relief) {
        return added;
    }
    PictureOptions raster = options;
    raster.samples = relief->samples;
    return add_pack_reliefs(pack, TechniqueKind::Auto, raster,
                            [&](std::uint32_t texels) { return texels == relief->level; });
}

Result<std::string> TechniqueSet::add_cells(const std::filesystem::path& file, const pack::Pack& pack,
                                            const PictureOptions& options) {
    TRY(PackCells cells, make_pack_cells(kiosk_, file, pack, options, "cells"));
    TechniqueResult result = described(TechniqueKind::Cells, -1, cells.triangles + cells.blocks);
    result.samples = options.samples > 0 ? options.samples : pack.samples;
    TRY_VOID(add(std::move(cells.technique), std::move(result)));
    return cells.ways;
}

Result<void> TechniqueSet::add_auto_mesh(const pack::Pack& pack, const scene::QualityLevel& quality_level,
                                         PictureOptions options) {
    TRY(std::string kept, keep_drawn(pack, quality_level.level));
    options.samples = quality_level.samples;
    TechniqueResult result = described(TechniqueKind::Auto, static_cast<int>(quality_level.level),
                                       pack.levels[quality_level.level].indices.size() / 3);
    result.samples = quality_level.samples;
    result.drawn_as = std::move(kept);
    result.bytes = bytes_of(pack.levels[quality_level.level], pack);
    return add(make_pack_level(kiosk_, pack, quality_level.level, options,
                               fmt::format("auto ({})", level_name(pack, quality_level.level))),
               std::move(result));
}

Result<void> TechniqueSet::add_peers(const bake::SourceMesh& mesh, const glm::dmat4& prop_from_artifact,
                                     bool full_mesh, const std::vector<int>& two_pass_pixels,
                                     const std::vector<int>& samples) {
    TRY(const auto peer, PeerMesh::upload(mesh, prop_from_artifact));
    const std::uint64_t triangles = mesh.triangles.size();
    Result<void> added;
    if (full_mesh) {
        added = add_sampled([&](const auto& sampled) { return make_full_mesh(kiosk_, peer, sampled); },
                            described(TechniqueKind::FullMesh, -1, triangles), samples);
    }
    for (std::size_t k = 0; added && k < two_pass_pixels.size(); ++k) {
        added = add_sampled(
            [&](const auto& sampled) { return make_two_pass(kiosk_, peer, two_pass_pixels[k], sampled); },
            described(TechniqueKind::TwoPass, -1, triangles), samples);
    }
    return added;
}

Result<void> TechniqueSet::add_ray_cast(const Truth& truth, const std::vector<int>& samples) {
    Result<void> added;
    for (std::size_t k = 0; added && k < samples.size(); ++k) {
        TechniqueResult result =
            described(TechniqueKind::RayCast, -1, truth.traced()->mesh().triangles.size());
        result.samples = samples[k];
        added = add(make_ray_cast(kiosk_, truth.traced(), samples[k]), std::move(result));
    }
    return added;
}

Result<void> TechniqueSet::add_levels_of_detail(const bake::SourceMesh& mesh,
                                                const glm::dmat4& prop_from_artifact,
                                                const PeerChoice& choice) {
    Result<void> added;
    for (const LevelOfDetail& level : levels_of_detail(mesh, choice.lod_triangles)) {
        const std::string name = fmt::format("LOD {}k", level.target / 1000);
        const std::uint64_t triangles = level.mesh.triangles.size();
        TRY(const auto peer, PeerMesh::upload(level.mesh, prop_from_artifact));
        if (choice.lod) {
            added =
                add_sampled([&](const auto& sampled) { return make_full_mesh(kiosk_, peer, sampled, name); },
                            described(TechniqueKind::Lod, -1, triangles), choice.samples);
        }
        for (std::size_t k = 0; added && choice.two_pass_lod && k < choice.eye_pixels.size(); ++k) {
            added = add_sampled(
                [&](const auto& sampled) {
                    return make_two_pass(kiosk_, peer, choice.eye_pixels[k], sampled, name);
                },
                described(TechniqueKind::TwoPassLod, -1, triangles), choice.samples);
        }
        TRY_VOID(added);
    }
    return added;
}

Result<void> TechniqueSet::add_relief_peers(const Truth& truth, const bake::SourceMesh& mesh,
                                            const glm::dmat4& prop_from_artifact, int texels) {
    TRY(std::vector<ReliefPeer> peers, make_relief_peers(kiosk_, truth, mesh, prop_from_artifact, texels));
    for (ReliefPeer& peer : peers) {
        (void)add(std::move(peer.technique), described(TechniqueKind::Relief, -1, peer.triangles));
    }
    return {};
}

Result<void> TechniqueSet::add_relief(const pack::Pack& pack, TechniqueKind kind, relief::BlockRelief relief,
                                      const std::optional<scene::SeenLevel>& seen,
                                      const PictureOptions& options, const std::string& name) {
    TechniqueResult result = described(kind, -1, relief.blocks.size());
    result.samples = options.samples > 0 ? options.samples : pack.samples;
    if (kind != TechniqueKind::ReliefRaster) {
        result.bytes = relief::bytes_of(relief);
        TRY(result.drawn_as,
            keep_drawn(pack, relief, fmt::format("relief of texels {:.9g}", relief.texel_box)));
    }
    return add(make_pack_relief(kiosk_, pack, std::make_shared<const relief::BlockRelief>(std::move(relief)),
                                seen, options, name, kind == TechniqueKind::ReliefGpu),
               std::move(result));
}

Result<void> TechniqueSet::add_pack_reliefs(const pack::Pack& pack, TechniqueKind kind,
                                            const PictureOptions& options,
                                            const std::function<bool(std::uint32_t)>& wanted) {
    TRY(const std::vector<pack::ReliefOutline> reliefs, pack::reliefs_of(pack));
    TRY(const scene::SeenByEyes seen, scene::seen_by_eyes(pack::outline_of(pack)));
    Result<void> added;
    for (std::size_t k = 0; added && k < reliefs.size(); ++k) {
        const pack::ReliefOutline& outline = reliefs[k];
        if (!wanted(outline.texels)) {
            continue;
        }
        const std::string name =
            scene::name_of(scene::QualityLevel{.level = outline.texels,
                                               .samples = pack.samples,
                                               .enough = false,
                                               .relief = true,
                                               .on_gpu = kind == TechniqueKind::ReliefGpu});
        added = pack::relief_of(pack, outline).and_then([&](relief::BlockRelief relief) {
            return add_relief(pack, kind, std::move(relief), seen.reliefs[k], options,
                              kind == TechniqueKind::Auto ? fmt::format("auto ({})", name) : name);
        });
    }
    return added;
}

Result<void> TechniqueSet::add_reliefs(const pack::Pack& pack, const PictureOptions& options) {
    return add_pack_reliefs(pack, TechniqueKind::PackRelief, options, [](std::uint32_t) { return true; });
}

Result<void> TechniqueSet::add_finest_relief(const pack::Pack& pack, const PictureOptions& options) {
    TRY(const std::vector<pack::ReliefOutline> reliefs, pack::reliefs_of(pack));
    std::uint32_t max_texels = 0;
    for (const pack::ReliefOutline& each : reliefs) {
        max_texels = std::max(max_texels, each.texels);
    }
    if (max_texels == 0) {
        return fail(ErrorKind::BadInput, "bench.no_relief",
                    "the pack has no relief; bake it without --no-relief");
    }
    return add_pack_reliefs(pack, TechniqueKind::PackRelief, options,
                            [max_texels](std::uint32_t texels) { return texels == max_texels; });
}

Result<void> TechniqueSet::add_reliefs_on_gpu(const pack::Pack& pack, const PictureOptions& options) {
    return add_pack_reliefs(pack, TechniqueKind::ReliefGpu, options, [](std::uint32_t) { return true; });
}

Result<void> TechniqueSet::add_relief_rasters(const pack::Pack& pack, const std::vector<int>& texels,
                                              const PictureOptions& options) {
    for (const int size : texels) {
        TRY_VOID(add_relief(pack, TechniqueKind::ReliefRaster, blocks_of_pack(pack, size), std::nullopt,
                            options, fmt::format("relief cast {}", size)));
    }
    return {};
}

image::Image8 TechniqueSet::picture(std::size_t k, const BenchPose& pose) {
    techniques_[k]->draw(pose);
    return render::read_colour(kiosk_.framebuffer, kiosk_.width(), kiosk_.height());
}

Result<Drawn> TechniqueSet::drawn(std::size_t k, const BenchPose& pose) {
    image::Image8 colour = picture(k, pose);
    Result<Drawn> made = places(k, pose);
    if (made) {
        made->colour = std::move(colour);
    }
    return made;
}

Result<Drawn> TechniqueSet::places(std::size_t k, const BenchPose& pose) {
    TRY(image::ImageFloat points, techniques_[k]->hit_points(pose));
    return Drawn{image::Image8(kiosk_.width(), kiosk_.height()), std::move(points)};
}

void TechniqueSet::measure_times(const std::vector<BenchPose>& poses, int rounds, const Progress& progress) {
    std::vector<Technique*> techniques;
    for (const std::unique_ptr<Technique>& technique : techniques_) {
        techniques.push_back(technique.get());
    }
    const std::vector<FrameTimes> times = time_interleaved(techniques, poses, TimingPlan{rounds}, progress);
    for (std::size_t k = 0; k < techniques.size(); ++k) {
        results_[k].time_ms = spread_of(times[k].wall_ms);
        results_[k].cpu_ms = quantile(times[k].cpu_ms, 0.5);
    }
    in_units_of_floor(results_);
}

void in_units_of_floor(std::span<TechniqueResult> results) {
    double wall_ms = std::numeric_limits<double>::infinity();
    double cpu_ms = std::numeric_limits<double>::infinity();
    for (const TechniqueResult& result : results) {
        if (result.kind == TechniqueKind::Floor) {
            wall_ms = std::min(wall_ms, result.time_ms.median);
            cpu_ms = std::min(cpu_ms, result.cpu_ms);
        }
    }
    for (TechniqueResult& result : results) {
        result.times_floor = result.time_ms.median / wall_ms;
        result.cpu_times_floor = result.cpu_ms / cpu_ms;
    }
}

} // namespace frustumscreen::bench

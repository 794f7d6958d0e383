#include "app/residency/artifact_opener.h"

#include "app/exhibit/languages.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_hull.h"
#include "app/pack/pack_site.h"
#include "app/scene/other_prop.h"
#include "app/scene/prop_outline.h"
#include "app/scene/stereo.h"
#include "app/settings/whole_zone.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace frustumscreen::residency {

namespace {

scene::SceneRequest request_of(const settings::Settings& settings, const OpenerOptions& options,
                               const pack::PackOutline& outline) {
    scene::SceneRequest request;
    request.technique = options.technique;
    request.sample_headroom = options.samples;
    request.cull_kinds = options.cull_kinds;
    request.max_blocks_on_gpu = options.max_blocks_on_gpu;
    request.visibility = scene::visibility_of(settings);
    request.table_pictures = options.table_pictures;
    std::vector<std::string> languages;
    for (const pack::PackCaption& caption : outline.description.captions) {
        request.captions.push_back(languages.size());
        languages.push_back(caption.language);
    }
    if (!options.other_languages && !languages.empty()) {
        request.captions = {exhibit::caption_for(settings.exhibit.language, languages)};
    }
    return request;
}

/// Finds the regions of a site and how large each is in the prop.
Result<void> find_site(const settings::Settings& settings, KnownArtifact& artifact) {
    const pack::PackDescription& pack = artifact.outline.description;
    TRY(const std::vector<pack::SiteRegion> packed, pack::site_regions_of(pack));
    std::vector<world::RegionBox> regions;
    for (const pack::SiteRegion& region : packed) {
        regions.push_back({region.low, region.high});
    }
    artifact.texts.entry.site = exhibit::site_ground(
        std::move(regions), pack.box_size, artifact.plan.metres_per_box, settings::make_prop(settings.prop));
    return {};
}

/// Finds the hull through which the prop's faces show the artifact, and the zone in which it is seen whole.
Result<void> find_whole_zone(const settings::Settings& settings, KnownArtifact& artifact) {
    exhibit::CatalogueEntry& entry = artifact.texts.entry;
    TRY(entry.hull, pack::hull_in(artifact.outline.description, settings::make_prop(settings.prop),
                                  scene::max_corners_in_frame));
    if (!settings::shows_zone_frame(settings)) {
        return {};
    }
    const settings::Rectangle zone =
        settings::whole_zone(settings, settings::all_eyes(settings.eye), entry.hull).rectangle;
    if (zone.half_m.x > 0.0 && zone.half_m.y > 0.0) {
        entry.zone = exhibit::ZoneFrame(zone, 0.5 * settings.prop.base_m,
                                        {settings.table.width_m, settings.table.depth_m});
    }
    return {};
}

Result<KnownArtifact> open_pack(const settings::Settings& settings, const OpenerOptions& options,
                                const std::filesystem::path& file) {
    KnownArtifact opened{.file = file, .outline = {}, .plan = {}, .texts = {}};
    const Result<pack::VerifiedPack> pack =
        pack::load_pack(file, [&](const pack::PackOutline& outline) -> Result<std::vector<std::uint32_t>> {
            TRY(scene::ScenePlan plan,
                scene::plan_scene(settings, outline, request_of(settings, options, outline)));
            opened.outline = outline;
            opened.plan = std::move(plan);
            if (settings.torch.exists()) {
                opened.plan.needs = scene::with_torches(std::move(opened.plan.needs));
            }
            return std::vector<std::uint32_t>{};
        });
    TRY_VOID(pack);
    TRY(opened.world, open_world(settings, file, opened.outline.description, opened.plan,
                                 request_of(settings, options, opened.outline)));
    if (settings.windows.exist()) {
        TRY(opened.states, at(file.string(), pack::states_of(opened.outline.description)));
    }
    TRY(opened.texts, lay_out_texts({.file = file,
                                     .pack = opened.outline.description,
                                     .captions = opened.plan.captions,
                                     .contents = settings.torch.exists(),
                                     .states = settings.windows.exist()},
                                    opened.plan.metres_per_box, text_style(settings),
                                    settings.sound.kind != settings::SoundKind::None));
    TRY_VOID(find_site(settings, opened));
    TRY_VOID(find_whole_zone(settings, opened));
    return opened;
}

/// Cut-out texels are only known once the textures are read, and by then the shaders must exist.
scene::RenderNeeds with_cut_outs(scene::RenderNeeds needs) {
    for (scene::ShaderKey key : scene::RenderNeeds(needs).draws) {
        key.cut_out = key.pass == scene::ShaderKey::Pass::Surface && !key.blocks;
        needs.draws.insert(key);
    }
    return needs;
}

/// Prepares the first artifact; its needs are then known exactly.
Result<PreparedArtifact> prepare_first(KnownArtifact& known, const OpenerOptions& options) {
    Result<PreparedArtifact> first =
        prepare_artifact(known, options.technique, options.deadline_ms, [] { return false; });
    if (first) {
        scene::ScenePlan& plan = known.plan;
        plan.needs = first->levels.needs();
        plan.left_out.insert(plan.left_out.end(), first->levels.left_out().begin(),
                             first->levels.left_out().end());
    }
    return first;
}

/// `what`, preceded by the place that it concerns, if there is one.
std::string after(const std::string& place, const std::string& what) {
    return place.empty() ? what : place + ": " + what;
}

/// The message must be complete by itself: the lines on standard error may not be visible to its reader.
tl::unexpected<Error> nothing_to_show(const std::vector<library::UnshownPack>& left_out,
                                      const std::string& packs_key) {
    if (left_out.empty()) {
        return fail(ErrorKind::BadConfiguration, "show.no_pack_named",
                    "no pack is named; name packs under [exhibit] packs in the settings or with --packs, and "
                    "make them with frustumscreen-bake");
    }
    const std::string first = left_out.front().pack + ": " + left_out.front().reason;
    return fail(ErrorKind::BadConfiguration, "show.no_pack_shown",
                after(packs_key, left_out.size() == 1
                                     ? "the pack cannot be shown: " + first
                                     : fmt::format("none of the {} packs can be shown; the first: {}",
                                                   left_out.size(), first)));
}

} // namespace

exhibit::Catalogue catalogue_of(std::span<const KnownArtifact> artifacts) {
    exhibit::Catalogue catalogue;
    std::transform(artifacts.begin(), artifacts.end(), std::back_inserter(catalogue),
                   [](const KnownArtifact& artifact) { return artifact.texts.entry; });
    return catalogue;
}

Result<OpenedArtifacts> open_artifacts(const settings::Settings& settings,
                                       std::span<const std::filesystem::path> packs,
                                       const OpenerOptions& options) {
    OpenedArtifacts all;
    all.left_out.reserve(packs.size());
    const auto leave_out = [&](const std::filesystem::path& file, const Error& error) {
        say_line(options.program, after(options.packs_key, fmt::format("left out: {}", error.message)));
        all.left_out.push_back(library::unshown_pack(file.string(), error.message));
    };
    for (const std::filesystem::path& file : packs) {
        if (!all.known.empty() && !options.other_packs) {
            break; // no button leads to further packs
        }
        if (!options.goes_on()) {
            return bad_input("show.opening_not_wanted", "not wanted any more");
        }
        Result<KnownArtifact> opened = open_pack(settings, options, file);
        if (!opened) {
            leave_out(file, opened.error());
            continue;
        }
        const pack::PackDescription& pack = opened->outline.description;
        for (const pack::PackCaption& caption : pack.captions) {
            exhibit::add_language(all.languages, caption.language);
        }
        if (const auto note =
                scene::note_other_prop(file.string(), settings.prop, opened->outline, opened->plan)) {
            all.notes.push_back(*note);
        }
        if (!all.first) {
            Result<PreparedArtifact> first = prepare_first(*opened, options);
            if (!first) {
                leave_out(file, first.error());
                continue;
            }
            all.first = std::move(*first);
        } else {
            opened->plan.needs = with_cut_outs(opened->plan.needs);
        }
        if (opened->world) {
            opened->plan.needs = with_cut_outs(needs_of(*opened->world, opened->plan.needs));
        }
        all.needs = scene::united(all.needs, opened->plan.needs);
        all.known.push_back(std::move(*opened));
    }
    if (!all.first) {
        return nothing_to_show(all.left_out, options.packs_key);
    }
    return all;
}

scene::RenderNeeds needs_of_any_pack(const settings::Settings& settings, int samples, bool reliefs_on_gpu) {
    scene::RenderNeeds needs;
    needs.samples = samples;
    const geometry::Pinhole pinhole = scene::stereo_layout(settings).pinhole;
    needs.outline = scene::largest_outline(settings, pinhole, scene::visibility_of(settings));
    needs.bent_by = scene::if_it_bends(pinhole);
    for (const bool dithered : {false, true}) {
        scene::ShaderKey key;
        key.dithered = dithered;
        key.even_light = true; // as in every live picture
        needs.draws.insert(key);
        if (reliefs_on_gpu) {
            key.blocks = true;
            needs.draws.insert(key);
        }
    }
    needs.draws.insert(scene::raster_shader());
    needs.rasterizes = true;
    needs.draws.insert({scene::ShaderKey::Pass::EdgeFeather});
    needs.draws.insert({scene::ShaderKey::Pass::TablePicture});
    needs = with_cut_outs(scene::with_cells(std::move(needs)));
    return settings.torch.exists() ? scene::with_torches(std::move(needs)) : needs;
}

TextStyle text_style(const settings::Settings& settings) {
    return {settings.exhibit.caption_height_m,
            settings.projector.pinhole.fx / settings.projector.table_from_projector.translation.z};
}

} // namespace frustumscreen::residency

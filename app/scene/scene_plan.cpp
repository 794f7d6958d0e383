#include "app/scene/scene_plan.h"

#include "app/pack/pack_file.h"
#include "app/pack/pack_hull.h"
#include "app/scene/other_prop.h"
#include "app/scene/prop_outline.h"
#include "app/scene/shader_choice.h"
#include "app/scene/stereo.h"
#include "app/settings/guided.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <memory>
#include <optional>
#include <utility>

namespace frustumscreen::scene {

namespace {

bool in(std::span<const std::uint32_t> levels, std::uint32_t level) {
    return std::find(levels.begin(), levels.end(), level) != levels.end();
}

/// "level 2", "levels 2, 3 and 5".
std::string listed(std::string_view one, std::string_view more, const std::vector<std::string>& names) {
    std::string text(names.size() == 1 ? one : more);
    for (std::size_t k = 0; k < names.size(); ++k) {
        text += k == 0 ? " " : (k + 1 == names.size() ? " and " : ", ");
        text += names[k];
    }
    return text;
}

std::vector<bool> good_levels(const pack::PackOutline& pack, const ScenePlan& plan, double tolerance_mm) {
    std::vector<bool> good;
    for (std::size_t k = 0; k < pack.levels.size(); ++k) {
        good.push_back(within_tolerance(pack.levels[k].error, worst_of(plan.seen[k]),
                                        1e3 * plan.metres_per_box, tolerance_mm));
    }
    return good;
}

/// Looks up a relief of the pack's description by its texels.
std::optional<pack::ReliefOutline> relief_of(const std::vector<pack::ReliefOutline>& reliefs,
                                             std::uint32_t texels) {
    const auto found =
        std::find_if(reliefs.begin(), reliefs.end(),
                     [texels](const pack::ReliefOutline& relief) { return relief.texels == texels; });
    return found != reliefs.end() ? std::optional(*found) : std::nullopt;
}

/// The coarsest of the wanted reliefs whose texel is at most about a pixel; otherwise the finest of them.
template <typename Wanted>
std::optional<pack::ReliefOutline> relief_for(const std::vector<pack::ReliefOutline>& reliefs,
                                              double pixel_box, const Wanted& wanted) {
    constexpr double not_clearly = 1.25;
    std::optional<pack::ReliefOutline> found;
    for (const pack::ReliefOutline& relief : reliefs) {
        if (wanted(relief)) {
            found = relief;
            if (1.0 <= not_clearly * pixel_box * relief.texels) {
                break;
            }
        }
    }
    return found;
}

/// A pack's reliefs, and the error of each as eyes see it.
struct PackReliefs {
    std::vector<pack::ReliefOutline> outlines;
    std::vector<SeenLevel> seen;

    [[nodiscard]] const SeenLevel& seen_of(const pack::ReliefOutline& relief) const {
        const auto found = std::find(outlines.begin(), outlines.end(), relief);
        return seen[static_cast<std::size_t>(found - outlines.begin())];
    }
};

/// Collects the levels and reliefs that the quality levels draw, each once.
void choose_what_is_read(const PackReliefs& reliefs, ScenePlan& plan) {
    for (const QualityLevel& quality_level : plan.quality_levels) {
        if (!quality_level.relief && !in(plan.levels, quality_level.level)) {
            plan.levels.push_back(quality_level.level);
        }
        if (quality_level.relief && !relief_of(plan.reliefs, quality_level.level)) {
            plan.reliefs.push_back(relief_of(reliefs.outlines, quality_level.level).value());
            plan.seen_reliefs.push_back(reliefs.seen_of(plan.reliefs.back()));
        }
    }
}

/// Handles levels that no quality level draws: they are read anyway, or reported as left out.
void leave_out_levels(const pack::PackOutline& pack, const SceneRequest& request, double tolerance_mm,
                      bool governed, ScenePlan& plan) {
    std::vector<std::string> finer;
    std::vector<std::string> others;
    std::vector<std::uint32_t> unused;
    for (std::uint32_t level = 0; level < pack.levels.size(); ++level) {
        if (in(plan.levels, level)) {
            continue;
        }
        unused.push_back(level);
        if (plan.levels.empty() && level == plan.exposure_level) {
            continue; // not drawn, but read
        }
        (governed && !plan.levels.empty() && level > plan.levels.front() ? finer : others)
            .push_back(fmt::format("{}", level));
    }
    if ((plan.cull_kinds & UnusedLevels) == 0) {
        plan.levels.insert(plan.levels.end(), unused.begin(), unused.end());
        return;
    }
    if (!finer.empty()) {
        plan.left_out.push_back(
            {UnusedLevels, listed("level", "levels", finer),
             fmt::format("level {} keeps within the tolerance of {:.2f} mm, so nothing finer is ever chosen",
                         plan.levels.front(), tolerance_mm)});
    }
    if (!others.empty()) {
        plan.left_out.push_back({UnusedLevels, listed("level", "levels", others),
                                 governed
                                     ? "coarser, and saves too little time to be worth a change"
                                     : fmt::format("the technique \"{}\" draws {} alone", request.technique,
                                                   name_of(plan.quality_levels.front()))});
    }
}

void choose_levels(const pack::PackOutline& pack, const SceneRequest& request, double tolerance_mm,
                   double pixel_box, QualityLevel asked, const PackReliefs& reliefs, ScenePlan& plan) {
    const bool governed = request.live && request.technique == "auto";
    asked.samples = request.samples > 0 ? request.samples : pack.description.samples;
    asked.enough = true;
    plan.quality_levels = {asked};
    if (governed) {
        const auto is_good = [&](const pack::ReliefOutline& relief) {
            return within_tolerance(relief.error, worst_of(reliefs.seen_of(relief)),
                                    1e3 * plan.metres_per_box, tolerance_mm);
        };
        const std::optional<pack::ReliefOutline> relief = relief_for(reliefs.outlines, pixel_box, is_good);
        plan.quality_levels = ladder(pack.levels, good_levels(pack, plan, tolerance_mm), asked.samples,
                                     relief, relief && relief->blocks <= request.max_blocks_on_gpu);
    }
    choose_what_is_read(reliefs, plan);
    plan.exposure_level = plan.levels.empty() ? pack.description.default_level : plan.levels.front();
    leave_out_levels(pack, request, tolerance_mm, governed, plan);
}

void choose_captions(const settings::Settings& settings, const pack::PackOutline& pack,
                     const SceneRequest& request, ScenePlan& plan) {
    const std::size_t captions = pack.description.captions.size();
    if ((plan.cull_kinds & UnusedCaptions) == 0 && request.live) {
        for (std::size_t k = 0; k < captions; ++k) {
            plan.captions.push_back(k);
        }
        return;
    }
    if (request.live && settings.exhibit.captions) {
        plan.captions = request.captions;
    }
    if (!plan.captions.empty()) {
        if (const std::size_t rest = captions - plan.captions.size(); rest > 0) {
            plan.left_out.push_back({UnusedCaptions,
                                     rest == 1 ? "the caption in another language"
                                               : fmt::format("captions in {} other languages", rest),
                                     "no button changes the language"});
        }
        return;
    }
    const std::string_view why = !request.live                ? "pictures from poses have no captions"
                                 : !settings.exhibit.captions ? "the settings switch captions off"
                                                              : "the pack has no captions";
    plan.left_out.push_back({UnusedCaptions, "captions and the typeface", std::string(why)});
}

void choose_faces(ScenePlan& plan) {
    const auto above = [](const PointZone& zone, const geometry::Plane& plane) {
        return zone.reach(plane.normal) > plane.offset;
    };
    std::vector<std::string> unseen;
    std::vector<std::string> unlit;
    for (std::size_t face = 0; face < plan.prop.faces.size(); ++face) {
        const geometry::Plane& plane = plan.prop.faces[face].plane;
        const bool seen = above(plan.visibility.eyes, plane);
        const bool lit = above(plan.visibility.lens, plane);
        if ((seen && lit) || (plan.cull_kinds & UnseenFaces) == 0) {
            plan.faces |= 1U << face;
        } else {
            (seen ? unlit : unseen).emplace_back(plan.prop.faces[face].name);
        }
    }
    if (!unseen.empty()) {
        plan.left_out.push_back(
            {UnseenFaces, listed("face", "faces", unseen), "no eye can come in front of it"});
    }
    if (!unlit.empty()) {
        plan.left_out.push_back(
            {UnseenFaces, listed("face", "faces", unlit), "the projector's light never meets it"});
    }
}

/// The number after the prefix; nullopt if anything else follows or the prefix is missing.
std::optional<std::uint32_t> number_behind(std::string_view prefix, std::string_view name) {
    if (!name.starts_with(prefix)) {
        return std::nullopt;
    }
    std::uint32_t number = 0;
    const char* const end = name.data() + name.size();
    const std::from_chars_result read = std::from_chars(name.data() + prefix.size(), end, number);
    return read.ec == std::errc{} && read.ptr == end ? std::optional(number) : std::nullopt;
}

constexpr std::string_view level_prefix = "level";
constexpr std::string_view relief_prefix = "relief";

/// A relief's name without the suffix for the GPU; other names are unchanged.
std::string_view without_gpu(std::string_view name) {
    const bool named = name.starts_with(relief_prefix) && name.ends_with(on_gpu_suffix);
    return named ? name.substr(0, name.size() - on_gpu_suffix.size()) : name;
}

/// "auto, finest, level0 to level6, relief, relief96 and relief192, each relief also with -gpu"
std::string techniques_of(const pack::PackOutline& pack, const std::vector<pack::ReliefOutline>& reliefs) {
    const std::size_t levels = pack.levels.size();
    std::vector<std::string> names{"finest",
                                   levels > 1 ? fmt::format("level0 to level{}", levels - 1) : "level0"};
    if (!reliefs.empty()) {
        names.emplace_back(relief_prefix);
    }
    for (const pack::ReliefOutline& relief : reliefs) {
        names.push_back(fmt::format("{}{}", relief_prefix, relief.texels));
    }
    return listed("auto", "auto,", names) +
           (reliefs.empty() ? "" : fmt::format(", each relief also with {}", on_gpu_suffix));
}

} // namespace

std::string name_of(const QualityLevel& quality_level) {
    return fmt::format("{}{}{}", quality_level.relief ? relief_prefix : level_prefix, quality_level.level,
                       quality_level.on_gpu ? on_gpu_suffix : "");
}

Result<QualityLevel> quality_level_of(const pack::PackOutline& pack, std::string_view technique,
                                      double pixel_box) {
    TRY(const std::vector<pack::ReliefOutline> reliefs, pack::reliefs_of(pack.description));
    const auto levels = static_cast<std::uint32_t>(pack.levels.size());
    if (technique == "auto") {
        return QualityLevel{pack.description.default_level};
    }
    if (technique == "finest") {
        return QualityLevel{levels - 1};
    }
    if (const std::optional<std::uint32_t> level = number_behind(level_prefix, technique);
        level && *level < levels) {
        return QualityLevel{*level};
    }
    const std::string_view of = without_gpu(technique);
    std::optional<std::uint32_t> texels = number_behind(relief_prefix, of);
    if (const std::optional<pack::ReliefOutline> relief =
            relief_for(reliefs, pixel_box, [](const pack::ReliefOutline&) { return true; });
        relief && of == relief_prefix) {
        texels = relief->texels;
    }
    if (texels && relief_of(reliefs, *texels)) {
        return QualityLevel{
            .level = *texels, .samples = 1, .enough = false, .relief = true, .on_gpu = of != technique};
    }
    return bad_input("scene.no_technique", "technique '{}' is not in this pack; it has {}{}", technique,
                     techniques_of(pack, reliefs),
                     technique.starts_with(relief_prefix) && reliefs.empty() ? "; bake it again for relief"
                                                                             : "");
}

bool is_technique(std::string_view name) {
    const std::string_view of = without_gpu(name);
    return name == "auto" || name == "finest" || of == relief_prefix || number_behind(level_prefix, of) ||
           number_behind(relief_prefix, of);
}

std::string_view name_of(CullKind cull_kind) {
    constexpr std::array<std::string_view, 6> names{"levels", "captions",  "shaders",
                                                    "faces",  "triangles", "detail"};
    return names.at(static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(cull_kind))));
}

Result<ScenePlan> plan_scene(const settings::Settings& settings, const pack::PackOutline& pack,
                             const SceneRequest& request) {
    TRY(std::vector<pack::ReliefOutline> reliefs, pack::reliefs_of(pack.description));
    TRY(SeenByEyes seen, seen_by_eyes(pack));
    ScenePlan plan;
    plan.seen = std::move(seen.levels);
    plan.cull_kinds = request.cull_kinds;
    const StereoLayout layout = stereo_layout(settings);
    plan.projector = layout.pinhole;
    plan.eyes = layout.count;
    plan.table_from_projector = settings.projector.table_from_projector;
    plan.prop = settings::make_prop(settings.prop);
    TRY_VOID(check_sides(settings.prop, plan.prop, pack.description));
    plan.metres_per_box =
        request.metres_per_box.value_or(pack::place(pack.description, plan.prop).metres_per_box);
    plan.visibility = request.visibility;
    if (request.light) {
        plan.light = light_compensation(settings);
        TRY(std::vector<glm::dvec3> hull, pack::hull_in(pack.description, plan.prop, max_corners_in_frame));
        plan.light->hull = std::make_shared<const std::vector<glm::dvec3>>(std::move(hull));
        plan.highlight_code = settings.render.highlight_code;
    }
    const double pixel_m =
        pixel_on_prop_m(plan.prop, plan.projector, settings.projector.table_from_projector.inverse());
    TRY(const QualityLevel asked, quality_level_of(pack, request.technique, pixel_m / plan.metres_per_box));
    choose_levels(pack, request, 1e3 * settings.render.error_tolerance_px * pixel_m,
                  pixel_m / plan.metres_per_box, asked, {std::move(reliefs), std::move(seen.reliefs)}, plan);
    choose_captions(settings, pack, request, plan);
    choose_shaders(request,
                   request.live && (settings::shows_zone_frame(settings) ||
                                    settings::guides_visitors(settings) || request.table_pictures ||
                                    settings::tells_of_sticks(settings) || settings.windows.exist()),
                   plan);
    choose_faces(plan);
    plan.needs.outline = largest_outline(settings, plan.projector, plan.visibility);
    plan.needs.bent_by = if_it_bends(plan.projector);
    return plan;
}

} // namespace frustumscreen::scene

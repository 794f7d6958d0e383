#include "app/bench/measures/verdicts.h"

#include "app/bench/measures/dominance.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::bench {

namespace {

bool silhouette_holds(const PictureError& error, const Limits& limits) {
    return error.silhouette_percent <= limits.silhouette_percent ||
           error.outline_shift_px <= limits.outline_shift_px;
}

LimitVerdict judge_silhouette(const TechniqueResult& level, const Limits& limits) {
    const auto failed =
        std::count_if(level.errors.begin(), level.errors.end(),
                      [&limits](const PictureError& error) { return !silhouette_holds(error, limits); });
    return {.what = fmt::format("silhouette <= {:g} % or {:g} px", limits.silhouette_percent,
                                limits.outline_shift_px),
            .found = fmt::format("worst {:.3f} %, {:.3f} px; {} of {} poses beyond",
                                 level.error.worst.silhouette_percent, level.error.worst.outline_shift_px,
                                 failed, level.errors.size()),
            .held = failed == 0};
}

bool errors_hold(const TechniqueResult& level, const Limits& limits) {
    return level.error.worst.geometric_mean_mm <= limits.geometric_mean_mm &&
           level.error.worst.sixteen_rays.rmse <= limits.colour_rmse &&
           std::all_of(level.errors.begin(), level.errors.end(),
                       [&limits](const PictureError& error) { return silhouette_holds(error, limits); });
}

/// Judges the cost of the pack's cheapest level or relief that keeps `limits`.
LimitVerdict judge_cheapest(const SetUpResult& result, const std::string& whose, const Limits& limits) {
    const TechniqueResult* fine = nullptr;
    for (const TechniqueResult& technique : result.techniques) {
        if (is_judged_level(technique.kind) && errors_hold(technique, limits) &&
            (fine == nullptr || technique.times_floor < fine->times_floor)) {
            fine = &technique;
        }
    }
    return {.what = fmt::format("{}: <= {:g} % or {:g} px, <= {:g} mm at <= {:g} x floor", whose,
                                limits.silhouette_percent, limits.outline_shift_px, limits.geometric_mean_mm,
                                limits.times_floor),
            .found = fine != nullptr ? fmt::format("{}: {:.2f} x", fine->name, fine->times_floor)
                                     : std::string("no level or relief is as accurate"),
            .held = fine != nullptr && fine->times_floor <= limits.times_floor};
}

/// Judges the picture that the kiosk shows, lit and with all its samples.
std::vector<LimitVerdict> judge_shown(const TechniqueResult& level, const Limits& limits) {
    if (!level.error.worst.shown) {
        return {};
    }
    const ShownError& worst = *level.error.worst.shown;
    double beside_samples_px = 0.0;
    for (const PictureError& error : level.errors) {
        beside_samples_px =
            std::max(beside_samples_px, error.shown->cover_px - error.shown->cover_of_samples_px);
    }
    const double px = limits.outline_shift_px;
    return {{fmt::format("as shown: colour RMSE <= {:g}", limits.colour_rmse),
             fmt::format("worst pose {:.2f}", worst.colour.rmse), worst.colour.rmse <= limits.colour_rmse},
            {fmt::format("as shown: within {:g} px of its place", px),
             fmt::format("worst pose {:.3f} px", worst.shift_px), worst.shift_px <= px},
            {fmt::format("as shown: cover errs by at most {:g} px more than that of exact outlines", px),
             fmt::format("worst pose {:.3f} px", beside_samples_px), beside_samples_px <= px},
            {fmt::format("as shown: outline wider or narrower by at most {:g} px", px),
             fmt::format("worst pose {:.3f} px", worst.cover_bias_px), worst.cover_bias_px <= px}};
}

} // namespace

std::string lines_of(std::span<const LimitVerdict> verdicts) {
    std::string lines;
    for (const LimitVerdict& verdict : verdicts) {
        lines += fmt::format("{} {} ({})\n", verdict.held ? "held  " : (verdict.wished ? "unmet " : "MISSED"),
                             verdict.what, verdict.found);
    }
    return lines;
}

std::vector<LimitVerdict> judge(const TechniqueResult& level, const Limits& limits) {
    const PictureError& worst = level.error.worst;
    std::vector<LimitVerdict> verdicts = {
        judge_silhouette(level, limits),
        {fmt::format("mean geometric error <= {:g} mm", limits.geometric_mean_mm),
         fmt::format("worst pose {:.4f} mm", worst.geometric_mean_mm),
         worst.geometric_mean_mm <= limits.geometric_mean_mm},
        {fmt::format("colour RMSE <= {:g}", limits.colour_rmse),
         fmt::format("worst pose {:.2f}", worst.sixteen_rays.rmse),
         worst.sixteen_rays.rmse <= limits.colour_rmse},
        {fmt::format("shown within {:g} px of the scan's place", limits.outline_shift_px),
         fmt::format("worst pose {:.3f} px", worst.picture_shift_px),
         worst.picture_shift_px <= limits.outline_shift_px}};
    if (!level.drawn_as.empty()) {
        verdicts.push_back({.what = fmt::format("drawn within {:g} px of its place", max_drawn_shift_px),
                            .found = fmt::format("worst pose {:.3f} px", worst.drawn_shift_px),
                            .held = worst.drawn_shift_px <= max_drawn_shift_px});
    }
    const std::vector<LimitVerdict> shown = judge_shown(level, limits);
    verdicts.insert(verdicts.end(), shown.begin(), shown.end());
    if (limits.times_floor > 0.0) {
        verdicts.push_back({.what = fmt::format("median cost <= {:g} x floor", limits.times_floor),
                            .found = fmt::format("{:.2f} x", level.times_floor),
                            .held = level.times_floor <= limits.times_floor});
    }
    return verdicts;
}

const TechniqueResult* cheapest_as_good(const SetUpResult& result, const TechniqueResult& two_pass) {
    const TechniqueResult* best = nullptr;
    for (const TechniqueResult& technique : result.techniques) {
        if (technique.kind == TechniqueKind::PackLevel && errs_no_more(technique, two_pass) &&
            (best == nullptr || technique.times_floor < best->times_floor)) {
            best = &technique;
        }
    }
    return best;
}

/// The exhibit draws this while frames are in time: the faster of a mesh level and a relief that are both
/// good enough.
const TechniqueResult* auto_drawn(const SetUpResult& result) {
    const TechniqueResult* drawn = nullptr;
    for (const TechniqueResult& technique : result.techniques) {
        if (technique.kind == TechniqueKind::Auto &&
            (drawn == nullptr || technique.times_floor < drawn->times_floor)) {
            drawn = &technique;
        }
    }
    return drawn;
}

double min_two_pass_speed_up(std::uint64_t triangles) {
    return triangles >= 4 * min_two_pass_triangles ? 25.0 : 8.0;
}

std::vector<LimitVerdict> judge(const SetUpResult& result) {
    std::vector<LimitVerdict> verdicts;
    const auto add = [&verdicts](const std::string& whose, std::vector<LimitVerdict> more) {
        for (LimitVerdict& verdict : more) {
            verdict.what = whose + ": " + verdict.what;
            verdicts.push_back(std::move(verdict));
        }
    };
    const TechniqueResult* const drawn = auto_drawn(result);
    for (const TechniqueResult& technique : result.techniques) {
        if (technique.kind == TechniqueKind::PackLevel &&
            technique.level == static_cast<int>(result.default_level)) {
            add("default level", judge(technique, default_level_limits));
            add("default level, pushed", judge(technique, pushed_default_limits));
        }
        if (&technique == drawn) {
            add(technique.name, judge(technique, default_level_limits));
        }
        if (technique.kind == TechniqueKind::PackLevel &&
            technique.level == static_cast<int>(result.finest_level)) {
            add("finest level", judge(technique, finest_level_limits));
        }
    }
    for (const TechniqueResult* two_pass : at_best_eye_images(result)) {
        if (two_pass->kind == TechniqueKind::TwoPass && two_pass->triangles >= min_two_pass_triangles) {
            const double least = min_two_pass_speed_up(two_pass->triangles);
            const TechniqueResult* level = cheapest_as_good(result, *two_pass);
            const double speed_up = level != nullptr ? two_pass->times_floor / level->times_floor : 0.0;
            add(two_pass->name, {{fmt::format("a level as good is >= {:g} x faster", least),
                                  level != nullptr ? fmt::format("{}: {:.1f} x faster", level->name, speed_up)
                                                   : std::string("no level is as good"),
                                  speed_up >= least}});
        }
    }
    verdicts.push_back(judge_cheapest(result, "a fine level or relief", fine_level_limits));
    for (const Limits& limits : {wished_cheap_limits, wished_fine_limits}) {
        verdicts.push_back(judge_cheapest(result, "goal", limits));
        verdicts.back().wished = true;
    }
    const std::vector<LimitVerdict> dominance = judge_dominance(result);
    verdicts.insert(verdicts.end(), dominance.begin(), dominance.end());
    return verdicts;
}

Result<void> require_limits(std::span<const SetUpResult> results) {
    std::size_t missed = 0;
    std::string first;
    for (const SetUpResult& result : results) {
        for (const LimitVerdict& verdict : judge(result)) {
            if (!verdict.held && !verdict.wished && missed++ == 0) {
                first = fmt::format("{}, {} ({})", result.name, verdict.what, verdict.found);
            }
        }
    }
    if (missed == 0) {
        return {};
    }
    return fail(ErrorKind::Internal, "bench.limits_missed",
                "{} of the limits above are missed, the first: {}; --limits none only measures", missed,
                first);
}

} // namespace frustumscreen::bench

#include "app/bench/measures/dominance.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::bench {

namespace {

bool has_eye_image(const TechniqueResult& technique) {
    return technique.kind == TechniqueKind::TwoPass || technique.kind == TechniqueKind::TwoPassLod;
}

bool of_one_mesh(const TechniqueResult& a, const TechniqueResult& b) {
    return a.kind == b.kind && a.triangles == b.triangles && a.samples == b.samples;
}

/// Another eye image of the same mesh has smaller errors at about equal cost, or no larger errors at lower
/// cost.
bool is_beaten(const SetUpResult& result, const TechniqueResult& one) {
    return std::any_of(result.techniques.begin(), result.techniques.end(), [&one](const auto& other) {
        return of_one_mesh(other, one) && errs_no_more(other, one) &&
               other.times_floor <= one.times_floor * (1.0 + cost_tolerance) &&
               (!errs_no_more(one, other) || other.times_floor < one.times_floor);
    });
}

bool has_better_eye_image(const SetUpResult& result, const TechniqueResult& one) {
    return is_beaten(result, one) ||
           std::any_of(result.techniques.begin(), result.techniques.end(), [&](const auto& other) {
               return of_one_mesh(other, one) && other.times_floor < one.times_floor &&
                      !is_beaten(result, other);
           });
}

std::string figures_of(const TechniqueResult& technique) {
    const PictureError& mean = technique.error.mean;
    return fmt::format("{} at {:.2f} x ({:.3f} %, {:.4f} mm, RMSE {:.2f})", technique.name,
                       technique.times_floor, mean.silhouette_percent, mean.geometric_mean_mm,
                       mean.sixteen_rays.rmse);
}

bool errs_no_more_by(Dominance by, const TechniqueResult& a, const TechniqueResult& b) {
    const PictureError& x = a.error.mean;
    const PictureError& y = b.error.mean;
    return by == Dominance::Shape
               ? x.silhouette_percent <= y.silhouette_percent && x.geometric_mean_mm <= y.geometric_mean_mm
               : x.sixteen_rays.rmse <= y.sixteen_rays.rmse;
}

/// Techniques whose pictures are compared with those of `level`.
std::vector<const TechniqueResult*> rivals(const SetUpResult& result, const TechniqueResult& level,
                                           Dominance by) {
    std::vector<const TechniqueResult*> found;
    if (by == Dominance::Colour && result.baked_light) {
        return found;
    }
    for (const TechniqueResult& peer : result.techniques) {
        if (is_judged_peer(peer.kind) && (by == Dominance::Colour || peer.samples == level.samples)) {
            found.push_back(&peer);
        }
    }
    return found;
}

bool is_cheaper(const TechniqueResult& peer, const TechniqueResult& level) {
    return peer.times_floor * (1.0 + cost_tolerance) < level.times_floor;
}

void append(std::string& list, const std::string& more) {
    list += (list.empty() ? "" : "; ") + more;
}

LimitVerdict judge_level(const SetUpResult& result, const TechniqueResult& level, Dominance by) {
    std::string dominating;
    std::string tied;
    for (const TechniqueResult* peer : rivals(result, level, by)) {
        if (!errs_no_more_by(by, *peer, level)) {
            continue;
        }
        if (is_cheaper(*peer, level)) {
            append(dominating, figures_of(*peer));
        } else if (peer->times_floor <= level.times_floor * (1.0 + cost_tolerance)) {
            append(tied, figures_of(*peer));
        }
    }
    std::string found = dominating.empty() ? "none" : dominating;
    found += " beside " + figures_of(level);
    if (!tied.empty()) {
        found += fmt::format("; within {:g} % of its cost: {}", 100.0 * cost_tolerance, tied);
    }
    return {.what = by == Dominance::Shape
                        ? fmt::format("{}: no peer of {} samples a pixel dominates its shape", level.name,
                                      level.samples)
                        : fmt::format("{}: no peer dominates its colour", level.name),
            .found = found,
            .held = dominating.empty()};
}

} // namespace

bool is_judged_peer(TechniqueKind kind) {
    return kind != TechniqueKind::Floor && !is_judged_level(kind) && kind != TechniqueKind::Auto &&
           kind != TechniqueKind::ReliefRaster && kind != TechniqueKind::ReliefGpu;
}

bool is_judged_level(TechniqueKind kind) {
    return kind == TechniqueKind::PackLevel || kind == TechniqueKind::PackRelief;
}

bool errs_no_more(const TechniqueResult& a, const TechniqueResult& b) {
    return errs_no_more_by(Dominance::Shape, a, b) && errs_no_more_by(Dominance::Colour, a, b);
}

std::string dominated_by(const SetUpResult& result, const TechniqueResult& level, Dominance by) {
    std::string names;
    for (const TechniqueResult* peer : rivals(result, level, by)) {
        if (errs_no_more_by(by, *peer, level) && is_cheaper(*peer, level)) {
            append(names, peer->name);
        }
    }
    return names;
}

std::vector<const TechniqueResult*> at_best_eye_images(const SetUpResult& result) {
    std::vector<const TechniqueResult*> best;
    for (const TechniqueResult& technique : result.techniques) {
        if (!has_eye_image(technique) || !has_better_eye_image(result, technique)) {
            best.push_back(&technique);
        }
    }
    return best;
}

std::vector<LimitVerdict> judge_dominance(const SetUpResult& result) {
    std::vector<LimitVerdict> verdicts;
    for (const TechniqueResult& technique : result.techniques) {
        if (!is_judged_level(technique.kind)) {
            continue;
        }
        for (const Dominance by : {Dominance::Shape, Dominance::Colour}) {
            if (!rivals(result, technique, by).empty()) {
                verdicts.push_back(judge_level(result, technique, by));
            }
        }
    }
    return verdicts;
}

} // namespace frustumscreen::bench

#include "app/scene/error_estimate.h"

#include "app/pack/pack_relief.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_inverse.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::scene {

namespace {

/// Width of the weights, radians: half of the angle between neighbouring eyes of the bake.
constexpr double spread = 0.15;
constexpr double rounding_px = 0.00015;
/// The 95th percentile of a length in two directions, over its mean: sqrt(ln 20 / (pi / 4)).
constexpr double p95_of_rounding = 1.95;

/// The face of the plan through which the eye sees a point in the prop; null if that face is dark.
const FacePlan* seen_through(const geometry::PropShape& prop, const FramePlan& plan, const glm::dvec3& eye,
                             const glm::dvec3& point) {
    double farthest = -std::numeric_limits<double>::infinity();
    std::size_t through = prop.faces.size();
    for (std::size_t face = 0; face < prop.faces.size(); ++face) {
        const double eye_above = prop.faces[face].plane.distance(eye);
        const double point_above = prop.faces[face].plane.distance(point);
        const double at = eye_above / (eye_above - point_above);
        if (eye_above > 0.0 && eye_above > point_above && at > farthest) {
            farthest = at;
            through = face;
        }
    }
    const auto found = std::find_if(plan.faces.begin(), plan.faces.end(), [through](const FacePlan& face) {
        return static_cast<std::size_t>(face.face) == through;
    });
    return found != plan.faces.end() ? &*found : nullptr;
}

/// Errors seen by one eye of the bake, weighted by the pixels that show them now.
struct Seen {
    double mean_box = 0.0;
    double over_even = 1.0; ///< this mean over the mean of evenly spaced rays
    double pixel_mm = 0.0;  ///< size of a pixel where it lands on the artifact
};

Seen shown(const pack::SeenEye& seen, const pack::SeenError& error, const geometry::PropShape& prop,
           const glm::dmat4& prop_from_box, const glm::dvec3& eye, const FramePlan& plan) {
    double pixels = 0.0;
    double even_box = 0.0;
    Seen sum;
    for (std::size_t k = 0; k < pack::seen_patches; ++k) {
        const pack::SeenPatch& patch = seen.patches[k];
        const auto error_box = static_cast<double>(error.patches_box[k]);
        even_box += patch.share * error_box;
        const FacePlan* const face =
            patch.share > 0.0
                ? seen_through(prop, plan, eye, glm::dvec3(prop_from_box * glm::dvec4(patch.place, 1.0)))
                : nullptr;
        if (face != nullptr && face->pixels_per_m > 0.0) {
            const double share = patch.share * face->pixels_per_m * face->pixels_per_m;
            pixels += share;
            sum.mean_box += share * error_box;
            sum.pixel_mm += share * 1e3 / face->pixels_per_m;
        }
    }
    if (!(pixels > 0.0)) { // everything that this eye saw is dark from here, or edge-on
        return {static_cast<double>(error.mean_box), 1.0, 0.0};
    }
    sum.mean_box /= pixels;
    sum.pixel_mm /= pixels;
    sum.over_even = even_box > 0.0 ? sum.mean_box / even_box : 1.0;
    return sum;
}

} // namespace

SeenLevel derived(const pack::LevelError& error, const glm::dvec3& box_size) {
    constexpr float along_the_ray = 2.0F;
    pack::SeenEye eye;
    eye.steepness = 1.5F; // about that of a ball
    eye.patches[0] = {{0.0, 0.0, 0.5 * box_size.z}, 1.0};
    pack::SeenError seen{.mean_box = along_the_ray * error.mean_box,
                         .p95_box = along_the_ray * error.p95_box,
                         .outline_shift_box = error.mean_box,
                         .silhouette_share = 0.0F,
                         .patches_box = {}};
    seen.patches_box.fill(seen.mean_box);
    return {{eye}, {seen}};
}

Result<SeenByEyes> seen_by_eyes(const pack::PackOutline& pack) {
    TRY(const std::vector<pack::ReliefOutline> reliefs, pack::reliefs_of(pack.description));
    TRY(const pack::SeenErrors seen, pack::seen_errors_of(pack.description, pack.levels.size()));
    if (!seen.reliefs.empty() && seen.reliefs.size() != reliefs.size()) {
        return bad_input("scene.seen_reliefs",
                         "sections.seen_reliefs.data has {} reliefs; allowed are the pack's {}",
                         seen.reliefs.size(), reliefs.size());
    }
    SeenByEyes surfaces;
    for (std::size_t k = 0; k < pack.levels.size(); ++k) {
        surfaces.levels.push_back(seen.eyes.empty() ? derived(pack.levels[k].error, pack.description.box_size)
                                                    : SeenLevel{seen.eyes, seen.levels[k]});
    }
    for (std::size_t k = 0; k < reliefs.size(); ++k) {
        surfaces.reliefs.push_back(seen.reliefs.empty() ? derived(reliefs[k].error, pack.description.box_size)
                                                        : SeenLevel{seen.eyes, seen.reliefs[k]});
    }
    return surfaces;
}

pack::SeenError worst_of(const SeenLevel& seen) {
    pack::SeenError worst;
    for (const pack::SeenError& each : seen.errors) { // keeps NaN if there is only one eye
        worst.mean_box = std::max(each.mean_box, worst.mean_box);
        worst.p95_box = std::max(each.p95_box, worst.p95_box);
        worst.outline_shift_box = std::max(each.outline_shift_box, worst.outline_shift_box);
        worst.silhouette_share = std::max(each.silhouette_share, worst.silhouette_share);
        for (std::size_t k = 0; k < pack::seen_patches; ++k) {
            worst.patches_box[k] = std::max(each.patches_box[k], worst.patches_box[k]);
        }
    }
    return worst;
}

std::optional<ErrorEstimate> estimate_error(const SeenLevel& seen, const geometry::PropShape& prop,
                                            const PlacedLevel& level, const PlanView& view,
                                            const FramePlan& plan) {
    if (plan.faces.empty()) {
        return std::nullopt;
    }
    const glm::dmat4 prop_from_box = level.prop_from_box();
    const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(prop_from_box))));
    const glm::dvec3 eye = view.table_from_prop.inverse().point(view.eyes_m.front());
    const glm::dvec3 eye_box(glm::affineInverse(prop_from_box) * glm::dvec4(eye, 1.0));
    const glm::dvec3 towards = glm::normalize(eye_box - glm::dvec3(0.0, 0.0, 0.5 * level.box_size.z));
    ErrorEstimate sum;
    double weights = 0.0;
    for (std::size_t k = 0; k < seen.eyes.size(); ++k) {
        const glm::dvec3 apart = seen.eyes[k].towards - towards;
        const double weight = std::exp(-glm::dot(apart, apart) / (2.0 * spread * spread));
        const Seen now = shown(seen.eyes[k], seen.errors[k], prop, prop_from_box, eye, plan);
        const double mean_mm = 1e3 * scale * now.mean_box;
        const double p95_mm = 1e3 * scale * static_cast<double>(seen.errors[k].p95_box) * now.over_even;
        const double rounding_mm = rounding_px * static_cast<double>(seen.eyes[k].steepness) * now.pixel_mm;
        sum.mean_mm += weight * std::hypot(mean_mm, rounding_mm);
        sum.p95_mm += weight * std::hypot(p95_mm, p95_of_rounding * rounding_mm);
        weights += weight;
    }
    return ErrorEstimate{sum.mean_mm / weights, sum.p95_mm / weights};
}

std::optional<ErrorEstimate> larger(const std::optional<ErrorEstimate>& a,
                                    const std::optional<ErrorEstimate>& b) {
    if (!a || !b) {
        return a ? a : b;
    }
    return ErrorEstimate{std::fmax(a->mean_mm, b->mean_mm), std::fmax(a->p95_mm, b->p95_mm)};
}

} // namespace frustumscreen::scene

#include "app/calibration/check_rests.h"

#include "app/calibration/check_touches.h"
#include "app/calibration/rest_starts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::calibration {

namespace {

/// A prop's points on its sheet reach less than the first, and more than the second.
constexpr double largest_prop_m = 1.0;
constexpr double min_prop_m = 0.02;

std::optional<VerdictReason> bad_points(const Rest& rest) {
    if (rest.points.empty()) {
        return VerdictReason{"rests.no_points", fmt::format("rest {} has no points", rest.name)};
    }
    double reach = 0.0;
    for (const PropPoint& point : rest.points) {
        if (!std::isfinite(point.prop_m.x + point.prop_m.y + point.prop_m.z)) {
            return VerdictReason{"rests.not_finite",
                                 fmt::format("rest {} has a number that is not finite", rest.name)};
        }
        reach = std::fmax(reach, glm::length(point.prop_m));
    }
    if (reach > largest_prop_m || reach < min_prop_m) {
        return VerdictReason{
            "rests.prop_unit",
            fmt::format("the points of rest {} reach {:.3g} m from the prop's middle: are they in "
                        "millimetres or inches? Allowed are metres",
                        rest.name, reach)};
    }
    return std::nullopt;
}

} // namespace

std::optional<VerdictReason> refusal_of(std::span<const Rest> rests, int width, int height) {
    if (rests.size() < min_rests) {
        return VerdictReason{
            "rests.too_few",
            fmt::format("{} rests of the prop are too few: at least {} are needed, and 16 are recommended",
                        rests.size(), min_rests)};
    }
    Touches places; // one per point, for the checks of pixels
    std::vector<int> names;
    for (const Rest& rest : rests) {
        if (auto reason = bad_points(rest)) {
            return reason;
        }
        for (const PropPoint& point : rest.points) {
            places.push_back({rest.tracker_from_sensor, point.pixel, rest.block_m.value_or(0.0)});
            names.push_back(rest.name);
        }
    }
    const auto name = [&](std::size_t k) { return fmt::format("rest {}", names[k]); };
    if (auto reason = refusal_of_values(places, {width, height}, name)) {
        return reason;
    }
    return refusal_of_spread(places, width, "rests");
}

std::optional<VerdictReason> refusal_of(std::span<const Rest> rests,
                                        std::span<const std::optional<PlaneView>> views) {
    const auto seen =
        std::count_if(views.begin(), views.end(), [](const auto& view) { return view.has_value(); });
    const auto mirrored =
        std::count_if(views.begin(), views.end(), [](const auto& view) { return view && view->is_mirrored; });
    if (3 * seen < 2 * static_cast<std::ptrdiff_t>(rests.size())) {
        return VerdictReason{
            "rests.points_unfit",
            "in most rests no four points of one level of the prop fit together: do they lie in one line, "
            "or "
            "are they named in another order than they were seen?"};
    }
    if (2 * mirrored > seen) {
        return VerdictReason{
            "rests.mirrored",
            "the rests are mirrored: is the projector set to rear projection, or are the prop's x and y "
            "exchanged?"};
    }
    const Touches standing = as_touches(rests, views);
    if (standing.size() < min_standing) {
        return VerdictReason{
            "rests.too_few_standing",
            fmt::format("the prop stood on the table or on a block in {} rests, which does not tell where "
                        "the table is: at least {} are needed",
                        standing.size(), min_standing)};
    }
    const auto [low, high] =
        std::minmax_element(standing.begin(), standing.end(),
                            [](const Touch& a, const Touch& b) { return a.block_m < b.block_m; });
    // Rests at one height reveal neither wrong units nor the up direction.
    return high->block_m - low->block_m < min_height_m ? std::nullopt
                                                       : refusal_of_directions(standing, "rests");
}

} // namespace frustumscreen::calibration

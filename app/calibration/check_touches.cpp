#include "app/calibration/check_touches.h"

#include "app/calibration/dense_solvers.h"
#include "app/calibration/starts.h"
#include "app/calibration/unknowns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::calibration {

namespace {

using Refusal = std::optional<VerdictReason>;

/// No table, and no tracker's range, is larger.
constexpr double farthest_m = 6.0;
constexpr double highest_block_m = 1.0;
/// Least spread of touches along their principal axis and across it, as shares of the picture's width.
constexpr double min_length = 0.25;
constexpr double min_breadth = 0.08;

Refusal bad_numbers(std::span<const Touch> touches, const PlaceName& name) {
    for (std::size_t k = 0; k < touches.size(); ++k) {
        const Touch& touch = touches[k];
        const glm::dvec3& t = touch.tracker_from_sensor.translation;
        if (!std::isfinite(t.x + t.y + t.z + touch.pixel.x + touch.pixel.y + touch.block_m)) {
            return VerdictReason{"points.not_finite",
                                 fmt::format("{} has a number that is not finite", name(k))};
        }
    }
    return std::nullopt;
}

Refusal wrong_units(std::span<const Touch> touches, const glm::dvec2& picture, const PlaceName& name) {
    double reach = 0.0;
    double highest = 0.0;
    double pixel = 0.0;
    const glm::dvec3& first = touches[0].tracker_from_sensor.translation;
    for (const Touch& touch : touches) {
        reach = std::fmax(reach, glm::distance(touch.tracker_from_sensor.translation, first));
        highest = std::fmax(highest, std::abs(touch.block_m));
        pixel = std::fmax(pixel, std::fmax(std::abs(touch.pixel.x), std::abs(touch.pixel.y)));
    }
    if (reach > farthest_m) {
        return VerdictReason{"points.tracker_unit",
                             fmt::format("the tracker's places lie {:.0f} m apart: are they in millimetres "
                                         "or inches? Allowed are metres",
                                         reach)};
    }
    if (highest > highest_block_m) {
        return VerdictReason{
            "points.block_unit",
            fmt::format("a block is {:.3g} m high: is that in millimetres or inches? Allowed are metres",
                        highest)};
    }
    if (pixel <= 1.5) {
        return VerdictReason{
            "points.pixel_unit",
            "the pixels are all below 1.5: are they shares of the picture? Allowed are pixels"};
    }
    for (std::size_t k = 0; k < touches.size(); ++k) {
        const glm::dvec2& p = touches[k].pixel;
        if (p.x < 0.0 || p.y < 0.0 || p.x > picture.x || p.y > picture.y) {
            return VerdictReason{
                "points.outside_picture",
                fmt::format("{} is at pixel ({:.0f}, {:.0f}), outside the picture of {:.0f} x {:.0f}: is "
                            "that the projector's picture?",
                            name(k), p.x, p.y, picture.x, picture.y)};
        }
    }
    return std::nullopt;
}

/// Spread of points along and across their principal axis: four standard deviations, roughly the length of an
/// evenly filled area.
glm::dvec2 spread(std::span<const Touch> touches) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
    const auto count = static_cast<double>(touches.size());
    for (const Touch& touch : touches) {
        mean += Eigen::Vector2d(touch.pixel.x, touch.pixel.y) / count;
    }
    for (const Touch& touch : touches) {
        const Eigen::Vector2d off = Eigen::Vector2d(touch.pixel.x, touch.pixel.y) - mean;
        square += off * off.transpose() / count;
    }
    const Eigen::Vector2d values = axes_of(square).values;
    return {4.0 * std::sqrt(std::fmax(0.0, values[1])), 4.0 * std::sqrt(std::fmax(0.0, values[0]))};
}

std::size_t different_places(std::span<const Touch> touches) {
    std::vector<Touch> found;
    for (const Touch& touch : touches) {
        const bool known = std::any_of(found.begin(), found.end(), [&](const Touch& other) {
            return glm::distance(other.pixel, touch.pixel) < 2.0 &&
                   std::abs(other.block_m - touch.block_m) < 1e-3;
        });
        if (!known) {
            found.push_back(touch);
        }
    }
    return found.size();
}

Refusal too_few(MessageId id, std::size_t count, std::string_view of, std::size_t least,
                std::size_t recommended) {
    if (count >= least) {
        return std::nullopt;
    }
    return VerdictReason{id, fmt::format("{} {}: at least {} are needed, and {} are recommended", count, of,
                                         least, recommended)};
}

Refusal flat(std::span<const Touch> touches) {
    const auto [low, high] = std::minmax_element(
        touches.begin(), touches.end(), [](const Touch& a, const Touch& b) { return a.block_m < b.block_m; });
    if (high->block_m - low->block_m < min_height_m) {
        return VerdictReason{
            "points.one_height",
            "all touches are at one height, which does not tell a near projector from a far one: touch "
            "half of them on a block, as high as the prop"};
    }
    return std::nullopt;
}

std::string touch_name(std::size_t k) {
    return fmt::format("touch {}", k + 1);
}

} // namespace

Refusal refusal_of_values(std::span<const Touch> touches, const glm::dvec2& picture, const PlaceName& name) {
    if (Refusal found = bad_numbers(touches, name)) {
        return found;
    }
    return wrong_units(touches, picture, name);
}

Refusal refusal_of_spread(std::span<const Touch> touches, double width, std::string_view places) {
    const glm::dvec2 spread_px = spread(touches);
    if (spread_px.x < min_length * width) {
        return VerdictReason{
            "points.too_near",
            fmt::format(
                "the {} are too near to each other, so that the picture's edges would be guessed: spread "
                "them over the whole picture",
                places)};
    }
    if (spread_px.y < min_breadth * width) {
        return VerdictReason{
            "points.in_one_line",
            fmt::format("the {} lie nearly in one line, which does not say how the picture lies beside it: "
                        "spread them over the whole picture",
                        places)};
    }
    return std::nullopt;
}

Refusal refusal_of_directions(std::span<const Touch> touches, std::string_view places) {
    const HeightFit heights = fit_heights(touches);
    const double scale = glm::length(heights.up);
    if (scale < 0.2 || scale > 5.0) {
        // Wrong units give factors of 1000, 100, 39.37 or 25.4. Factors between these limits are noise or the
        // sensor's lever arm.
        return VerdictReason{
            "points.height_unit",
            fmt::format("the blocks' heights change by {:.3g} m where the tracker moved by 1 m upwards: are "
                        "places and "
                        "heights in the same unit, and the heights those of the touched places?",
                        scale)};
    }
    const PixelFit pixels = fit_pixels(touches);
    // Seen from the projector's side, u to the right and v down make a left-handed system with up.
    const glm::dvec3 u = glm::normalize(pixels.across_u);
    const glm::dvec3 v = glm::normalize(pixels.across_v);
    const double handed = glm::dot(glm::cross(u, v), heights.up / scale);
    if (handed > 0.3) {
        return VerdictReason{
            "points.mirrored",
            fmt::format("the {} are mirrored: is the projector set to rear projection, or are two of the "
                        "tracker's columns exchanged?",
                        places)};
    }
    return std::nullopt;
}

Refusal refusal_of(std::span<const Touch> touches, int width, int height) {
    if (Refusal few = too_few("points.too_few", touches.size(), "touches are too few", min_touches, 9)) {
        return few;
    }
    for (Refusal found : {refusal_of_values(touches, {width, height}, touch_name),
                          too_few("points.too_few_places", different_places(touches),
                                  "different places were touched", min_touches, 9),
                          flat(touches), refusal_of_spread(touches, width, "touches")}) {
        if (found) {
            return found;
        }
    }
    return refusal_of_directions(touches, "touches");
}

Refusal refusal_of_few(std::span<const Touch> touches, int width, int height) {
    if (Refusal few = too_few("points.too_few", touches.size(), "touches are too few", min_touch_up, 5)) {
        return few;
    }
    for (Refusal found : {refusal_of_values(touches, {width, height}, touch_name),
                          too_few("points.too_few_places", different_places(touches),
                                  "different places were touched", min_touch_up, 5),
                          refusal_of_spread(touches, width, "touches")}) {
        if (found) {
            return found;
        }
    }
    return std::nullopt;
}

} // namespace frustumscreen::calibration

#include "app/exhibit/advice_sign.h"

#include "app/geometry/time_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace frustumscreen::exhibit {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double gap_m = 0.012;    ///< from the shadow
constexpr double border_m = 0.006; ///< from the picture's edge
constexpr double glide_m = 0.018;
constexpr double swing_rad = 0.16;
constexpr double period_s = 1.8;
constexpr double fade_s = 0.3;

constexpr glm::dvec2 arrow_size_m{0.085, 0.05};
constexpr glm::dvec2 icon_size_m{0.07, 0.07};
/// The arc is drawn for this radius and scaled with the prop's shadow.
constexpr double arc_radius_m = 0.12;
constexpr double arc_half_angle = 0.62;
constexpr double arc_half_width_m = 0.006;
constexpr double arc_head_m = 0.018;

/// The arc's picture lies below its centre: from the lowest point of the arc up to its ends, with space for the head.
constexpr double arc_low_m = -arc_radius_m - arc_head_m;
const double arc_high_m = -arc_radius_m * std::cos(arc_half_angle) + 1.6 * arc_head_m;
const double arc_half_m = arc_radius_m * std::sin(arc_half_angle) + 1.6 * arc_head_m;
/// A smaller arc stands beside the prop, and is no smaller than an arrow.
constexpr double usual_arc_scale = 1.0;
constexpr double min_arc_scale = 0.6;

double segment_distance(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::distance(p, a + t * along);
}

/// Signed distance from a counter-clockwise convex polygon: negative inside; outside, a lower bound of the distance.
template <std::size_t count>
double polygon_distance(const glm::dvec2& p, const std::array<glm::dvec2, count>& corners) {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < count; ++k) {
        const glm::dvec2 edge = glm::normalize(corners[(k + 1) % count] - corners[k]);
        most = std::fmax(most, glm::dot(p - corners[k], glm::dvec2(edge.y, -edge.x)));
    }
    return most;
}

/// A triangle whose tip is at `tip`, in the direction `ahead`.
double head_distance(const glm::dvec2& p, const glm::dvec2& tip, const glm::dvec2& ahead, double length) {
    const glm::dvec2 across(-ahead.y, ahead.x);
    const glm::dvec2 back = tip - ahead * length;
    return polygon_distance(
        p, std::array{tip, back + across * (0.75 * length), back - across * (0.75 * length)});
}

double arrow_distance(const glm::dvec2& p, const glm::dvec2& from, const glm::dvec2& to, double half_width,
                      double head) {
    const glm::dvec2 ahead = glm::normalize(to - from);
    return std::fmin(segment_distance(p, from, to - ahead * (0.8 * head)) - half_width,
                     head_distance(p, to, ahead, head));
}

/// The outline of an upright prop seen from the side, with the middle of its bottom at `foot`, turned
/// counter-clockwise.
double prop_distance(const glm::dvec2& p, const glm::dvec2& foot, double angle) {
    const glm::dvec2 from = p - foot;
    const glm::dvec2 own(std::cos(angle) * from.x + std::sin(angle) * from.y,
                         -std::sin(angle) * from.x + std::cos(angle) * from.y);
    const double outside =
        polygon_distance(own, std::array{glm::dvec2(-0.018, 0.0), glm::dvec2(0.018, 0.0),
                                         glm::dvec2(0.007, 0.022), glm::dvec2(-0.007, 0.022)});
    return std::abs(outside) - 0.0014;
}

double table_distance(const glm::dvec2& p) {
    return segment_distance(p, {-0.03, -0.028}, {0.03, -0.028}) - 0.0014;
}

double sign_distance(Sign sign, const glm::dvec2& p) {
    constexpr double thin = 0.0026;
    constexpr double head = 0.011;
    switch (sign) {
    case Sign::Arrow:
        return arrow_distance(p, {-0.036, 0.0}, {0.039, 0.0}, 0.0062, 0.028);
    case Sign::Turn: {
        const double angle = std::atan2(p.x, -p.y); // 0 below the centre, increasing to the right
        const double end = arc_half_angle;
        const double inside = std::clamp(angle, -end, end);
        const glm::dvec2 nearest(arc_radius_m * std::sin(inside), -arc_radius_m * std::cos(inside));
        const glm::dvec2 ahead(std::cos(end), std::sin(end));
        const glm::dvec2 tip = arc_radius_m * glm::dvec2(std::sin(end), -std::cos(end)) + ahead * arc_head_m;
        return std::fmin(glm::distance(p, nearest) - arc_half_width_m,
                         head_distance(p, tip, ahead, 1.5 * arc_head_m));
    }
    case Sign::Stand:
        // A lying prop, a curved arrow upwards, and the table.
        return std::fmin(std::fmin(prop_distance(p, {-0.002, -0.012}, -1.15), table_distance(p)),
                         arrow_distance(p, {0.024, 0.016}, {-0.006, 0.024}, thin, head));
    case Sign::Raise:
        return std::fmin(std::fmin(prop_distance(p, {-0.008, -0.012}, 0.0), table_distance(p)),
                         arrow_distance(p, {0.021, -0.014}, {0.021, 0.02}, thin, head));
    case Sign::Lower:
        break;
    }
    return std::fmin(std::fmin(prop_distance(p, {-0.008, 0.0}, 0.0), table_distance(p)),
                     arrow_distance(p, {0.021, 0.022}, {0.021, -0.016}, thin, head));
}

/// The rectangle of a sign's picture, in the sign's own coordinates.
struct SignBox {
    glm::dvec2 low;
    glm::dvec2 high;
};
SignBox box_of(Sign sign) {
    switch (sign) {
    case Sign::Arrow:
        return {-0.5 * arrow_size_m, 0.5 * arrow_size_m};
    case Sign::Turn:
        return {{-arc_half_m, arc_low_m}, {arc_half_m, arc_high_m}};
    default:
        return {-0.5 * icon_size_m, 0.5 * icon_size_m};
    }
}

/// The place of a sign's picture: its own coordinates turned, scaled, mirrored and moved.
struct SignPose {
    glm::dvec2 origin_m{0.0};
    double angle = 0.0;
    double scale = 1.0;
    bool mirrored = false; ///< left and right are exchanged first
};
std::array<glm::dvec2, 4> corners_of(Sign sign, const SignPose& pose) {
    const SignBox box = box_of(sign);
    const auto at = [&](double x, double y) {
        const glm::dvec2 own = pose.scale * glm::dvec2(pose.mirrored ? -x : x, y);
        return pose.origin_m + glm::dvec2(std::cos(pose.angle) * own.x - std::sin(pose.angle) * own.y,
                                          std::sin(pose.angle) * own.x + std::cos(pose.angle) * own.y);
    };
    return {at(box.low.x, box.high.y), at(box.high.x, box.high.y), at(box.high.x, box.low.y),
            at(box.low.x, box.low.y)};
}

/// The reach of a convex polygon from a point in a direction.
double reach(std::span<const glm::dvec2> polygon, const glm::dvec2& from, const glm::dvec2& ahead) {
    double farthest = 0.0;
    for (const glm::dvec2& corner : polygon) {
        farthest = std::fmax(farthest, glm::dot(corner - from, ahead));
    }
    return farthest;
}

/// Moves the sign into the picture, with a margin to its edges.
void pull_inside(std::span<const glm::dvec2> area, Sign sign, SignPose& pose) {
    for (int round = 0; round < 4; ++round) {
        for (std::size_t k = 0; k < area.size(); ++k) {
            const glm::dvec2 edge = glm::normalize(area[(k + 1) % area.size()] - area[k]);
            const glm::dvec2 inward(-edge.y, edge.x);
            double least = std::numeric_limits<double>::infinity();
            for (const glm::dvec2& corner : corners_of(sign, pose)) {
                least = std::fmin(least, glm::dot(corner - area[k], inward));
            }
            pose.origin_m += inward * std::fmax(0.0, border_m - least);
        }
    }
}

/// Moves the arrow so that all of its way is inside the picture, then moves it along the way.
void glide_inside(std::span<const glm::dvec2> area, const glm::dvec2& ahead, double phase, SignPose& pose) {
    pose.origin_m += ahead * glide_m;
    pull_inside(area, Sign::Arrow, pose);
    pose.origin_m -= ahead * glide_m;
    pull_inside(area, Sign::Arrow, pose);
    pose.origin_m += ahead * (glide_m * phase);
}

bool clear_of(const typography::TablePolygon& shadow, const std::array<glm::dvec2, 4>& corners) {
    std::array<glm::dvec2, 4> ordered = corners;
    const glm::dvec2 a = corners[1] - corners[0];
    const glm::dvec2 b = corners[2] - corners[1];
    if (a.x * b.y - a.y * b.x < 0.0) {
        std::reverse(ordered.begin(), ordered.end());
    }
    return typography::clearance(ordered, shadow.corners()) > 0.0;
}

/// The place of an arrow: in front of the prop, or farther along the way if there is space; otherwise beside the prop.
std::optional<SignPose> place_arrow(const glm::dvec2& prop, const glm::dvec2& ahead, double phase,
                                    const typography::TablePolygon& shadow,
                                    std::span<const glm::dvec2> area) {
    const glm::dvec2 aside(-ahead.y, ahead.x);
    const double angle = std::atan2(ahead.y, ahead.x);
    const double half = 0.5 * arrow_size_m.x;
    const double front = reach(shadow.corners(), prop, ahead) + gap_m + half;
    const double left = reach(shadow.corners(), prop, aside) + gap_m + 0.5 * arrow_size_m.y;
    const double right = reach(shadow.corners(), prop, -aside) + gap_m + 0.5 * arrow_size_m.y;
    for (const glm::dvec2& place : {prop + ahead * front, prop + aside * left, prop - aside * right}) {
        SignPose pose{place, angle};
        glide_inside(area, ahead, phase, pose);
        if (clear_of(shadow, corners_of(Sign::Arrow, pose))) {
            return pose;
        }
    }
    return std::nullopt;
}

/// True if the corners keep the margin to the picture's edges.
bool inside(std::span<const glm::dvec2> area, const std::array<glm::dvec2, 4>& corners) {
    for (std::size_t k = 0; k < area.size(); ++k) {
        const glm::dvec2 edge = glm::normalize(area[(k + 1) % area.size()] - area[k]);
        for (const glm::dvec2& corner : corners) {
            if (glm::dot(corner - area[k], glm::dvec2(-edge.y, edge.x)) < border_m) {
                return false;
            }
        }
    }
    return true;
}

/// An arc on one side of the prop, at one moment of its swing of -1 to 1: around the prop if it is large enough for the
/// shadow there, otherwise beside the shadow.
SignPose arc_at(const glm::dvec2& prop, bool counter_clockwise, double angle, double scale, double swing,
                const typography::TablePolygon& shadow) {
    const glm::dvec2 ahead(std::sin(angle), -std::cos(angle));
    const double beside_m = reach(shadow.corners(), prop, ahead) + gap_m + scale * arc_high_m;
    const double turned = (counter_clockwise ? 0.5 : -0.5) * swing_rad * swing;
    const glm::dvec2 turned_ahead(std::sin(angle + turned), -std::cos(angle + turned));
    return {.origin_m = prop + turned_ahead * std::fmax(0.0, beside_m),
            .angle = angle + turned,
            .scale = scale,
            .mirrored = !counter_clockwise};
}

/// The place of an arc around the shadow, on the reader's side if there is space; a smaller one has more places. It has
/// space for its whole swing.
std::optional<SignPose> place_arc(const glm::dvec2& prop, bool counter_clockwise, double phase,
                                  const typography::TablePolygon& shadow, std::span<const glm::dvec2> area,
                                  double readers_angle) {
    double radius = 0.0;
    for (const glm::dvec2& corner : shadow.corners()) {
        radius = std::fmax(radius, glm::distance(corner, prop));
    }
    const double around = (radius + gap_m) / -arc_high_m;
    for (const double scale : {around, std::fmin(around, usual_arc_scale), min_arc_scale}) {
        for (const int sixths : {0, 1, -1, 2, -2, 3, -3, 4, -4, 5, -5, 6}) {
            const double angle = readers_angle + pi / 6.0 * sixths;
            const auto has_space = [&](double swing) {
                const auto corners =
                    corners_of(Sign::Turn, arc_at(prop, counter_clockwise, angle, scale, swing, shadow));
                return inside(area, corners) && clear_of(shadow, corners);
            };
            if (has_space(0.0) && has_space(-1.0) && has_space(1.0)) {
                return arc_at(prop, counter_clockwise, angle, scale, 2.0 * phase - 1.0, shadow);
            }
        }
    }
    return std::nullopt;
}

/// The place of an icon: beside the prop; with a way, where the prop should stand.
std::optional<SignPose> place_icon(Sign sign, const glm::dvec2& prop, const glm::dvec2& way,
                                   const typography::TablePolygon& shadow, std::span<const glm::dvec2> area,
                                   double readers_angle) {
    if (way != glm::dvec2(0.0)) {
        SignPose pose{prop + way, readers_angle};
        pull_inside(area, sign, pose);
        if (clear_of(shadow, corners_of(sign, pose))) {
            return pose;
        }
    }
    for (const double side : {0.0, 0.5 * pi, -0.5 * pi, pi}) {
        const glm::dvec2 ahead(std::sin(readers_angle + side), -std::cos(readers_angle + side));
        const double away = reach(shadow.corners(), prop, ahead) + gap_m + 0.5 * glm::length(icon_size_m);
        SignPose pose{prop + ahead * away, readers_angle};
        pull_inside(area, sign, pose);
        if (clear_of(shadow, corners_of(sign, pose))) {
            return pose;
        }
    }
    return std::nullopt;
}

Sign sign_of(guidance::Action action) {
    switch (action) {
    case guidance::Action::Turn:
        return Sign::Turn;
    case guidance::Action::Upright:
        return Sign::Stand;
    case guidance::Action::SetDown:
    case guidance::Action::Lower:
        return Sign::Lower;
    case guidance::Action::Raise:
        return Sign::Raise;
    default:
        return Sign::Arrow;
    }
}

/// The direction in which a visitor walks along the table's edge to the requested side, the shorter way.
glm::dvec2 way_round(const guidance::Guidance& guidance) {
    const glm::dvec2 eye(guidance.tracked_state.eye_m);
    const double there = 0.5 * pi * (static_cast<double>(guidance.move.side) - 1.0);
    const glm::dvec2 counter_clockwise = glm::normalize(glm::dvec2(-eye.y, eye.x));
    const bool to_the_right = eye.x * std::sin(there) - eye.y * std::cos(there) >= 0.0;
    return to_the_right ? counter_clockwise : -counter_clockwise;
}

} // namespace

image::Image<std::uint8_t> sign_picture(Sign sign, double texels_per_m) {
    const SignBox box = box_of(sign);
    const glm::dvec2 size = (box.high - box.low) * texels_per_m;
    image::Image<std::uint8_t> picture(std::max(1, static_cast<int>(std::lround(size.x))),
                                       std::max(1, static_cast<int>(std::lround(size.y))));
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const glm::dvec2 share((x + 0.5) / picture.width, 1.0 - (y + 0.5) / picture.height);
            const double outside_texels =
                texels_per_m * sign_distance(sign, glm::mix(box.low, box.high, share));
            const double coverage = std::clamp(0.5 - outside_texels, 0.0, 1.0);
            picture.at(x, y) = static_cast<std::uint8_t>(std::lround(255.0 * coverage));
        }
    }
    return picture;
}

std::optional<PlacedSign> place_sign(const guidance::Guidance& guidance, MonotonicTime now,
                                     const typography::TablePolygon& shadow, std::span<const glm::dvec2> area,
                                     int quarter_turns) {
    const guidance::Move& move = guidance.move;
    if (guidance.stage == guidance::GuidanceStage::Quiet || move.action == guidance::Action::Wait ||
        area.empty()) {
        return std::nullopt;
    }
    const double since_s = to_seconds(now - guidance.since);
    const double phase = 0.5 - 0.5 * std::cos(2.0 * pi * since_s / period_s);
    const Sign sign = sign_of(move.action);
    const glm::dvec2 prop(guidance.tracked_state.table_from_prop.translation);
    const double readers_angle = 0.5 * pi * quarter_turns;
    std::optional<SignPose> pose;
    if (move.action == guidance::Action::ComeRound) {
        const glm::dvec2 ahead = way_round(guidance);
        pose = SignPose{glm::dvec2(guidance.tracked_state.eye_m), std::atan2(ahead.y, ahead.x)};
        glide_inside(area, ahead, phase, *pose);
        if (!clear_of(shadow, corners_of(sign, *pose))) {
            pose.reset();
        }
    } else if (sign == Sign::Arrow) {
        pose = place_arrow(prop, glm::normalize(glm::dvec2(move.by_m)), phase, shadow, area);
    } else if (sign == Sign::Turn) {
        pose = place_arc(prop, move.turn_rad > 0.0, phase, shadow, area, readers_angle);
    } else {
        pose = place_icon(sign, prop, glm::dvec2(move.by_m), shadow, area, readers_angle);
    }
    if (!pose) {
        return std::nullopt;
    }
    return PlacedSign{sign, corners_of(sign, *pose), geometry::ease(geometry::ramp(since_s, fade_s))};
}

} // namespace frustumscreen::exhibit

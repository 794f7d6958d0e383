#include "app/calibration/procedure/sight_plan.h"

#include "app/geometry/table_plane.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::calibration {

namespace {

/// Distances from the corner to the cross, along the table. Nearer crosses make the line too steep for a
/// person. At farther ones a tremor of 1 mm at the corner moves the line less at the eye.
constexpr std::array distances_m{0.12, 0.15, 0.18, 0.21, 0.24};
constexpr double widest_rad = 0.7; ///< to both sides of the direction from the head to the corner
constexpr int steps = 4;           ///< on each side
/// Least distance between two crosses.
constexpr double apart_m = 0.035;
/// A line of sight starts this much nearer to the prop when it is tested.
constexpr double free_m = 0.02;
/// Margin to the picture's edge and to the words.
constexpr double margin_share = 0.012; ///< of the picture's width
/// Limits of a plausible head: its distance from the prop along the table, and its height.
constexpr double nearest_head_m = 0.15, farthest_head_m = 1.5, lowest_head_m = 0.1, highest_head_m = 1.2;
/// Tolerance for comparing costs, so that rounding decides nothing.
constexpr double same_m = 1e-6;

glm::dvec3 flat(const glm::dvec3& way) {
    return {way.x, way.y, 0.0};
}

struct Planner {
    const SightScene& scene;
    geometry::RigidTransform table_from_prop;
    geometry::RigidTransform prop_from_table;
    glm::dvec3 head_m;
    WordsBox words;

    /// True if `from` lies outside the prop and the prop does not block the line to `to`, which may lie on
    /// it.
    [[nodiscard]] bool is_free(const glm::dvec3& from, const glm::dvec3& to) const {
        constexpr double nearly = 0.98;
        const glm::dvec3 origin = prop_from_table.point(from);
        const bool is_outside =
            std::any_of(scene.prop.bounds.begin(), scene.prop.bounds.end(),
                        [&](const geometry::Plane& bound) { return bound.distance(origin) > 1e-6; });
        geometry::PropHit hit;
        return is_outside &&
               (!geometry::enter(scene.prop, origin, prop_from_table.direction(to - from), hit) ||
                hit.t < 0.0 || hit.t > nearly);
    }

    [[nodiscard]] bool is_shown(const glm::dvec3& point) const {
        const std::optional<glm::dvec2> pixel = pixel_of(scene, point);
        const double margin = margin_share * scene.pinhole.width;
        const glm::dvec2 size(scene.pinhole.width, scene.pinhole.height);
        return pixel && glm::all(glm::greaterThan(*pixel, glm::dvec2(margin))) &&
               glm::all(glm::lessThan(*pixel, size - margin)) &&
               !(glm::all(glm::greaterThan(*pixel, words.low - margin)) &&
                 glm::all(glm::lessThan(*pixel, words.high + margin)));
    }

    [[nodiscard]] bool is_lit(const glm::dvec3& on_table) const {
        return is_shown(on_table) && is_free(scene.table_from_projector.translation, on_table);
    }

    [[nodiscard]] bool is_good(const SightCross& sight) const {
        const glm::dvec3 towards = glm::normalize(flat(sight.tip_m - sight.cross_m));
        const glm::dvec3 eye = sight.tip_m + 3.0 * (sight.tip_m - sight.cross_m);
        const std::array<glm::dvec3, 5> of_cross{
            glm::dvec3(0.0), glm::dvec3(cross_arm_m, 0.0, 0.0), glm::dvec3(-cross_arm_m, 0.0, 0.0),
            glm::dvec3(0.0, cross_arm_m, 0.0), glm::dvec3(0.0, -cross_arm_m, 0.0)};
        return std::all_of(of_cross.begin(), of_cross.end(),
                           [&](const glm::dvec3& part) { return is_lit(sight.cross_m + part); }) &&
               is_free(sight.cross_m + free_m * towards, sight.tip_m) && is_free(eye, sight.tip_m);
    }

    /// Distance of the head from the line of sight.
    [[nodiscard]] double cost(const SightCross& sight) const {
        const glm::dvec3 along = glm::normalize(sight.tip_m - sight.cross_m);
        const glm::dvec3 way = head_m - sight.tip_m;
        return glm::length(way - std::fmax(0.0, glm::dot(way, along)) * along);
    }

    [[nodiscard]] std::vector<SightCross> good_ones() const {
        std::vector<SightCross> good;
        for (const glm::dvec3& tip : upper_corners()) {
            const glm::dvec3 way = flat(tip - head_m);
            const double ahead = std::atan2(way.y, way.x);
            for (int step = -steps; step <= steps; ++step) {
                const double angle = ahead + widest_rad * step / steps;
                for (const double distance : distances_m) {
                    const glm::dvec3 cross(tip.x + distance * std::cos(angle),
                                           tip.y + distance * std::sin(angle), 0.0);
                    const std::optional<glm::dvec2> pixel = pixel_of(scene, cross);
                    const SightCross sight{tip, cross, pixel.value_or(glm::dvec2(0.0))};
                    if (pixel && is_good(sight)) {
                        good.push_back(sight);
                    }
                }
            }
        }
        return good;
    }

    /// The upper corners that are in the picture.
    [[nodiscard]] std::vector<glm::dvec3> upper_corners() const {
        std::vector<glm::dvec3> upper;
        double highest = 0.0;
        for (const glm::dvec3& corner : scene.prop.corners) {
            highest = std::fmax(highest, table_from_prop.point(corner).z);
        }
        for (const glm::dvec3& corner : scene.prop.corners) {
            const glm::dvec3 place = table_from_prop.point(corner);
            if (place.z > 0.9 * highest && is_shown(place)) {
                upper.push_back(place);
            }
        }
        return upper;
    }

    [[nodiscard]] std::vector<SightCross> chosen(std::size_t count) const {
        const std::vector<SightCross> good = good_ones();
        std::vector<SightCross> crosses;
        while (crosses.size() < count) {
            const SightCross* best = nullptr;
            for (const SightCross& each : good) {
                const bool is_new = std::all_of(crosses.begin(), crosses.end(), [&](const SightCross& other) {
                    return glm::distance(other.cross_m, each.cross_m) >= apart_m;
                });
                if (is_new && (best == nullptr || cost(each) < cost(*best) - same_m)) {
                    best = &each;
                }
            }
            if (best == nullptr) {
                break;
            }
            crosses.push_back(*best);
        }
        return crosses;
    }
};

WordsBox box_of_prop(const SightScene& scene, const geometry::RigidTransform& table_from_prop) {
    const glm::dvec2 size(scene.pinhole.width, scene.pinhole.height);
    WordsBox box{size, glm::dvec2(0.0)};
    for (const glm::dvec3& corner : scene.prop.corners) {
        const glm::dvec2 pixel = pixel_of(scene, table_from_prop.point(corner)).value_or(0.5 * size);
        box.low = glm::min(box.low, glm::clamp(pixel, glm::dvec2(0.0), size));
        box.high = glm::max(box.high, glm::clamp(pixel, glm::dvec2(0.0), size));
    }
    return box;
}

/// The largest space for words to the left or right of the prop, or on the head's side; not behind it, where
/// the crosses are.
WordsBox words_beside(const SightScene& scene, const geometry::RigidTransform& table_from_prop,
                      const glm::dvec3& head_m) {
    const double margin = 2.0 * margin_share * scene.pinhole.width;
    const glm::dvec2 size(scene.pinhole.width, scene.pinhole.height);
    const WordsBox prop = box_of_prop(scene, table_from_prop);
    struct Side {
        glm::dvec2 direction;
        WordsBox box;
    };
    const glm::dvec2 low(margin);
    const glm::dvec2 high = size - margin;
    const std::array<Side, 4> sides{{{{-1.0, 0.0}, {low, {prop.low.x - margin, high.y}}},
                                     {{1.0, 0.0}, {{prop.high.x + margin, low.y}, high}},
                                     {{0.0, -1.0}, {low, {high.x, prop.low.y - margin}}},
                                     {{0.0, 1.0}, {{low.x, prop.high.y + margin}, high}}}};
    const glm::dvec3 middle = flat(table_from_prop.translation);
    const glm::dvec3 on = middle + 0.05 * glm::normalize(flat(middle - head_m));
    const glm::dvec2 away =
        pixel_of(scene, on).value_or(glm::dvec2(0.0)) - pixel_of(scene, middle).value_or(glm::dvec2(0.0));
    const auto behind = std::max_element(sides.begin(), sides.end(), [&](const Side& a, const Side& b) {
        return glm::dot(a.direction, away) < glm::dot(b.direction, away);
    });
    const auto room = [&](const Side& side) {
        constexpr double usual = 1.5; // of words: width over height
        return &side == &*behind ? -1.0 : std::fmin(side.box.size().x, usual * side.box.size().y);
    };
    return std::max_element(sides.begin(), sides.end(),
                            [&](const Side& a, const Side& b) { return room(a) < room(b); })
        ->box;
}

} // namespace

std::optional<glm::dvec2> pixel_of(const SightScene& scene, const glm::dvec3& point_m) {
    return scene.pinhole.pixel(scene.table_from_projector.inverse().point(point_m));
}

/// Right of the middle, so that words fit beside it, and to the front, so that crosses fit behind it.
geometry::RigidTransform first_place(const SightScene& scene) {
    constexpr glm::dvec2 share(0.63, 0.6);
    const glm::dvec2 size(scene.pinhole.width, scene.pinhole.height);
    const glm::dvec2 lit = geometry::lights_table(scene.pinhole, scene.table_from_projector, share * size)
                               .value_or(glm::dvec2(0.0));
    return {{1.0, 0.0, 0.0, 0.0}, glm::dvec3(lit, 0.0)};
}

SightPlan plan_sights(const SightScene& scene, const geometry::RigidTransform& table_from_prop,
                      const glm::dvec3& head_m, std::size_t count) {
    const double away_m = glm::length(flat(head_m - table_from_prop.translation));
    const bool is_near = away_m >= nearest_head_m && away_m <= farthest_head_m && head_m.z >= lowest_head_m &&
                         head_m.z <= highest_head_m;
    Planner planner{.scene = scene,
                    .table_from_prop = table_from_prop,
                    .prop_from_table = table_from_prop.inverse(),
                    .head_m = is_near ? head_m : scene.usual_eye_m,
                    .words = {}};
    planner.words = words_beside(scene, table_from_prop, planner.head_m);
    return {planner.words, planner.chosen(count)};
}

} // namespace frustumscreen::calibration

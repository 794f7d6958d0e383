#include "app/room/taking.h"

#include "app/geometry/time_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace frustumscreen::room {

namespace {

/// A follower this near to its goal has reached it. The moved object is off by the square of that, less than a nanometre.
constexpr double reached = 1e-6;
constexpr double arch = 0.25; ///< height of the way's control point, as a share of the way

world::SpringLaw law_of(double rate_per_s) {
    return {rate_per_s * rate_per_s, 2.0 * rate_per_s};
}

/// Share of the way from the place to the prop.
double flown(double way) {
    return geometry::ease(way / Taking::hands_over);
}
/// Share of the light that is in the prop.
double handed_over(double way) {
    return geometry::ease((way - Taking::hands_over) / (1.0 - Taking::hands_over));
}

/// A parabola that begins to rise at once.
glm::dvec3 on_way(const glm::dvec3& from, const glm::dvec3& to, double share) {
    const glm::dvec3 over = glm::mix(from, to, 0.5) + glm::dvec3(0.0, 0.0, arch * glm::distance(from, to));
    return glm::mix(glm::mix(from, over, share), glm::mix(over, to, share), share);
}

} // namespace

TakenPose pose_of(std::size_t index, const Object& object, double seconds, std::span<const TakenPose> taken) {
    const auto at = std::lower_bound(taken.begin(), taken.end(), index,
                                     [](const TakenPose& pose, std::size_t k) { return pose.object < k; });
    return at != taken.end() && at->object == index
               ? *at
               : TakenPose{index, table_from_object(object, seconds), object.size_m, 1.0};
}

double Taking::Follower::at(MonotonicTime now, double rate_per_s) const {
    const double off = world::motion_after(law_of(rate_per_s), from_goal, to_seconds(now - event)).x;
    return std::abs(off) < reached ? goal : std::clamp(goal + off, 0.0, 1.0);
}

void Taking::Follower::turn_to(double new_goal, MonotonicTime now, double rate_per_s) {
    if (new_goal != goal) {
        from_goal = world::motion_after(law_of(rate_per_s), from_goal, to_seconds(now - event));
        from_goal.x += goal - new_goal;
        goal = new_goal;
        event = now;
    }
}

bool Taking::Follower::moves(MonotonicTime now, double rate_per_s) const {
    return at(now, rate_per_s) != goal;
}

Taking::Taking(std::vector<Object> objects, MonotonicTime start)
    : objects_(std::move(objects)), start_(start) {}

void Taking::set_takeable(std::span<const TakeableObject> takeable) {
    std::vector<Body> bodies;
    std::optional<std::size_t> chosen;
    const auto keep = [&](std::size_t old) {
        if (chosen_ == old) {
            chosen = bodies.size();
        }
        return bodies_[old];
    };
    std::size_t old = 0;
    for (const TakeableObject& as : takeable) {
        for (; old < bodies_.size() && bodies_[old].as.object < as.object; ++old) {
            bodies.push_back(keep(old));
            bodies.back().takeable = false;
        }
        const bool known = old < bodies_.size() && bodies_[old].as.object == as.object;
        bodies.push_back(known ? keep(old++) : Body{});
        bodies.back().as = as;
        bodies.back().takeable = true;
    }
    for (; old < bodies_.size(); ++old) {
        bodies.push_back(keep(old));
        bodies.back().takeable = false;
    }
    bodies_ = std::move(bodies);
    chosen_ = chosen;
    poses_.clear();
    poses_.reserve(bodies_.size());
}

/// The body that the chosen artifact comes from: one that is on its way, else the one that the prop rests before, else the
/// nearest to the prop.
std::optional<std::size_t> Taking::body_for(const TakingInput& input) const {
    std::optional<std::size_t> best;
    double best_m = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
        const Body& body = bodies_[k];
        if (!body.takeable || body.as.artifact != input.chosen) {
            continue;
        }
        const double way = body.way.at(input.now, rate_per_s);
        const glm::dvec3 place = table_from_object(objects_[body.as.object], seconds(input.now)).translation;
        double away_m = glm::distance(place, input.table_from_prop.translation);
        away_m = way > 0.0 ? -2.0 - way : body.as.object == input.before ? -1.0 : away_m;
        if (away_m < best_m) {
            best = k;
            best_m = away_m;
        }
    }
    return best;
}

/// An artifact that leaves the prop for another stays there until the prop's picture of it is dark.
bool Taking::belongs_in_prop(const Body& body, std::size_t index, const TakingInput& input) const {
    if (!input.chosen || !body.takeable) {
        return false;
    }
    return chosen_ == index || (body.as.artifact == input.shown && input.shown_light > 0.0 &&
                                handed_over(body.way.at(input.now, rate_per_s)) > 0.0);
}

/// Fixes the rotations between which the body turns on its way. Called only while the body is in its place or in the
/// prop, so that its pose does not jump.
void Taking::anchor(Body& body, MonotonicTime now) const {
    body.anchor_s = seconds(now);
    body.goal = same_side(table_from_prop_.pose().rotation,
                          table_from_object(objects_[body.as.object], body.anchor_s).rotation);
}

void Taking::step(const TakingInput& input) {
    table_from_prop_.step(input.now, input.table_from_prop, input.idle);
    if (!chosen_ || bodies_[*chosen_].as.artifact != input.chosen || !bodies_[*chosen_].takeable) {
        chosen_ = input.chosen ? body_for(input) : std::nullopt;
    }
    poses_.clear();
    prop_share_ = 1.0;
    moves_ = false;
    bool stands_in_room = false;
    double in_prop = 0.0;
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
        Body& body = bodies_[k];
        const double goal = belongs_in_prop(body, k, input) ? 1.0 : 0.0;
        const double before = body.way.at(input.now, rate_per_s);
        if (goal != body.way.goal && (before <= 0.0 || before >= hands_over)) {
            anchor(body, input.now);
        }
        body.way.turn_to(goal, input.now, rate_per_s);
        body.lean.turn_to(input.before == body.as.object ? 1.0 : 0.0, input.now, lean_per_s);
        const bool shown = body.takeable && body.as.artifact == input.shown;
        stands_in_room = stands_in_room || shown;
        in_prop = shown ? std::fmax(in_prop, handed_over(body.way.at(input.now, rate_per_s))) : in_prop;
        put(body, input, shown ? input.shown_light : 0.0);
    }
    prop_share_ = stands_in_room ? in_prop : 1.0;
}

void Taking::put(Body& body, const TakingInput& input, double lit) {
    const double way = body.way.at(input.now, rate_per_s);
    const double lean = geometry::ease(body.lean.at(input.now, lean_per_s));
    moves_ = moves_ || body.way.moves(input.now, rate_per_s) || body.lean.moves(input.now, lean_per_s);
    if (way <= 0.0 && lean <= 0.0) {
        return;
    }
    const Object& object = objects_[body.as.object];
    const double share = flown(way);
    const glm::dvec3 place = table_from_object(object, seconds(input.now)).translation;
    const glm::dquat anchored = table_from_object(object, body.anchor_s).rotation;
    const double turned =
        2.0 * std::numbers::pi * object.motion.turns_per_minute / 60.0 * (seconds(input.now) - body.anchor_s);
    body.goal = same_side(table_from_prop_.pose().rotation, body.goal);
    TakenPose pose;
    pose.object = body.as.object;
    pose.table_from_object.rotation = turned_between(anchored, body.goal, share) *
                                      glm::angleAxis((1.0 - share) * turned, glm::dvec3(0.0, 0.0, 1.0));
    pose.table_from_object.translation = on_way(place, table_from_prop_.pose().translation, share);
    const double leans = lean * (1.0 - share);
    pose.table_from_object.translation.z += leans * lean_height * object.size_m;
    pose.size_m = (1.0 + leans * lean_size) * object.size_m * std::pow(body.as.size_m / object.size_m, share);
    pose.opacity = 1.0 - lit * handed_over(way);
    poses_.push_back(pose);
}

} // namespace frustumscreen::room

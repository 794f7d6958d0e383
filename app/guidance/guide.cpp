#include "app/guidance/guide.h"

#include "app/geometry/rotation_angle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace frustumscreen::guidance {

namespace {

constexpr double metres_per_radian = 0.15; ///< a slide that takes about as long as a turn of one radian

/// The effort left, in metres.
double effort_left(const Move& move) {
    switch (move.action) {
    case Action::Slide:
    case Action::Raise:
    case Action::Lower:
        return glm::length(move.by_m);
    case Action::Turn:
        return std::abs(move.turn_rad) * metres_per_radian;
    default:
        return 0.0;
    }
}

/// True if the situation has changed enough for another advice or another amount.
bool has_moved(const GuidedState& now, const GuidedState& then) {
    constexpr double moved_m = 0.004;
    constexpr double turned_rad = 0.03;
    constexpr double looked_around_m = 0.02;
    const geometry::RigidTransform& a = now.table_from_prop;
    const geometry::RigidTransform& b = then.table_from_prop;
    return glm::distance(a.translation, b.translation) > moved_m ||
           geometry::rotation_angle(a.rotation, b.rotation) > turned_rad ||
           glm::distance(now.eye_m, then.eye_m) > looked_around_m ||
           glm::distance(now.to_right_eye_m, then.to_right_eye_m) > looked_around_m;
}

} // namespace

void Guide::take(MonotonicTime now, const GuidedState& tracked_state, Sensing sensing) {
    const Move before = guidance_.move;
    const bool was_sensing = guidance_.sensing == sensing;
    guidance_.sensing = sensing;
    guidance_.tracked_state = tracked_state;
    guidance_.move = {};
    guidance_.steps = 0;
    if (sensing == Sensing::Good) {
        const std::optional<Advice>& advice = advisor_.found();
        guidance_.move = advice ? advice->move : Move{Action::Upright};
        guidance_.steps = advice ? advice->steps : 1;
    }
    guidance_.left_light = sensing == Sensing::PropLost && !advisor_.reader().setup().in_hand &&
                           !advisor_.reader().whole(tracked_state);
    const double left = effort_left(guidance_.move);
    if (guidance_.stage == GuidanceStage::Quiet || !was_sensing || !alike(before, guidance_.move)) {
        // A different advice begins as a picture, whatever the stage of the previous one.
        guidance_.stage = GuidanceStage::Picture;
        guidance_.since = now;
        stage_since_ = now;
        nearest_effort_ = left;
        return;
    }
    constexpr double nearer_m = 0.01;
    if (left < nearest_effort_ - nearer_m) {
        nearest_effort_ = left;
        stage_since_ = now; // the visitor follows the advice
    }
}

void Guide::raise_stage(MonotonicTime now, bool may_speak) {
    if (guidance_.stage == GuidanceStage::Picture && now - stage_since_ >= until_text) {
        guidance_.stage = GuidanceStage::Text;
        stage_since_ = now;
    }
    if (!may_speak) {
        return;
    }
    const bool first = guidance_.stage == GuidanceStage::Text && now - stage_since_ >= until_voice;
    const bool again = guidance_.stage == GuidanceStage::Voice && now - stage_since_ >= pause_;
    if ((first || again) && (!spoken_ || now - *spoken_ >= pause_)) {
        pause_ = spoken_ ? std::min(2 * pause_, longest_pause) : pause_;
        guidance_.stage = GuidanceStage::Voice;
        guidance_.speak = true;
        spoken_ = now;
        stage_since_ = now;
    }
}

void Guide::be_quiet(MonotonicTime now) {
    guidance_ = {};
    asked_ = false;
    needed_for_ = Nanoseconds(0);
    next_look_.reset();
    looks_at_.reset();
    // After a long success, reset the repeat interval.
    if (spoken_ && now - *spoken_ > longest_pause) {
        spoken_.reset();
        pause_ = first_pause;
    }
}

/// Gives the answer in all forms. A sentence that is being spoken is not repeated.
void Guide::answer(MonotonicTime now, bool may_speak) {
    asked_ = false;
    guidance_.stage = GuidanceStage::Voice;
    guidance_.speak = may_speak;
    stage_since_ = now;
    spoken_ = may_speak ? now : spoken_;
}

/// Prevents a trembling hand at the border of the light from making the sign blink: while the picture is whole, need
/// decreases twice as fast as it grew.
void Guide::note_need(MonotonicTime now, bool needed) {
    const Nanoseconds gone = last_ ? now - *last_ : Nanoseconds(0);
    last_ = now;
    needed_for_ = std::clamp(needed_for_ + (needed ? gone : -2 * gone), Nanoseconds(0), debounce);
}

/// True while the need may still be a momentary one.
bool Guide::waits(MonotonicTime now) const {
    const bool again = guided_ && now - *guided_ < again_within;
    return guidance_.stage == GuidanceStage::Quiet && !asked_ &&
           needed_for_ < (again ? debounce_again : debounce);
}

void Guide::show(std::span<const glm::dvec3> hull) {
    const std::span<const glm::dvec3> before = advisor_.reader().shown();
    if (hull.data() != before.data() || hull.size() != before.size()) {
        advisor_.show(hull);
        looks_at_.reset();
        next_look_.reset();
    }
}

const Guidance& Guide::step(MonotonicTime now, const GuidedState& tracked_state, Sensing sensing,
                            bool may_speak) {
    guidance_.speak = false;
    const bool lost = sensing == Sensing::PropLost || sensing == Sensing::TrackerAway;
    faces_ = advisor_.reader().read(tracked_state);
    const bool dark = !lost && !advisor_.reader().shows_whole(tracked_state, faces_);
    sensing = dark ? Sensing::Good : sensing;
    const bool needed = dark || sensing != Sensing::Good;
    note_need(now, needed);
    if (!needed) {
        if (needed_for_ <= Nanoseconds(0)) {
            be_quiet(now);
        }
        return guidance_;
    }
    if (waits(now)) {
        return guidance_;
    }
    guided_ = now;
    look(now, tracked_state, sensing);
    if (asked_ && !looks_at_) {
        answer(now, may_speak);
    } else {
        raise_stage(now, may_speak);
    }
    return guidance_;
}

/// Searches for another advice when something has moved, a piece in each step.
void Guide::look(MonotonicTime now, const GuidedState& tracked_state, Sensing sensing) {
    if (sensing != Sensing::Good) {
        looks_at_.reset();
        if (!next_look_ || guidance_.sensing != sensing) {
            take(now, tracked_state, sensing);
            next_look_ = now + looks_every;
        }
        return;
    }
    const bool due = !next_look_ || guidance_.sensing != sensing ||
                     (now >= *next_look_ && has_moved(tracked_state, guidance_.tracked_state));
    if (!looks_at_ && due) {
        looks_at_ = tracked_state;
        advisor_.begin(tracked_state);
        next_look_ = now + looks_every;
    }
    // An examination through the artifact's hull takes longer than one of the faces, and one of two eyes twice as long.
    const int share =
        (advisor_.reader().shown().empty() ? 1 : 3) * (looks_at_ && looks_at_->has_two_eyes() ? 2 : 1);
    if (looks_at_ && advisor_.advance((asked_ ? looks_a_step_asked : looks_a_step) / share)) {
        take(now, *looks_at_, sensing);
        looks_at_.reset();
    }
}

void Guide::forget() {
    guidance_ = {};
    asked_ = false;
    needed_for_ = Nanoseconds(0);
    next_look_.reset();
    looks_at_.reset();
    spoken_.reset();
    guided_.reset();
    pause_ = first_pause;
}

namespace {

std::string_view slide_key(const Guidance& guidance) {
    constexpr double a_little_m = 0.06;
    const GuidedState& tracked_state = guidance.tracked_state;
    const glm::dvec2 ahead(tracked_state.table_from_prop.translation - tracked_state.eye_m);
    const glm::dvec2 way(guidance.move.by_m);
    const double forward = glm::dot(way, ahead);
    const double left = ahead.x * way.y - ahead.y * way.x;
    const bool little = glm::length(way) < a_little_m;
    if (std::abs(forward) >= std::abs(left)) {
        return forward > 0.0 ? (little ? "slide_farther_a_little" : "slide_farther")
                             : (little ? "slide_nearer_a_little" : "slide_nearer");
    }
    return left > 0.0 ? (little ? "slide_left_a_little" : "slide_left")
                      : (little ? "slide_right_a_little" : "slide_right");
}

std::string_view turn_key(const Guidance& guidance) {
    constexpr double a_little_rad = 20.0 * std::numbers::pi / 180.0;
    const bool little = std::abs(guidance.move.turn_rad) < a_little_rad;
    return guidance.move.turn_rad > 0.0
               ? (little ? "turn_counter_clockwise_a_little" : "turn_counter_clockwise")
               : (little ? "turn_clockwise_a_little" : "turn_clockwise");
}

/// The key for the shorter way round the table, from where the visitor stands.
std::string_view walk_key(const Guidance& guidance) {
    if (guidance.move.side == Side::Front) {
        return "come_to_front";
    }
    const glm::dvec3& eye = guidance.tracked_state.eye_m;
    const double now = std::atan2(eye.y, eye.x);
    const double there = 0.5 * std::numbers::pi * (static_cast<double>(guidance.move.side) - 1.0);
    return std::sin(there - now) >= 0.0 ? "come_round_right" : "come_round_left";
}

} // namespace

std::string_view words_key(const Guidance& guidance) {
    switch (guidance.sensing) {
    case Sensing::PropLost:
        return guidance.left_light ? "slide_back_to_light" : "uncover";
    case Sensing::TrackerAway:
        return "wait_tracker";
    case Sensing::HeadLost:
        return "show_your_head";
    case Sensing::MetalNear:
        return "away_from_metal";
    case Sensing::Good:
        break;
    }
    switch (guidance.move.action) {
    case Action::Slide:
        return slide_key(guidance);
    case Action::Turn:
        return turn_key(guidance);
    case Action::SetDown:
        return "set_down";
    case Action::Upright:
        return "stand_upright";
    case Action::ComeRound:
        return walk_key(guidance);
    case Action::Raise:
        return "raise";
    case Action::Lower:
        return "lower";
    case Action::Wait:
        break;
    }
    return "wait_tracker";
}

} // namespace frustumscreen::guidance

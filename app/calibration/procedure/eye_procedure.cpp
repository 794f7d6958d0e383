#include "app/calibration/procedure/eye_procedure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace frustumscreen::calibration {

namespace {

/// Used in turn; each differs from the one before.
constexpr std::array postures{HeadPosture::ChinUp,      HeadPosture::TurnedLeft, HeadPosture::ChinDown,
                              HeadPosture::TurnedRight, HeadPosture::ChinUp,     HeadPosture::ChinDown,
                              HeadPosture::TurnedLeft,  HeadPosture::TurnedRight};

} // namespace

EyeProcedure::EyeProcedure(SightScene scene, const geometry::Registration& registration, std::string problem)
    : Procedure(std::move(problem)), scene_(std::move(scene)), registration_(registration) {
    const SightPlan requested = plan_sights(scene_, first_place(scene_), scene_.usual_eye_m, min_crosses);
    first_words_ = requested.words;
    if (problem_.empty() && requested.crosses.size() < min_crosses) {
        problem_ = "the picture is too small for crosses behind a prop of this size";
    }
    ask(0, of_each);
}

/// Requests sightings `from` to `to` of each eye.
void EyeProcedure::ask(std::size_t from, std::size_t to) {
    for (const OpenEye eye : {OpenEye::Left, OpenEye::Right}) {
        for (std::size_t k = from; k < to; ++k) {
            asked_.push_back({eye, postures[k % postures.size()], k});
        }
    }
    sights_.resize(asked_.size());
}

void EyeProcedure::step(const Input& input) {
    static constexpr Row<EyeProcedure> rows[]{{Stage::Begin, &EyeProcedure::begin},
                                              {Stage::Rest, &EyeProcedure::take_rest},
                                              {Stage::Shut, &EyeProcedure::shut},
                                              {Stage::Place, &EyeProcedure::aim},
                                              {Stage::HoldStill, &EyeProcedure::hold_still},
                                              {Stage::Judged, &EyeProcedure::after_judgement}};
    leave_if_alone(input);
    watch(input);
    step_in_stage(*this, rows, input);
}

/// Notes what the tracker sees. If the prop moves while sightings need its rest, takes the rest again.
void EyeProcedure::watch(const Input& input) {
    if (input.head) {
        head_ = input.head;
        head_seen_ = input.now;
    }
    if (!input.prop) {
        return;
    }
    prop_seen_ = input.now;
    const bool stays = prop_still_.add(input.now, *input.prop);
    const bool is_needed = stage_ == Stage::Shut || stage_ == Stage::Place || stage_ == Stage::HoldStill;
    if (!stays && is_needed) {
        begin_rest(input.now, EyePrompt::PropMoved);
    } else if (!stays && stage_ == Stage::Rest && word_ != EyePrompt::PropMoved) {
        word_ = EyePrompt::PropMoves;
    }
}

void EyeProcedure::begin(const Input& input) {
    word_ = EyePrompt::None;
    knows_place_ = false;
    if (input.back) {
        stage_ = Stage::Left;
    } else if (input.next && problem_.empty()) {
        prop_still_.clear();
        open_.reset();
        begin_rest(input.now, EyePrompt::None);
    }
}

void EyeProcedure::begin_rest(MonotonicTime now, EyePrompt word) {
    prop_seen_ = head_seen_ = now;
    knows_place_ = knows_place_ && word == EyePrompt::PropMoved; // it is still near its old place
    go_to(Stage::Rest, word);
}

/// The sensor that the tracker does not see; None if it sees prop and head.
EyePrompt EyeProcedure::missing(MonotonicTime now) const {
    return now - prop_seen_ > timeout   ? EyePrompt::PropNotSeen
           : now - head_seen_ > timeout ? EyePrompt::HeadNotSeen
                                        : EyePrompt::None;
}

void EyeProcedure::take_rest(const Input& input) {
    if (input.back) {
        go_to(Stage::Begin);
        return;
    }
    if (const EyePrompt lost = missing(input.now); lost != EyePrompt::None) {
        word_ = lost;
        return;
    }
    if (word_ == EyePrompt::PropNotSeen || word_ == EyePrompt::HeadNotSeen) {
        word_ = EyePrompt::None;
    }
    if (prop_still_.count() >= min_reports && prop_still_.rest() >= rest && head_) {
        plan();
    }
}

/// Determines the prop's place and plans crosses behind it for the head's current place.
void EyeProcedure::plan() {
    const geometry::RigidTransform table_from_prop =
        registration_.table_from_tracker * prop_still_.mean() * registration_.sensor_from_prop;
    double lowest = table_from_prop.point(scene_.prop.corners.front()).z;
    for (const glm::dvec3& corner : scene_.prop.corners) {
        lowest = std::fmin(lowest, table_from_prop.point(corner).z);
    }
    knows_place_ = false;
    if (!(std::abs(lowest) <= off_table_m)) {
        word_ = EyePrompt::OffTable;
        return;
    }
    SightPlan next = plan_sights(scene_, table_from_prop,
                                 registration_.table_from_tracker.point(head_->translation), max_of_each);
    if (next.crosses.size() < min_crosses) {
        word_ = EyePrompt::NoRoom;
        return;
    }
    table_from_prop_ = table_from_prop;
    knows_place_ = true;
    plan_ = std::move(next);
    word_ = word_ == EyePrompt::PropMoved ? word_ : EyePrompt::None; // the remark stays to be read
    go_to_next_open();
}

void EyeProcedure::ask_for(std::size_t sight) {
    at_ = sight;
    stage_ = open_ == asked().eye ? Stage::Place : Stage::Shut;
}

void EyeProcedure::go_to_next_open() {
    const auto open = std::find(sights_.begin(), sights_.end(), std::nullopt);
    if (open == sights_.end()) {
        stage_ = Stage::Solve;
    } else {
        ask_for(static_cast<std::size_t>(open - sights_.begin()));
    }
}

void EyeProcedure::go_back() {
    word_ = EyePrompt::None;
    if (at_ == 0) {
        stage_ = Stage::Begin;
    } else {
        sights_[at_ - 1].reset();
        ask_for(at_ - 1);
    }
}

void EyeProcedure::shut(const Input& input) {
    if (input.back) {
        go_back();
    } else if (input.next) {
        open_ = asked().eye;
        go_to(Stage::Place);
    }
}

void EyeProcedure::aim(const Input& input) {
    if (input.back) {
        go_back();
    } else if (input.next) {
        head_still_.clear();
        go_to(Stage::HoldStill);
    }
}

void EyeProcedure::hold_still(const Input& input) {
    if (input.back) {
        go_to(Stage::Place);
        return;
    }
    if (input.head && !head_still_.add(input.now, *input.head)) {
        word_ = EyePrompt::HeadMoved;
    }
    if (const EyePrompt lost = missing(input.now); lost != EyePrompt::None) {
        go_to(Stage::Place, lost);
    } else if (head_still_.rest() >= rest && head_still_.count() >= min_reports) {
        take();
    }
}

/// True if the line of sight is nearly that of the previous sighting: Next was pressed again at once, or the
/// head kept its posture.
bool EyeProcedure::is_held_as_before(const glm::dvec3& in_sensor) const {
    return at_ > 0 && sights_[at_ - 1] && asked_[at_ - 1].eye == asked().eye &&
           glm::distance(sights_[at_ - 1]->in_sensor, in_sensor) < turned_rad;
}

void EyeProcedure::take() {
    const geometry::RigidTransform head = head_still_.mean();
    const glm::dquat table_from_sensor = registration_.table_from_tracker.rotation * head.rotation;
    const glm::dvec3 in_sensor =
        glm::conjugate(table_from_sensor) * glm::normalize(cross().tip_m - cross().cross_m);
    if (is_held_as_before(in_sensor)) {
        go_to(Stage::Place, EyePrompt::SameHead);
        return;
    }
    sights_[at_] = Taken{{asked().eye, head, cross().pixel, cross().tip_m}, in_sensor};
    word_ = EyePrompt::Taken;
    go_to_next_open();
}

bool EyeProcedure::asks_for_more() const {
    return judged_ && judged_->verdict == Verdict::Repeat && judged_->repeat.empty() &&
           asked_.size() < 2 * max_of_each;
}

/// Next repeats all sightings after a refusal; Back repeats one, whatever the verdict.
void EyeProcedure::after_judgement(const Input& input) {
    const EyeFit& judged = *judged_;
    if (!input.next && !input.back) {
        return;
    }
    if (input.next && (judged.verdict == Verdict::Good || judged.verdict == Verdict::Usable)) {
        stage_ = Stage::Done;
        return;
    }
    if (input.next && judged.verdict == Verdict::Refused) {
        std::fill(sights_.begin(), sights_.end(), std::nullopt);
    } else if (input.next && asks_for_more()) {
        const std::size_t so_far = asked_.size() / 2;
        ask(so_far, so_far + more);
    } else if (input.next && !judged.repeat.empty()) {
        for (const std::size_t sight : judged.repeat) {
            sights_[sight].reset();
        }
    } else {
        do_worst_again();
    }
    open_.reset(); // the person may have opened both eyes
    begin_rest(input.now, EyePrompt::None);
}

/// Repeats the sighting with the largest residual, or the last if no residual is known.
void EyeProcedure::do_worst_again() {
    const std::vector<double>& residuals = judged_->residuals_m;
    const auto worst = std::max_element(residuals.begin(), residuals.end());
    sights_[residuals.empty() ? sights_.size() - 1 : static_cast<std::size_t>(worst - residuals.begin())]
        .reset();
}

ReportedSights EyeProcedure::sights() const {
    ReportedSights all;
    for (const std::optional<Taken>& taken : sights_) {
        if (taken) {
            all.push_back(taken->sight);
        }
    }
    return all;
}

} // namespace frustumscreen::calibration

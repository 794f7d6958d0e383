#include "app/calibration/procedure/touch_procedure.h"

#include <algorithm>

namespace frustumscreen::calibration {

void TouchProcedure::step(const Input& input) {
    static constexpr Row<TouchProcedure> rows[]{{Stage::Begin, &TouchProcedure::begin},
                                                {Stage::Place, &TouchProcedure::lay},
                                                {Stage::HoldStill, &TouchProcedure::hold_still},
                                                {Stage::Judged, &TouchProcedure::after_judgement}};
    leave_if_alone(input);
    step_in_stage(*this, rows, input);
}

void TouchProcedure::begin(const Input& input) {
    word_ = TouchPrompt::None;
    if (input.back) {
        stage_ = task_ == TouchTask::TouchUp ? Stage::GoesOn : Stage::Left;
    } else if (input.next && problem_.empty()) {
        stage_ = Stage::Place;
    }
}

void TouchProcedure::lay(const Input& input) {
    if (input.back && at_ == 0) {
        stage_ = Stage::Begin;
    } else if (input.back) {
        touches_[--at_].reset();
        word_ = TouchPrompt::None;
    } else if (input.next) {
        still_.clear();
        rest_began_ = seen_ = input.now;
        go_to(Stage::HoldStill);
    }
}

void TouchProcedure::hold_still(const Input& input) {
    if (input.back) {
        go_to(Stage::Place);
        return;
    }
    if (input.prop) {
        seen_ = input.now;
        if (!still_.add(input.now, *input.prop)) {
            rest_began_ = input.now;
            word_ = TouchPrompt::Moved;
        }
    }
    if (input.now - seen_ > timeout) {
        go_to(Stage::Place, TouchPrompt::NotSeen);
    } else if (input.now - rest_began_ >= rest && still_.count() >= min_reports) {
        take();
    }
}

/// True if Next was pressed again before the prop moved on. Two crosses of a plan may be equal.
bool TouchProcedure::lies_where_another_lay(const geometry::RigidTransform& pose) const {
    for (std::size_t k = 0; k < touches_.size(); ++k) {
        const Cross& other = crosses_[k];
        const bool is_alike = other.pixel == cross().pixel && other.block_m == cross().block_m &&
                              other.yaw_rad == cross().yaw_rad;
        if (touches_[k] && !is_alike &&
            is_near(touches_[k]->tracker_from_sensor, pose, same_place_m, same_place_rad)) {
            return true;
        }
    }
    return false;
}

void TouchProcedure::take() {
    const geometry::RigidTransform pose = still_.mean();
    if (lies_where_another_lay(pose)) {
        go_to(Stage::Place, TouchPrompt::SamePlace);
        return;
    }
    touches_[at_] = Touch{pose, crosses_[at_].pixel, crosses_[at_].block_m};
    word_ = TouchPrompt::Taken;
    go_to_next_open();
}

void TouchProcedure::go_to_next_open() {
    const auto end = touches_.begin() + static_cast<std::ptrdiff_t>(asked_);
    const auto open = std::find(touches_.begin(), end, std::nullopt);
    stage_ = open == end ? Stage::Solve : Stage::Place;
    at_ = open == end ? at_ : static_cast<std::size_t>(open - touches_.begin());
}

bool TouchProcedure::asks_for_more() const {
    return judged_ && judged_->verdict == Verdict::Repeat && judged_->repeat.empty() &&
           asked_ < crosses_.size();
}

/// Back repeats one touch, whatever the verdict: the one with the largest residual, or the last if none is
/// known.
void TouchProcedure::after_judgement(const Input& input) {
    const TouchJudgement& judged = *judged_;
    const bool is_refused = judged.verdict == Verdict::Refused;
    const bool may_be_kept = judged.verdict == Verdict::Good || judged.verdict == Verdict::Usable;
    const bool is_touch_up = task_ == TouchTask::TouchUp;
    if (!input.next && !input.back) {
        return;
    }
    if (input.next && (may_be_kept || (is_refused && is_touch_up))) {
        stage_ = may_be_kept ? Stage::Done : Stage::GoesOn;
        return;
    }
    if (is_refused && (input.next || is_touch_up)) {
        std::fill(touches_.begin(), touches_.end(), std::nullopt);
    } else if (input.next && asks_for_more()) {
        asked_ = std::min(asked_ + more_at_once, crosses_.size());
    } else if (input.next && !judged.repeat.empty()) {
        for (const std::size_t row : judged.repeat) {
            touches_[row].reset();
        }
    } else {
        touch_worst_again();
    }
    go_to_next_open();
}

void TouchProcedure::touch_worst_again() {
    const std::vector<TouchResidual>& residuals = judged_->residuals;
    const auto worst = std::max_element(
        residuals.begin(), residuals.end(),
        [](const TouchResidual& a, const TouchResidual& b) { return a.on_table_m < b.on_table_m; });
    touches_[residuals.empty() ? asked_ - 1 : static_cast<std::size_t>(worst - residuals.begin())].reset();
}

Touches TouchProcedure::touches() const {
    Touches all;
    for (const std::optional<Touch>& touch : touches_) {
        if (touch) {
            all.push_back(*touch);
        }
    }
    return all;
}

} // namespace frustumscreen::calibration

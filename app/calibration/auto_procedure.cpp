#include "app/calibration/auto_procedure.h"

#include "app/geometry/rotation_angle.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace frustumscreen {

namespace {

constexpr std::size_t more_rests = 4;

/// A camera that is slow sends good frames; one that sees nothing but dark while dark is shown is well.
bool can_be_used(CameraState state, bool dark_is_shown) {
    return health_of(state) == CameraHealth::Well || state == CameraState::Slow ||
           (dark_is_shown && state == CameraState::Dark);
}

} // namespace

StripeSetup stripes_for(int width, int height) {
    constexpr double periods = 120.0; // along the picture
    return {width, height, std::max(16, 2 * static_cast<int>(std::lround(0.5 * width / periods))), 8};
}

AutoProcedure::AutoProcedure(Board board, const AutoPlan& plan, std::string problem)
    : board_(std::move(board)), plan_(plan), problem_(std::move(problem)),
      wanted_(static_cast<std::size_t>(plan.rests)) {}

void AutoProcedure::step(const Input& input) {
    camera_ = input.camera;
    if (stage_ != AutoStage::Begin || !camera_well_ || can_be_used(camera_, false)) {
        camera_well_ = input.now;
    }
    if (nobody_is_there(input)) {
        stage_ = AutoStage::Left;
    }
    switch (stage_) {
    case AutoStage::Begin:
        begin(input);
        break;
    case AutoStage::Delay:
        measure_delay(input);
        break;
    case AutoStage::Place:
        place(input);
        break;
    case AutoStage::Capture:
        capture(input);
        break;
    case AutoStage::Judged:
        after_judgement(input);
        break;
    case AutoStage::Solve:
    case AutoStage::Done:
    case AutoStage::Crosses:
    case AutoStage::Left:
        break;
    }
    if (const std::optional<Pattern> next = to_show(); next != shown_) {
        shown_ = next;
        ++number_;
    }
}

bool AutoProcedure::nobody_is_there(const Input& input) {
    const Nanoseconds patient = stage_ == AutoStage::Begin ? to_begin : to_go_on;
    return last_press_.is_older_than(patient, input.now, input.next || input.back) &&
           stage_ != AutoStage::Done && stage_ != AutoStage::Crosses;
}

std::optional<Pattern> AutoProcedure::to_show() const {
    if (stage_ == AutoStage::Delay && light_) {
        return light_->pattern();
    }
    return stage_ == AutoStage::Capture ? std::optional(stripes_->pattern()) : std::nullopt;
}

std::optional<MonotonicTime> AutoProcedure::lit(const Input& input) const {
    return input.lit && input.lit->number == number_ ? std::optional(input.lit->since) : std::nullopt;
}

/// A camera that is not there or sees nothing is told here, once it had the time to be set up: nothing begins with it.
void AutoProcedure::begin(const Input& input) {
    word_ = input.now - *camera_well_ > patience ? AutoWord::CameraFault : AutoWord::None;
    if (input.back) {
        stage_ = problem_.empty() && plan_.crosses_follow ? AutoStage::Crosses : AutoStage::Left;
    } else if (input.next && problem_.empty() && word_ == AutoWord::None) {
        stage_ = AutoStage::Delay;
    }
}

/// Where the camera does not see the light, that is said, and it is measured again as soon as Next is pressed.
void AutoProcedure::measure_delay(const Input& input) {
    if (input.back) {
        stage_ = word_ != AutoWord::None && plan_.crosses_follow ? AutoStage::Crosses : AutoStage::Begin;
        light_.reset();
        word_ = AutoWord::None;
        return;
    }
    if (!can_be_used(input.camera, true)) {
        light_.reset();
        word_ = AutoWord::CameraFault;
        return;
    }
    if (!light_) {
        if (word_ == AutoWord::NoLight && !input.next) {
            return;
        }
        word_ = AutoWord::None;
        light_.emplace();
    }
    light_->step(lit(input), input.frame);
    if (light_->is_done()) {
        delay_ = light_->delay();
        light_.reset();
        word_ = delay_ ? AutoWord::None : AutoWord::NoLight;
        stage_ = delay_ ? AutoStage::Place : AutoStage::Delay;
    }
}

void AutoProcedure::place(const Input& input) {
    if (input.back) {
        drop_last();
        return;
    }
    if (input.next) {
        const bool is_enough = taken_.size() >= least();
        stage_ = is_enough ? AutoStage::Solve : stage_;
        word_ = is_enough ? AutoWord::None : AutoWord::TooFew;
        return;
    }
    if (!watch(input) || !is_at_rest(input)) {
        return;
    }
    if (const auto posture = posture_of(still_.mean()); !posture) {
        word_ = posture.error();
        return;
    }
    if (!not_before_ || input.now >= *not_before_) {
        begin_capture(input.now);
    }
}

void AutoProcedure::drop_last() {
    if (taken_.empty()) {
        word_ = AutoWord::None;
        stage_ = AutoStage::Begin;
        return;
    }
    taken_.pop_back();
    done_with_.reset(); // it may be taken anew where it stands
    still_.clear();
    word_ = AutoWord::Dropped;
}

/// Whether camera and tracker see anything.
bool AutoProcedure::watch(const Input& input) {
    seen_ = input.report || !seen_ ? input.now : *seen_;
    if (!can_be_used(input.camera, false)) {
        word_ = AutoWord::CameraFault;
        return false;
    }
    if (input.now - *seen_ > patience) {
        word_ = AutoWord::NotSeen;
        still_.clear();
        return false;
    }
    if (word_ == AutoWord::CameraFault || word_ == AutoWord::NotSeen) {
        word_ = AutoWord::None;
    }
    return true;
}

/// Somewhere else than before.
bool AutoProcedure::is_at_rest(const Input& input) {
    if (input.report && !still_.add(input.now, *input.report)) {
        not_before_.reset();
    }
    if (still_.count() == 0 || still_.rest() < rest) {
        return false;
    }
    return !done_with_ || !is_near(still_.mean(), *done_with_, same_place_m, same_place_rad);
}

/// Or why no rest can be taken there.
tl::expected<Posture, AutoWord> AutoProcedure::posture_of(const RigidTransform& report) const {
    std::vector<RigidTransform> flat = flat_ones();
    if (flat.size() < first_flat) {
        for (const RigidTransform& other : flat) {
            if (rotation_angle(other.rotation, report.rotation) < turned_rad) {
                return tl::unexpected(AutoWord::TurnIt);
            }
        }
        flat.push_back(report);
        if (flat.size() == first_flat && flat_posture(flat)->tilt_rad > flat_rad) {
            return tl::unexpected(AutoWord::NotFlat);
        }
        return Posture::Flat;
    }
    const RestStance stance = stance_of(*flat_posture(flat), report);
    if (stance.tilt_rad > flat_rad) {
        return stance.tilt_rad < leaning_rad
                   ? tl::expected<Posture, AutoWord>(tl::unexpected(AutoWord::LeansLittle))
                   : Posture::Leaning;
    }
    const double raised = std::abs(stance.raised_m); // the normal may point down
    if (raised <= height_m) {
        return Posture::Flat;
    }
    return std::abs(raised - plan_.block_m) <= height_m ? tl::expected<Posture, AutoWord>(Posture::Block)
                                                        : tl::unexpected(AutoWord::WrongHeight);
}

std::vector<FoundTag> AutoProcedure::tags_in(const CameraFrame& frame) {
    detector_.find(frame.luma, frame.width, frame.height, found_);
    return tags_of(board_, found_);
}

void AutoProcedure::begin_capture(MonotonicTime now) {
    stripes_.emplace(CaptureSetup{plan_.stripes, *delay_, plan_.frames}, now);
    before_.clear();
    word_ = AutoWord::None;
    stage_ = AutoStage::Capture;
}

void AutoProcedure::capture(const Input& input) {
    seen_ = input.report ? input.now : *seen_;
    if (input.back) {
        done_with_ = still_.mean(); // it is to be put elsewhere first
        end_capture(input.now, AutoWord::None);
    } else if (input.report && !still_.add(input.now, *input.report)) {
        end_capture(input.now, AutoWord::Moved);
    } else if (input.now - *seen_ > patience) {
        end_capture(input.now, AutoWord::NotSeen);
    } else if (!can_be_used(input.camera, true)) {
        end_capture(input.now, AutoWord::CameraFault);
    } else if (!stripes_->step(input.now, lit(input), input.frame)) {
        end_capture(input.now, AutoWord::NoFrames);
    } else if (stripes_->is_complete()) {
        look_at_captures(input.now);
    } else if (stripes_->has_before() && before_.empty()) {
        before_ = tags_in(stripes_->before());
        tags_ = static_cast<int>(before_.size());
        if (tags_ < least_tags) {
            end_capture(input.now, AutoWord::FewTags);
        }
    }
}

void AutoProcedure::end_capture(MonotonicTime now, AutoWord word) {
    stripes_.reset();
    not_before_ = now + pause;
    word_ = word;
    stage_ = AutoStage::Place;
}

void AutoProcedure::look_at_captures(MonotonicTime now) {
    const BoardView view =
        view_of(board_, plan_.stripes, stripes_->captures(), before_, tags_in(stripes_->after()));
    tags_ = view.tags;
    if (2 * view.moved > view.tags) {
        end_capture(now, AutoWord::Moved);
    } else if (2 * (view.moved + view.disturbed) > view.tags) {
        end_capture(now, AutoWord::Disturbed);
    } else if (view.tags < least_tags) {
        done_with_ = still_.mean(); // the same again would show the same
        end_capture(now, view.clipped > 0 ? AutoWord::TooBright : AutoWord::FewTags);
    } else {
        take(now, view);
    }
}

void AutoProcedure::take(MonotonicTime now, const BoardView& view) {
    const RigidTransform report = still_.mean();
    const auto posture = posture_of(report);
    if (!posture) { // on the verge of it
        end_capture(now, posture.error());
        return;
    }
    std::optional<double> block_m;
    if (*posture != Posture::Leaning) {
        block_m = plan_.board_m + (*posture == Posture::Block ? plan_.block_m : 0.0);
    }
    taken_.push_back({{++last_name_, report, view.points, block_m}, *posture, view.has_top});
    done_with_ = report;
    last_press_.renew(now);
    end_capture(now, AutoWord::Taken);
    if (taken_.size() >= wanted_) {
        stage_ = AutoStage::Solve;
    }
}

Rests AutoProcedure::rests() const {
    Rests all;
    for (const TakenRest& each : taken_) {
        all.push_back(each.rest);
    }
    return all;
}

std::vector<RigidTransform> AutoProcedure::flat_ones() const {
    std::vector<RigidTransform> flat;
    for (const TakenRest& each : taken_) {
        if (each.posture == Posture::Flat) {
            flat.push_back(each.rest.tracker_from_sensor);
        }
    }
    return flat;
}

void AutoProcedure::judge(AutoCalibration calibration) {
    assert(stage_ == AutoStage::Solve);
    word_ = AutoWord::None;
    stage_ = AutoStage::Judged;
    judged_ = std::move(calibration);
}

/// Rests that do not fit are dropped, and as many taken anew; what is refused begins anew. Back keeps all, and goes on.
void AutoProcedure::after_judgement(const Input& input) {
    const TouchCalibration& found = judged_->found;
    if (input.next && (found.verdict == Verdict::Good || found.verdict == Verdict::Usable)) {
        stage_ = AutoStage::Done;
    } else if (input.next && found.verdict == Verdict::Refused) {
        taken_.clear();
        go_on();
    } else if (input.next && !found.repeat.empty()) {
        for (auto row = found.repeat.rbegin(); row != found.repeat.rend(); ++row) {
            taken_.erase(taken_.begin() + static_cast<std::ptrdiff_t>(*row));
        }
        go_on();
    } else if (input.next || input.back) {
        wanted_ = taken_.size() + more_rests;
        go_on();
    }
}

void AutoProcedure::go_on() {
    wanted_ = std::max(wanted_, taken_.size() + 1);
    stage_ = AutoStage::Place;
}

} // namespace frustumscreen

#include "app/calibration/procedure/auto_procedure.h"

#include "app/geometry/rotation_angle.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::calibration {

namespace {

constexpr std::size_t more_rests = 4;

/// A slow camera sends good frames; a dark frame is right while dark is shown.
bool can_be_used(camera::CameraState state, bool dark_is_shown) {
    return camera::health_of(state) == camera::CameraHealth::Well || state == camera::CameraState::Slow ||
           (dark_is_shown && state == camera::CameraState::Dark);
}

} // namespace

StripeSetup stripes_for(int width, int height) {
    constexpr double periods = 120.0; // along the picture
    return {.width = width,
            .height = height,
            .period_px = std::max(16, 2 * static_cast<int>(std::lround(0.5 * width / periods))),
            .steps = 8};
}

AutoProcedure::AutoProcedure(Board board, const AutoPlan& plan, std::string problem)
    : Procedure(std::move(problem)), board_(std::move(board)), plan_(plan),
      wanted_(static_cast<std::size_t>(plan.rests)) {}

void AutoProcedure::step(const Input& input) {
    static constexpr Row<AutoProcedure> rows[]{{Stage::Begin, &AutoProcedure::begin},
                                               {Stage::Delay, &AutoProcedure::measure_delay},
                                               {Stage::Place, &AutoProcedure::place},
                                               {Stage::Capture, &AutoProcedure::capture},
                                               {Stage::Judged, &AutoProcedure::after_judgement}};
    camera_ = input.camera;
    if (stage_ != Stage::Begin || !camera_well_ || can_be_used(camera_, false)) {
        camera_well_ = input.now;
    }
    leave_if_alone(input);
    step_in_stage(*this, rows, input);
    if (const std::optional<Pattern> next = to_show(); next != shown_) {
        shown_ = next;
        ++number_;
    }
}

std::optional<Pattern> AutoProcedure::to_show() const {
    if (stage_ == Stage::Delay && light_) {
        return light_->pattern();
    }
    return stage_ == Stage::Capture ? std::optional(stripes_->pattern()) : std::nullopt;
}

std::optional<MonotonicTime> AutoProcedure::lit(const Input& input) const {
    return input.lit && input.lit->number == number_ ? std::optional(input.lit->since) : std::nullopt;
}

/// Once the camera had time to start, reports that it is missing or sees nothing: Next does not begin then.
void AutoProcedure::begin(const Input& input) {
    word_ = input.now - *camera_well_ > timeout ? AutoPrompt::CameraFault : AutoPrompt::None;
    if (input.back) {
        stage_ = problem_.empty() && plan_.crosses_follow ? Stage::GoesOn : Stage::Left;
    } else if (input.next && problem_.empty() && word_ == AutoPrompt::None) {
        stage_ = Stage::Delay;
    }
}

/// If the camera does not see the light, says so and measures again on Next.
void AutoProcedure::measure_delay(const Input& input) {
    if (input.back) {
        go_to(word_ != AutoPrompt::None && plan_.crosses_follow ? Stage::GoesOn : Stage::Begin);
        light_.reset();
        return;
    }
    if (!can_be_used(input.camera, true)) {
        light_.reset();
        word_ = AutoPrompt::CameraFault;
        return;
    }
    if (!light_) {
        if (word_ == AutoPrompt::NoLight && !input.next) {
            return;
        }
        word_ = AutoPrompt::None;
        light_.emplace();
    }
    light_->step(lit(input), input.frame);
    if (light_->is_done()) {
        delay_ = light_->delay();
        light_.reset();
        go_to(delay_ ? Stage::Place : Stage::Delay, delay_ ? AutoPrompt::None : AutoPrompt::NoLight);
    }
}

void AutoProcedure::place(const Input& input) {
    if (input.back) {
        drop_last();
        return;
    }
    if (input.next) {
        const bool is_enough = taken_.size() >= least();
        go_to(is_enough ? Stage::Solve : stage_, is_enough ? AutoPrompt::None : AutoPrompt::TooFew);
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
        go_to(Stage::Begin);
        return;
    }
    taken_.pop_back();
    done_with_.reset(); // it may be taken again where it stands
    still_.clear();
    word_ = AutoPrompt::Dropped;
}

/// True if camera and tracker both see something.
bool AutoProcedure::watch(const Input& input) {
    seen_ = input.prop || !seen_ ? input.now : *seen_;
    if (!can_be_used(input.camera, false)) {
        word_ = AutoPrompt::CameraFault;
        return false;
    }
    if (input.now - *seen_ > timeout) {
        word_ = AutoPrompt::NotSeen;
        still_.clear();
        return false;
    }
    if (word_ == AutoPrompt::CameraFault || word_ == AutoPrompt::NotSeen) {
        word_ = AutoPrompt::None;
    }
    return true;
}

/// True if the prop rests at a new place.
bool AutoProcedure::is_at_rest(const Input& input) {
    if (input.prop && !still_.add(input.now, *input.prop)) {
        not_before_.reset();
    }
    if (still_.count() == 0 || still_.rest() < rest) {
        return false;
    }
    return !done_with_ || !is_near(still_.mean(), *done_with_, same_place_m, same_place_rad);
}

/// The posture, or the reason why no rest can be taken.
tl::expected<Posture, AutoPrompt> AutoProcedure::posture_of(const geometry::RigidTransform& report) const {
    std::vector<geometry::RigidTransform> flat = flat_ones();
    if (flat.size() < first_flat) {
        for (const geometry::RigidTransform& other : flat) {
            if (geometry::rotation_angle(other.rotation, report.rotation) < turned_rad) {
                return tl::unexpected(AutoPrompt::TurnIt);
            }
        }
        flat.push_back(report);
        if (flat.size() == first_flat && flat_posture(flat)->tilt_rad > flat_rad) {
            return tl::unexpected(AutoPrompt::NotFlat);
        }
        return Posture::Flat;
    }
    const RestStance stance = stance_of(*flat_posture(flat), report);
    if (stance.tilt_rad > flat_rad) {
        return stance.tilt_rad < leaning_rad
                   ? tl::expected<Posture, AutoPrompt>(tl::unexpected(AutoPrompt::LeansLittle))
                   : Posture::Leaning;
    }
    const double raised = std::abs(stance.raised_m); // the normal may point down
    if (raised <= height_m) {
        return Posture::Flat;
    }
    return std::abs(raised - plan_.block_m) <= height_m ? tl::expected<Posture, AutoPrompt>(Posture::Block)
                                                        : tl::unexpected(AutoPrompt::WrongHeight);
}

std::vector<tags::FoundTag> AutoProcedure::tags_in(const camera::CameraFrame& frame) {
    detector_.find(frame.luma, frame.width, frame.height, found_);
    return tags_of(board_, found_);
}

void AutoProcedure::begin_capture(MonotonicTime now) {
    stripes_.emplace(CaptureSetup{plan_.stripes, *delay_, plan_.frames}, now);
    before_.clear();
    go_to(Stage::Capture);
}

void AutoProcedure::capture(const Input& input) {
    seen_ = input.prop ? input.now : *seen_;
    if (input.back) {
        done_with_ = still_.mean(); // the prop must move first
        end_capture(input.now, AutoPrompt::None);
    } else if (input.prop && !still_.add(input.now, *input.prop)) {
        end_capture(input.now, AutoPrompt::Moved);
    } else if (input.now - *seen_ > timeout) {
        end_capture(input.now, AutoPrompt::NotSeen);
    } else if (!can_be_used(input.camera, true)) {
        end_capture(input.now, AutoPrompt::CameraFault);
    } else if (!stripes_->step(input.now, lit(input), input.frame)) {
        end_capture(input.now, AutoPrompt::NoFrames);
    } else if (stripes_->is_complete()) {
        look_at_captures(input.now);
    } else if (stripes_->has_before() && before_.empty()) {
        before_ = tags_in(stripes_->before());
        tags_ = static_cast<int>(before_.size());
        if (tags_ < min_tags) {
            end_capture(input.now, AutoPrompt::FewTags);
        }
    }
}

void AutoProcedure::end_capture(MonotonicTime now, AutoPrompt word) {
    stripes_.reset();
    not_before_ = now + pause;
    go_to(Stage::Place, word);
}

void AutoProcedure::look_at_captures(MonotonicTime now) {
    const BoardView view =
        view_of(board_, plan_.stripes, stripes_->captures(), before_, tags_in(stripes_->after()));
    tags_ = view.tags;
    if (2 * view.moved > view.tags) {
        end_capture(now, AutoPrompt::Moved);
    } else if (2 * (view.moved + view.disturbed) > view.tags) {
        end_capture(now, AutoPrompt::Disturbed);
    } else if (view.tags < min_tags) {
        done_with_ = still_.mean(); // repeating it would show the same
        end_capture(now, view.clipped > 0 ? AutoPrompt::TooBright : AutoPrompt::FewTags);
    } else {
        take(now, view);
    }
}

void AutoProcedure::take(MonotonicTime now, const BoardView& view) {
    const geometry::RigidTransform report = still_.mean();
    const auto posture = posture_of(report);
    if (!posture) { // the mean changed during the capture, close to a limit
        end_capture(now, posture.error());
        return;
    }
    std::optional<double> block_m;
    if (*posture != Posture::Leaning) {
        block_m = plan_.board_m + (*posture == Posture::Block ? plan_.block_m : 0.0);
    }
    taken_.push_back({{++last_name_, report, view.points, block_m}, *posture, view.has_top});
    done_with_ = report;
    latest_press_ = now;
    end_capture(now, AutoPrompt::Taken);
    if (taken_.size() >= wanted_) {
        stage_ = Stage::Solve;
    }
}

Rests AutoProcedure::rests() const {
    Rests all;
    for (const TakenRest& each : taken_) {
        all.push_back(each.rest);
    }
    return all;
}

std::vector<geometry::RigidTransform> AutoProcedure::flat_ones() const {
    std::vector<geometry::RigidTransform> flat;
    for (const TakenRest& each : taken_) {
        if (each.posture == Posture::Flat) {
            flat.push_back(each.rest.tracker_from_sensor);
        }
    }
    return flat;
}

/// Next drops rests that do not fit and asks for as many; after a refusal it begins again. Back keeps all
/// rests and asks for more.
void AutoProcedure::after_judgement(const Input& input) {
    const TouchCalibration& found = judged_->found;
    if (input.next && (found.verdict == Verdict::Good || found.verdict == Verdict::Usable)) {
        stage_ = Stage::Done;
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
    stage_ = Stage::Place;
}

} // namespace frustumscreen::calibration

#include "app/exhibit/exhibit.h"

#include <algorithm>
#include <utility>

namespace frustumscreen {

Exhibit::Exhibit(Catalogue catalogue, const ExhibitPlace& place, const std::string& language,
                 MonotonicTime now)
    : catalogue_(std::move(catalogue)), place_(place), house_language_(language),
      selection_(make_selection(catalogue_, language, now)), ready_(catalogue_.size(), ArtifactState::Ready),
      offered_(catalogue_.size(), true), staff_(place.staff_stays), state_since_(now),
      next_turn_(now + turn_time),
      guide_(place.guidance ? std::optional<Guide>(*place.guidance) : std::nullopt),
      sentences_(place.words, place.picture_m), table_(lay_out_catalogue(catalogue_, place)),
      placer_(place.picture_m), labels_(place.picture_m) {}

Presentation Exhibit::step(MonotonicTime now, std::span<const Command> commands,
                           const TrackedState& tracked_state) {
    const bool pressed =
        std::any_of(commands.begin(), commands.end(), [](Command command) { return !is_hold(command); });
    // A visitor who is being told something is present, even without moving.
    const bool narration_sequencer = tells();
    there_ = presence_.update(now, tracked_state, pressed || narration_sequencer);
    const bool rests = state_ == State::Staff ? staff_.is_over(now) : presence_.rests(now, place_.rest);
    if (rests && state_ != State::Staff && state_ != State::Attract) {
        rest(now);
    }
    go_to(next(state_, rests ? Event::Rest : Event::VisitorComes), now);
    offer_what_can_be_shown(now);
    for (const Command command : commands) {
        take(command, now);
    }
    staff_.step(now);
    if (!attract_) {
        attract_.emplace(place_.attract_place_m, tracked_state.prop_known, now);
    }
    const Stand stand =
        attract_->at(now, tracked_state.prop_known, tracked_state.prop_age, tracked_state.table_from_prop);
    side_.update(tracked_state.eye_m);
    go_to(state_after(state_, observe(now, tracked_state, stand)), now);
    follow_set(now);
    if (state_ == State::Attract && now >= next_turn_ && !leaves_set()) {
        selection_.choose(selection_.next(), now);
        next_turn_ = now + turn_time;
    }
    return present(now, tracked_state, stand, pressed);
}

void Exhibit::note(std::span<const ArtifactState> states) {
    std::copy_n(states.begin(), std::min(states.size(), ready_.size()), ready_.begin());
}

void Exhibit::note_triangles(std::size_t artifact, ArtifactTriangles triangles) {
    if (artifact >= catalogue_.size()) {
        return;
    }
    if (artifact != triangles_of_) {
        catalogue_[triangles_of_].hotspots.triangles = {};
    }
    triangles_of_ = artifact;
    catalogue_[artifact].hotspots.triangles = std::move(triangles);
}

void Exhibit::offer_what_can_be_shown(MonotonicTime now) {
    for (std::size_t artifact = 0; artifact < ready_.size(); ++artifact) {
        const bool offered = ready_[artifact] != ArtifactState::LeftOut;
        if (offered != offered_[artifact]) {
            offered_[artifact] = offered;
            selection_.offer(artifact, offered, now);
            if (table_) {
                table_->offer(artifact, offered);
            }
        }
    }
}

bool Exhibit::ready(std::size_t artifact) const {
    return artifact < ready_.size() && ready_[artifact] == ArtifactState::Ready;
}

void Exhibit::take(Command command, MonotonicTime now) {
    if (command == Command::StaffMode) {
        take_chord(now);
        return;
    }
    if (is_hold(command)) {
        take_hold(command == Command::HoldFirst, now);
        return;
    }
    const bool counts = state_ != State::Staff;
    selected_.at(static_cast<std::size_t>(button_of(command))) = counts;
    if (counts) {
        selection_.take(command, now);
        choose_ = choose_ || command == Command::Choose;
        help_ = help_ || command == Command::Help;
    } else {
        staff_.press(static_cast<std::size_t>(button_of(command)), now);
    }
    go_to(next(state_, Event::Press), now);
}

/// Undoes the presses of the first and the last button, with which the chord began, and switches the staff's
/// mode.
void Exhibit::take_chord(MonotonicTime now) {
    for (const std::size_t button : {std::size_t{0}, place_.buttons - 1}) {
        if (button < selected_.size() && std::exchange(selected_[button], false)) {
            selection_.undo(button_commands[button], now);
        }
    }
    if (state_ == State::Staff) {
        staff_.undo_chord(place_.buttons - 1);
    } else {
        staff_.begin(now);
    }
    go_to(next(state_, Event::Chord), now);
}

void Exhibit::take_hold(bool first, MonotonicTime now) {
    if (state_ == State::Staff) {
        staff_.hold(first, now);
    }
}

void Exhibit::go_to(State state, MonotonicTime now) {
    if (state != state_) {
        state_before_ = std::exchange(state_, state);
        state_since_ = now;
    }
}

void Exhibit::rest(MonotonicTime now) {
    selection_.reset_language(now);
    sensed_.forget();
    if (guide_) {
        guide_->forget();
    }
    next_turn_ = now + turn_time;
}

Observed Exhibit::observe(MonotonicTime now, const TrackedState& tracked_state, const Stand& stand) {
    Observed seen;
    seen.nothing_to_show = std::find(offered_.begin(), offered_.end(), true) == offered_.end();
    seen.tracker_lost = attract_->lost();
    step_table(now, tracked_state, stand, seen);
    guidance_ = step_guide(now, tracked_state, stand);
    seen.narration_sequencer = tells();
    seen.advice_due = guidance_ != nullptr;
    return seen;
}

/// While the prop's pose is unknown, or in staff mode, the prop rests nowhere.
void Exhibit::step_table(MonotonicTime now, const TrackedState& tracked_state, const Stand& stand,
                         Observed& seen) {
    if (!table_) {
        return;
    }
    TableBrowser::Input input{selection_.artifact(),
                              side_.quarter_turns(),
                              stand_hides(place_.prop, stand, place_.lens_m),
                              std::nullopt,
                              choose_,
                              std::nullopt};
    if (sign_) {
        input.sign = hull_of({}, sign_->corners_m);
    }
    if (tracked_state.prop_known && state_ != State::Staff) {
        input.prop_m = standing_place(place_.prop, tracked_state.table_from_prop);
    }
    const std::optional<std::size_t> chosen = table_->step(now, input);
    seen.prop_rests = table_->presented().ring.has_value();
    seen.artifact_chosen = chosen.has_value();
    if (chosen && state_ != State::Attract) { // in Attract, no visitor has chosen it
        selection_.choose(*chosen, now);
    }
    choose_ = choose_ && !table_->chose();
    placer_.set_obstacles(table_->obstacles());
    sentences_.set_obstacles(table_->obstacles());
}

const Guidance* Exhibit::step_guide(MonotonicTime now, const TrackedState& tracked_state,
                                    const Stand& stand) {
    const bool lost = attract_->lost();
    answer_comes_ = false;
    const Sensing sensing = sensed_.update(now, tracked_state, lost, presence_.touched());
    const bool on_way = sensing == Sensing::Good && is_on_way_to_picture(now);
    const bool can_be_guided = lost || (tracked_state.prop_known && !stand.attracts);
    if (!guide_ || !there_ || !can_be_guided || state_ == State::Attract || state_ == State::Staff) {
        return nullptr;
    }
    if (table_ && table_->prop_is_on_picture()) {
        guide_->rest(now); // a prop that chooses a picture needs no advice
        return nullptr;
    }
    const std::size_t shown = selection_.at(now).artifact;
    guide_->show(shown < catalogue_.size() ? std::span<const glm::dvec3>(catalogue_[shown].hull)
                                           : std::span<const glm::dvec3>());
    if (help_) {
        guide_->ask();
    } else if (on_way) {
        guide_->rest(now);
        return nullptr;
    }
    // A request for help ends the speech of a description at once; otherwise the speech goes on to its next pause.
    const bool may_speak =
        (!speaking_ && state_ != State::Browse && state_ != State::Describe) || (help_ && tells());
    const Guidance& guidance =
        guide_->step(now, {tracked_state.table_from_prop, tracked_state.eye_m}, sensing, may_speak);
    answer_comes_ = help_ && guide_->answers();
    return guidance.stage != GuidanceStage::Quiet ? &guidance : nullptr;
}

/// True while the prop slides between pictures, on the way to one and back: new advice waits until the prop stands,
/// or has been moving for long.
bool Exhibit::is_on_way_to_picture(MonotonicTime now) {
    constexpr Nanoseconds longest_way = std::chrono::seconds(4);
    if (!presence_.prop_moves(now)) {
        way_since_.reset();
        return false;
    }
    way_since_ = way_since_ ? way_since_ : now;
    const bool pictures = table_ && table_->presented().count > 0;
    return pictures && guidance_ == nullptr && now - *way_since_ < longest_way;
}

bool Exhibit::tells() const {
    return narrator_.told().portion.has_value() || narrator_.told().hotspot.has_value();
}

void Exhibit::hear(bool speaking, const SpeechProgress& narration) {
    if (speaking_ && !speaking) {
        spoken_.reset();
    }
    speaking_ = speaking;
    narration_ = narration;
}

} // namespace frustumscreen

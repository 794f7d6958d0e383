#include "app/exhibit/exhibit.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::exhibit {

Exhibit::Exhibit(Catalogue catalogue, const ExhibitPlace& place, const std::string& language,
                 MonotonicTime now)
    : place_(place), first_language_(language), catalogue_(std::move(catalogue)),
      selection_(make_selection(catalogue_.all(), language, now)), staff_(place.staff_stays),
      table_(lay_out_catalogue(catalogue_.all(), place)), caption_(place.picture_m), labels_(place.picture_m),
      guide_(place.guidance), advice_(place.words, place.picture_m), title_(place.picture_m),
      torches_(place.torch ? std::optional<TorchLights>(*place.torch) : std::nullopt), map_(place.picture_m),
      windows_(place.windows ? std::optional<WindowDesk>(std::in_place, *place.windows, place.picture_m)
                             : std::nullopt) {}

Presentation Exhibit::step(MonotonicTime now, std::span<const settings::Command> commands,
                           const tracking::TrackedState& tracked_state) {
    const bool pressed = std::any_of(commands.begin(), commands.end(),
                                     [](settings::Command command) { return !settings::is_hold(command); });
    // A visitor who is being told something is present, even without moving.
    presence_.update(now, tracked_state, pressed || tells());
    const bool rests = state_ == State::Staff ? staff_.is_over(now) : presence_.rests(now, place_.rest);
    if (rests && state_ != State::Staff && state_ != State::Attract) {
        rest(now);
    }
    state_ = next(state_, rests ? Event::Rest : Event::VisitorComes);
    offer_what_can_be_shown(now);
    for (const settings::Command command : commands) {
        take(command, now);
    }
    take_torch_presses();
    staff_.step(now);
    if (!idle_pose_) {
        idle_pose_.emplace(place_.attract_place_m, tracked_state.prop_known, now, place_.in_hand);
    }
    const DrawnPose drawn =
        idle_pose_->at(now, tracked_state.prop_known, tracked_state.prop_age, tracked_state.table_from_prop);
    side_.update(tracked_state.eye_m);
    state_ = state_after(state_, observe(now, tracked_state, drawn, pressed));
    set_change_.step(now, moment_for_set(now));
    if (state_ == State::Attract && selection_.turn_is_due(now) && !leaves_set()) {
        selection_.turn(now);
    }
    return present(now, tracked_state, drawn, pressed);
}

void Exhibit::offer_what_can_be_shown(MonotonicTime now) {
    while (const std::optional<ShownCatalogue::Offer> offer = catalogue_.next_offer()) {
        selection_.offer(offer->artifact, offer->offered, now);
        if (table_) {
            table_->offer(offer->artifact, offer->offered);
        }
    }
}

void Exhibit::take(settings::Command command, MonotonicTime now) {
    if (command == settings::Command::StaffMode) {
        take_chord(now);
        return;
    }
    if (settings::is_hold(command)) {
        if (state_ == State::Staff) {
            staff_.hold(command == settings::Command::HoldFirst, now);
        } else if (command == settings::Command::HoldWindow) {
            presses_.hold_window();
        }
        return;
    }
    const bool counts = state_ != State::Staff;
    presses_.take(command, counts);
    if (counts) {
        selection_.take(command, now);
    } else {
        staff_.press(static_cast<std::size_t>(settings::button_of(command)), now);
    }
    state_ = next(state_, Event::Press);
}

/// Undoes the presses of the first and the last button, with which the chord began, and switches the staff's
/// mode.
void Exhibit::take_chord(MonotonicTime now) {
    for (const std::size_t button : {std::size_t{0}, place_.buttons - 1}) {
        if (presses_.undo(button)) {
            selection_.undo(settings::button_commands[button], now);
            if (windows_ && settings::button_commands[button] == settings::Command::Window) {
                windows_->undo_pin();
                history_.forget();
            }
        }
    }
    if (state_ == State::Staff) {
        staff_.undo_chord(place_.buttons - 1);
    } else {
        staff_.begin(state_, now);
    }
    state_ = next(state_, Event::Chord);
}

void Exhibit::rest(MonotonicTime now) {
    selection_.rest(now);
    guide_.forget_visitor();
}

Observed Exhibit::observe(MonotonicTime now, const tracking::TrackedState& tracked_state,
                          const DrawnPose& drawn, bool pressed) {
    Observed seen;
    seen.nothing_to_show = !catalogue_.offers_something();
    seen.tracker_lost = idle_pose_->lost();
    step_table(now, tracked_state, drawn, seen);
    const Obstacles lying = lying_on_table();
    caption_.set_obstacles(lying.all());
    advice_.set_obstacles(lying.all());
    step_objects(now, tracked_state, pressed, seen);
    step_guide(now, tracked_state, drawn);
    seen.narration_sequencer = tells();
    seen.advice_due = guide_.guidance() != nullptr;
    return seen;
}

/// Dwell detection is off while the prop's pose is unknown, and in staff mode.
void Exhibit::step_table(MonotonicTime now, const tracking::TrackedState& tracked_state,
                         const DrawnPose& drawn, Observed& seen) {
    if (!table_) {
        return;
    }
    TableBrowser::Input input{.artifact = selection_.artifact(),
                              .quarter_turns = side_.quarter_turns(),
                              .shadow = area_hidden_by(place_.prop, drawn, place_.lens_m),
                              .prop_m = std::nullopt,
                              .choose = presses_.choose(),
                              .sign = std::nullopt};
    if (advice_.sign()) {
        input.sign = typography::hull_of({}, advice_.sign()->corners_m);
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
    if (table_->chose()) {
        presses_.end_choose();
    }
}

/// Pictures on the table take priority: a prop that is on one cannot choose an object of the room.
void Exhibit::step_objects(MonotonicTime now, const tracking::TrackedState& tracked_state, bool pressed,
                           Observed& seen) {
    const bool free = tracked_state.prop_known && state_ != State::Attract && state_ != State::Staff &&
                      !leaves_set() && !(table_ && table_->prop_is_on_picture());
    const std::optional<RoomObject> chosen =
        object_dwell_.step(now, {.object = free ? room_object_ : std::nullopt,
                                 .prop_m = tracked_state.table_from_prop.point(place_.prop.middle),
                                 .in_prop = selection_.artifact(),
                                 .choose = presses_.choose(),
                                 .other_press = pressed && !presses_.choose()});
    seen.prop_rests = seen.prop_rests || object_dwell_.settled().has_value();
    if (chosen) {
        seen.artifact_chosen = true;
        selection_.choose(chosen->artifact, now);
        presses_.end_choose();
    }
}

/// A request for help ends the speech of a description at once; otherwise the speech goes on to its next pause.
void Exhibit::step_guide(MonotonicTime now, const tracking::TrackedState& tracked_state,
                         const DrawnPose& drawn) {
    const bool help = presses_.help();
    const bool narrates = state_ == State::Browse || state_ == State::Describe;
    guide_.step(now, {.tracked_state = tracked_state,
                      .drawn = drawn,
                      .presence = presence_,
                      .lost = idle_pose_->lost(),
                      .permitted = state_ != State::Attract && state_ != State::Staff,
                      .help = help,
                      .may_speak = (!advice_.speaking() && !narrates) || (help && tells()),
                      .table = table_ ? &*table_ : nullptr,
                      .hull = catalogue_.hull(selection_.at(now).artifact)});
}

bool Exhibit::tells() const {
    return narrator_.told().portion.has_value() || narrator_.told().hotspot.has_value();
}

void Exhibit::hear(bool speaking, const SpeechProgress& narration) {
    advice_.hear(speaking);
    narrator_.hear(narration);
}

} // namespace frustumscreen::exhibit

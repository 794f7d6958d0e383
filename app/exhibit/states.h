/// The exhibit's states and the transitions between them: one table, by which the program runs and from which
/// docs/states.md is written.
///
///     next(State::View, Event::AdviceDue) == State::Guide
///
/// Rules    An event without a row for the current state changes nothing. Most events report a condition and are
///          raised in every step in which it holds, so none can be missed. Within a step they are raised in the order
///          of `Event`.
/// Rest     leads from every state to Attract in at most two rests. The compiler checks this, and that each state can
///          be reached.
/// Threads  pure; any.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace frustumscreen::exhibit {

enum class State : std::uint8_t { Attract, View, Browse, Guide, Describe, Degraded, Fault, Staff };
inline constexpr std::size_t state_count = 8;

enum class Event : std::uint8_t {
    Rest,
    VisitorComes,
    Chord,
    Press,
    NothingToShow,
    SomethingToShow,
    TrackerLost,
    TrackerBack,
    PropRests,
    PropGoesOn,
    ArtifactChosen,
    NarrationBegins,
    NarrationEnds,
    AdviceDue,
    AdviceOver
};
inline constexpr std::size_t event_count = 15;

/// The words on the table beside the caption, or in its place.
enum class Words : std::uint8_t { None, Invitation, Advice, Narration, Fault };

/// The properties of a state: its picture, words and voice; `shows` describes them for people.
struct StateNote {
    State state;
    std::string_view name;
    bool artifact; ///< the artifact is shown
    bool sign;     ///< a dark face brings the sign of the move that corrects it
    Words words;
    bool voice; ///< its words may be spoken
    std::string_view shows;
};
inline constexpr std::array<StateNote, state_count> state_notes{{
    {State::Attract, "attract", true, false, Words::Invitation, false,
     "no visitor is present: the artifacts in turn and an inviting line; silent; windows go"},
    {State::View, "view", true, false, Words::None, false,
     "the artifact in the prop, its caption, and pinned windows"},
    {State::Browse, "browse", true, false, Words::None, false,
     "as view, with the ring of the picture that the prop rests on, or the object of the room that it rests "
     "before"},
    {State::Guide, "guide", true, true, Words::Advice, true,
     "as view, with advice as a sign, in words and aloud"},
    {State::Describe, "describe", true, true, Words::Narration, true,
     "as view, with narration in words and aloud, and signs"},
    {State::Degraded, "degraded", true, false, Words::Advice, true,
     "the prop's pose is unknown: the artifact turns at its idle place; advice in words and aloud"},
    {State::Fault, "fault", false, false, Words::Fault, false,
     "no artifact can be shown: a text says so; silent"},
    {State::Staff, "staff", false, false, Words::None, false,
     "the pages of the staff picture; a test tone on request"},
}};

struct EventNote {
    Event event;
    std::string_view name;
    std::string_view when;
};
inline constexpr std::array<EventNote, event_count> event_notes{{
    {Event::Rest, "rest", "no visitor for `exhibit.rest_s`; in staff: its time is over"},
    {Event::VisitorComes, "visitor comes",
     "after a rest: prop or head has moved, a button was pressed, or narration runs"},
    {Event::Chord, "chord", "the staff's two buttons were held"},
    {Event::Press, "press", "a button was pressed"},
    {Event::NothingToShow, "nothing to show", "no artifact can be shown"},
    {Event::SomethingToShow, "something to show", "an artifact can be shown"},
    {Event::TrackerLost, "tracker lost", "the prop's place has not been known for two seconds"},
    {Event::TrackerBack, "tracker back", "the prop's place is known"},
    {Event::PropRests, "prop rests",
     "the prop rests on a picture, and the ring fills, or before an object of the room"},
    {Event::PropGoesOn, "prop goes on", "the prop does not rest there"},
    {Event::ArtifactChosen, "artifact chosen", "the ring is full, or the rest before the object is over"},
    {Event::NarrationBegins, "telling begins", "something of the artifact is being told"},
    {Event::NarrationEnds, "telling ends", "nothing is being told"},
    {Event::AdviceDue, "advice due", "a face is dark, the head is lost or metal is near"},
    {Event::AdviceOver, "advice over", "the advice was followed, or no visitor is left"},
}};

struct Transition {
    State from;
    Event on;
    State to;
};
inline constexpr std::array transitions{
    Transition{State::Attract, Event::VisitorComes, State::View},
    Transition{State::Attract, Event::Chord, State::Staff},
    Transition{State::Attract, Event::Press, State::View},
    Transition{State::Attract, Event::NothingToShow, State::Fault},

    Transition{State::View, Event::Rest, State::Attract},
    Transition{State::View, Event::Chord, State::Staff},
    Transition{State::View, Event::NothingToShow, State::Fault},
    Transition{State::View, Event::TrackerLost, State::Degraded},
    Transition{State::View, Event::PropRests, State::Browse},
    Transition{State::View, Event::NarrationBegins, State::Describe},
    Transition{State::View, Event::AdviceDue, State::Guide},

    // A filling ring is not disturbed: the prop's place there needs no correction.
    Transition{State::Browse, Event::Rest, State::Attract},
    Transition{State::Browse, Event::Chord, State::Staff},
    Transition{State::Browse, Event::NothingToShow, State::Fault},
    Transition{State::Browse, Event::TrackerLost, State::Degraded},
    Transition{State::Browse, Event::PropGoesOn, State::View},
    Transition{State::Browse, Event::ArtifactChosen, State::View},
    Transition{State::Browse, Event::NarrationBegins, State::Describe},

    Transition{State::Guide, Event::Rest, State::Attract},
    Transition{State::Guide, Event::Chord, State::Staff},
    Transition{State::Guide, Event::NothingToShow, State::Fault},
    Transition{State::Guide, Event::TrackerLost, State::Degraded},
    Transition{State::Guide, Event::PropRests, State::Browse},
    Transition{State::Guide, Event::NarrationBegins, State::Describe},
    Transition{State::Guide, Event::AdviceOver, State::View},

    // A description is told to its end, even without the prop or with a dark face.
    Transition{State::Describe, Event::Rest, State::Attract},
    Transition{State::Describe, Event::Chord, State::Staff},
    Transition{State::Describe, Event::NothingToShow, State::Fault},
    Transition{State::Describe, Event::ArtifactChosen, State::View},
    Transition{State::Describe, Event::NarrationEnds, State::View},

    Transition{State::Degraded, Event::Rest, State::Attract},
    Transition{State::Degraded, Event::Chord, State::Staff},
    Transition{State::Degraded, Event::NothingToShow, State::Fault},
    Transition{State::Degraded, Event::TrackerBack, State::View},
    Transition{State::Degraded, Event::NarrationBegins, State::Describe},

    // A rest leads to Attract; if there is still nothing to show, the next step returns to Fault.
    Transition{State::Fault, Event::Rest, State::Attract},
    Transition{State::Fault, Event::Chord, State::Staff},
    Transition{State::Fault, Event::SomethingToShow, State::View},

    // A press turns its pages. Conditions are observed after it ends.
    Transition{State::Staff, Event::Rest, State::View},
    Transition{State::Staff, Event::Chord, State::View},
};

/// The state after an event; the same state if the table has no row.
[[nodiscard]] constexpr State next(State from, Event event) {
    for (const Transition& transition : transitions) {
        if (transition.from == from && transition.on == event) {
            return transition.to;
        }
    }
    return from;
}

[[nodiscard]] constexpr const StateNote& note_of(State state) {
    return state_notes[static_cast<std::size_t>(state)];
}
[[nodiscard]] constexpr const EventNote& note_of(Event event) {
    return event_notes[static_cast<std::size_t>(event)];
}
/// Shown in place of a state's name while the exhibit sleeps (hours.h); the states go on meanwhile.
inline constexpr std::string_view asleep_name = "asleep";
[[nodiscard]] constexpr std::string_view name_of(State state) {
    return note_of(state).name;
}

/// The conditions of a step that move states.
struct Observed {
    bool nothing_to_show = false;
    bool tracker_lost = false;
    bool prop_rests = false;
    bool artifact_chosen = false; ///< in this step
    bool narration_sequencer = false;
    bool advice_due = false;
};
/// The state after the events of the conditions, in order, from NothingToShow on.
[[nodiscard]] constexpr State state_after(State state, const Observed& seen) {
    state = next(state, seen.nothing_to_show ? Event::NothingToShow : Event::SomethingToShow);
    state = next(state, seen.tracker_lost ? Event::TrackerLost : Event::TrackerBack);
    state = next(state, seen.prop_rests ? Event::PropRests : Event::PropGoesOn);
    state = seen.artifact_chosen ? next(state, Event::ArtifactChosen) : state;
    state = next(state, seen.narration_sequencer ? Event::NarrationBegins : Event::NarrationEnds);
    return next(state, seen.advice_due ? Event::AdviceDue : Event::AdviceOver);
}

inline constexpr int max_rests = 2;
/// Number of rests that lead to Attract; more than `max_rests`: none do.
[[nodiscard]] constexpr int rests_to_attract(State state) {
    int rests = 0;
    for (; state != State::Attract && rests <= max_rests; ++rests) {
        state = next(state, Event::Rest);
    }
    return rests;
}

namespace states_check {

consteval bool notes_are_in_order() {
    for (std::size_t k = 0; k < state_count; ++k) {
        if (state_notes[k].state != static_cast<State>(k)) {
            return false;
        }
    }
    for (std::size_t k = 0; k < event_count; ++k) {
        if (event_notes[k].event != static_cast<Event>(k)) {
            return false;
        }
    }
    return true;
}

/// True if a state and an event have one row at most, and each row leads to another state.
consteval bool rows_are_unique() {
    for (std::size_t k = 0; k < transitions.size(); ++k) {
        const Transition& row = transitions[k];
        if (row.from == row.to || next(row.from, row.on) != row.to) {
            return false;
        }
        for (std::size_t other = 0; other < k; ++other) {
            if (transitions[other].from == row.from && transitions[other].on == row.on) {
                return false;
            }
        }
    }
    return true;
}

consteval bool each_is_reached_and_rests() {
    std::array<bool, state_count> reached{true};
    for (std::size_t round = 0; round < state_count; ++round) {
        for (const Transition& row : transitions) {
            reached[static_cast<std::size_t>(row.to)] |= reached[static_cast<std::size_t>(row.from)];
        }
    }
    return std::all_of(state_notes.begin(), state_notes.end(), [&](const StateNote& note) {
        return reached[static_cast<std::size_t>(note.state)] && rests_to_attract(note.state) <= max_rests;
    });
}

static_assert(notes_are_in_order());
static_assert(rows_are_unique());
static_assert(each_is_reached_and_rests());

} // namespace states_check

} // namespace frustumscreen::exhibit

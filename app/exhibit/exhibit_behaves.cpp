// The artifact's behaviours: which begin and end, and the line that says what their button does.
#include "app/exhibit/exhibit.h"
#include "app/exhibit/languages.h"

#include <algorithm>

namespace frustumscreen::exhibit {

void Exhibit::behave(MonotonicTime now, const tracking::TrackedState& tracked_state, const Shown& shown,
                     const DrawnPose& drawn, bool pressed, Presentation& presentation) {
    const Nanoseconds still = stillness_.update(now, tracked_state, pressed);
    const bool looked_at = presence_.is_there() && tracked_state.prop_known && !drawn.attracts;
    const SpeechProgress& speech = narrator_.narration();
    BehaviourTriggers::Input input{.behaviours = catalogue_.behaviours(shown.artifact),
                                   .artifact = shown.artifact,
                                   .shown = has_artifact() && note_of(state_).artifact && !leaves_set(),
                                   .attracts = state_ == State::Attract,
                                   .arrived = !shown.changing && !waits(),
                                   .pressed = presses_.take_behaviour(),
                                   .rested = looked_at ? still : Nanoseconds(0),
                                   .hotspot = std::nullopt,
                                   .tells = narrator_.told().portion.has_value(),
                                   .speech_comes = speech.state == SpeechProgress::State::Coming,
                                   .heard = speech.state == SpeechProgress::State::Heard};
    if (presentation.hotspot) {
        input.hotspot = presentation.hotspot->hotspot;
    }
    presentation.behaviours = triggers_.step(now, input);
    presentation.title = title(now, tracked_state, shown, drawn, presentation);
}

/// Beside everything else on the table, and only while nothing else is said.
std::optional<PresentedTitle> Exhibit::title(MonotonicTime now, const tracking::TrackedState& tracked_state,
                                             const Shown& shown, const DrawnPose& drawn,
                                             const Presentation& presentation) {
    BehaviourTitle::Input input;
    const CatalogueEntry* const entry = catalogue_.captioned(shown.artifact);
    const bool has_button =
        place_.buttons > static_cast<std::size_t>(settings::button_of(settings::Command::Behaviour));
    const bool free = entry != nullptr && state_ == State::View && !drawn.attracts && !presentation.advice;
    const std::size_t language = free ? caption_for(shown.language, entry->languages) : 0;
    if (free && torches_ && torches_->held()) {
        input.title = content_title(*entry, shown.artifact, language, input.size_m);
    } else if (free && has_button) {
        const std::optional<std::size_t> next = triggers_.next(entry->behaviours, triggers_.presses());
        if (next && language < entry->behaviours[*next].title_sizes_m.size()) {
            input.size_m = entry->behaviours[*next].title_sizes_m[language];
        }
        if (input.size_m.y > 0.0) {
            input.title = {.artifact = shown.artifact, .behaviour = *next, .language = language};
        }
    }
    const Obstacles obstacles = obstacles_of(presentation);
    input.obstacles = obstacles.all();
    const double advised = presentation.advice ? presentation.advice->brightness : 0.0;
    input.light = shown.caption_brightness * drawn.brightness * std::max(0.0, 1.0 - 2.0 * advised);
    if (input.title || title_.has_title()) {
        input.environment = environment_of(place_, drawn, tracked_state.eye_m, side_.quarter_turns());
    }
    return title_.step(now, input);
}

} // namespace frustumscreen::exhibit

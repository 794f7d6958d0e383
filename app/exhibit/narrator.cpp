#include "app/exhibit/narrator.h"

#include "app/geometry/time_curves.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::exhibit {

const Told& Narrator::step(MonotonicTime now, const tracking::TrackedState& tracked_state,
                           const NarratorInput& input) {
    const bool has_advice = input.stage != guidance::GuidanceStage::Quiet;
    NarrationInput narration_sequencer;
    narration_sequencer.subject = input.subject;
    narration_sequencer.tellable = input.tellable;
    narration_sequencer.shown = !input.fades && input.subject == input.visible;
    narration_sequencer.whole = !has_advice && tracked_state.prop_known && !input.attracts;
    narration_sequencer.in_prop = !input.attracts;
    narration_sequencer.there = input.there;
    narration_sequencer.rested = stillness_.update(now, tracked_state, input.pressed);
    narration_sequencer.next = input.next;
    narration_sequencer.describe = input.help && !has_advice;
    narration_sequencer.gives_way = gives_way(now, tracked_state, input);
    narration_sequencer.stops = (input.help && has_advice) || is_unread(now, input);
    narration_sequencer.narration = narration_;
    told_ = narration_sequencer_.step(now, narration_sequencer);
    follow_text(now, input);
    return told_;
}

/// A request is served even while something is wrong; a problem that begins later takes priority.
bool Narrator::gives_way(MonotonicTime now, const tracking::TrackedState& tracked_state,
                         const NarratorInput& input) {
    const bool comes_to_words = input.stage >= guidance::GuidanceStage::Text &&
                                std::exchange(stage_, input.stage) < guidance::GuidanceStage::Text;
    stage_ = input.stage;
    const bool moved_away = std::exchange(attracts_, input.attracts) != input.attracts;
    const bool head_lost = head_known_ && !tracked_state.head_known;
    const bool is_lost = (!tracked_state.prop_known && !input.attracts) || head_lost;
    lost_since_ = !is_lost ? std::nullopt : lost_since_ ? lost_since_ : now;
    const bool goes = lost_since_ && now - *lost_since_ >= lost;
    if (!is_lost || goes) {
        head_known_ = tracked_state.head_known;
    }
    return comes_to_words || moved_away || goes;
}

/// True if the description should be on the table but has had no place for a while.
bool Narrator::is_unread(MonotonicTime now, const NarratorInput& input) {
    const CaptionText shown = text();
    const bool hidden = told_.portion && shown.portion && !shown.changing && !input.text_has_place;
    hidden_since_ = !hidden ? std::nullopt : hidden_since_ ? hidden_since_ : now;
    return hidden_since_ && now - *hidden_since_ >= lost;
}

/// Another artifact or language starts with its short text, while the caption is dark.
void Narrator::follow_text(MonotonicTime now, const NarratorInput& input) {
    const double step = to_seconds(now - std::exchange(last_, now)) / to_seconds(fade_time);
    portion_ = told_.portion.value_or(portion_);
    if (input.visible != visible_) {
        visible_ = input.visible;
        shows_description_ = text_leaves_ = false;
        text_brightness_ = 1.0;
    }
    if (input.fades || input.subject != input.visible) {
        fades_until_ = now;
        return;
    }
    if (text_leaves_) {
        text_brightness_ = std::max(text_brightness_ - step, 0.0);
        if (text_brightness_ <= 0.0) {
            text_leaves_ = false;
            shows_description_ = told_.portion.has_value();
        }
    } else if (text_brightness_ < 1.0) {
        text_brightness_ = std::min(text_brightness_ + step, 1.0);
    } else {
        text_leaves_ = shows_description_ != told_.portion.has_value() && now - fades_until_ >= fade_time;
    }
}

CaptionText Narrator::text() const {
    return {shows_description_ ? std::optional(portion_) : std::nullopt, geometry::ease(text_brightness_),
            text_leaves_ || text_brightness_ < 1.0};
}

} // namespace frustumscreen::exhibit

/// Narration of the artifact: when it goes on, when it yields (narration_sequencer.h), and which text the caption has.
///
/// Narration yields to advice in words, to the staff, and to a prop or head lost for longer than a tracker's dropout.
/// It ends if its text has no place on the table.
///
/// The caption changes between the artifact's short text and its description through darkness. While the artifact or
/// the caption itself fades, this fade is held, and it begins no sooner than one fade time afterwards: each alone
/// flashes at most twice a second, and together they flash at most three times (selection.h).
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
/// Errors   none.
#pragma once

#include "app/exhibit/narration_sequencer.h"
#include "app/exhibit/selection.h"
#include "app/exhibit/stillness.h"
#include "app/guidance/guide.h"

#include <cstddef>
#include <optional>

namespace frustumscreen::exhibit {

struct NarratorInput {
    DescriptionIndex subject;           ///< chosen; it may not be visible yet
    DescriptionIndex visible;           ///< on show, perhaps fading
    const Tellable* tellable = nullptr; ///< of the subject; null: nothing of it is to be told
    bool fades = false;                 ///< the artifact or its caption fades
    bool attracts = false;              ///< the artifact stands at the idle place
    bool there = true;                  ///< a visitor is present
    bool pressed = false;               ///< any button
    bool next = false;                  ///< the next thing is requested
    bool help = false;                  ///< help is requested
    bool text_has_place = true;         ///< the caption is visible, or fades
    guidance::GuidanceStage stage = guidance::GuidanceStage::Quiet;
};

/// The text of the caption.
struct CaptionText {
    std::optional<std::size_t> portion; ///< of the visible description; none: the short text
    double brightness = 1.0;            ///< 0..1, a factor on linear light
    bool changing = false;
};

class Narrator {
public:
    /// A shorter loss of prop or head is a tracker's dropout, not a visitor who leaves.
    static constexpr Nanoseconds lost = std::chrono::seconds(1);

    /// Playback of the description being told; Silent before the first call.
    void hear(const SpeechProgress& narration) { narration_ = narration; }
    const Told& step(MonotonicTime now, const tracking::TrackedState& tracked_state,
                     const NarratorInput& input);
    [[nodiscard]] const Told& told() const { return told_; }
    [[nodiscard]] const SpeechProgress& narration() const { return narration_; }
    [[nodiscard]] CaptionText text() const;

private:
    [[nodiscard]] bool gives_way(MonotonicTime now, const tracking::TrackedState& tracked_state,
                                 const NarratorInput& input);
    [[nodiscard]] bool is_unread(MonotonicTime now, const NarratorInput& input);
    void follow_text(MonotonicTime now, const NarratorInput& input);

    NarrationSequencer narration_sequencer_;
    SpeechProgress narration_;
    Told told_;
    Stillness stillness_;
    guidance::GuidanceStage stage_ = guidance::GuidanceStage::Quiet; ///< in the previous step
    bool attracts_ = false;                                          ///< in the previous step
    bool head_known_ = false; ///< a head was known before the current loss
    std::optional<MonotonicTime> lost_since_;
    std::optional<MonotonicTime> hidden_since_; ///< since when the description has had no place
    DescriptionIndex visible_;
    MonotonicTime last_;             ///< the previous step
    MonotonicTime fades_until_;      ///< end of the latest fade of the artifact or its caption
    bool shows_description_ = false; ///< in the caption
    bool text_leaves_ = false;       ///< the text fades out
    double text_brightness_ = 1.0;   ///< before easing
    std::size_t portion_ = 0;        ///< told last
};

} // namespace frustumscreen::exhibit

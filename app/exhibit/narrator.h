/// Tells the visitor of the artifact: when telling goes on and when it gives way (telling.h), and which text the caption has.
///
/// It gives way to advice that comes to words, to a prop or a head that is lost for longer than a tracker's dropout, and to the
/// staff; and it ends where its text has no place on the table.
///
/// The caption changes between the artifact's short text and its description through darkness. While the artifact or the caption
/// itself fades, this fade stands still, and it begins no sooner than a moment later: each alone flashes at most twice a second, and
/// together they flash at most three times (selection.h).
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

namespace frustumscreen {

struct NarratorInput {
    DescriptionIndex subject;           ///< chosen; it may not be visible yet
    DescriptionIndex visible;           ///< what is on show, perhaps fading
    const Tellable* tellable = nullptr; ///< of the subject, unless nothing of it is to be told now
    bool fades = false;                 ///< the artifact or its caption does
    bool attracts = false;              ///< the artifact stands at a place of its own
    bool there = true;                  ///< somebody is
    bool pressed = false;               ///< anything
    bool next = false;                  ///< asked for the next thing
    bool help = false;                  ///< asked for help
    bool text_has_place = true;         ///< the caption is seen, or fades
    GuidanceStage stage = GuidanceStage::Quiet;
    SpeechProgress narration;
};

/// The text of the caption.
struct CaptionText {
    std::optional<std::size_t> portion; ///< of the visible description; none: the short text
    double brightness = 1.0;            ///< 0..1, a factor on linear light
    bool changing = false;
};

class Narrator {
public:
    /// A tracker that loses prop or head for less is no visitor who goes.
    static constexpr Nanoseconds lost = std::chrono::seconds(1);

    const Told& step(MonotonicTime now, const TrackedState& tracked_state, const NarratorInput& input);
    [[nodiscard]] const Told& told() const { return told_; }
    [[nodiscard]] CaptionText text() const;

private:
    [[nodiscard]] bool gives_way(MonotonicTime now, const TrackedState& tracked_state,
                                 const NarratorInput& input);
    [[nodiscard]] bool is_unread(MonotonicTime now, const NarratorInput& input);
    void follow_text(MonotonicTime now, const NarratorInput& input);

    NarrationSequencer narration_sequencer_;
    Told told_;
    Stillness stillness_;
    GuidanceStage stage_ = GuidanceStage::Quiet; ///< at the step before
    bool attracts_ = false;                      ///< the same
    bool head_known_ = false;                    ///< the latest head that was not lost was known
    std::optional<MonotonicTime> lost_since_;
    std::optional<MonotonicTime> hidden_since_; ///< the description has had no place
    DescriptionIndex visible_;
    MonotonicTime last_;             ///< the step before
    MonotonicTime fades_until_;      ///< the artifact or its caption did
    bool shows_description_ = false; ///< in the caption
    bool text_leaves_ = false;       ///< it fades out
    double text_brightness_ = 1.0;   ///< before it is eased
    std::size_t portion_ = 0;        ///< that was told last
};

} // namespace frustumscreen

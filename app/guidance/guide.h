/// Guides one visitor: when an advice is given, how it is given, and when it is quiet.
///
/// One advice at a time. First it is a picture on the table, then a text beside it, then it is spoken. It goes on
/// to the next of these only while the visitor does not follow it, and what is spoken is said again after pauses that grow.
/// It ends as soon as the visitor sees the whole artifact. It does not begin for what lasts only a moment.
///
/// Frames   table T, metres.
/// Time     `now` never goes back; the rhythm of the steps does not matter, but for how often the advice is looked for.
/// Threads  values; one caller. Allocates nothing. A step takes about a millisecond while it looks for an advice, else
///          microseconds.
#pragma once

#include "app/guidance/advise.h"
#include "firmware_host/base/time.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace frustumscreen {

/// How well the tracker knows the prop and the visitor. Without the prop nothing else can be said; a lost head and metal are
/// spoken of where every seen face is lit.
enum class Sensing : std::uint8_t {
    Good,
    PropLost,    ///< it is covered or out of reach
    TrackerAway, ///< the tracker itself does not answer
    HeadLost,
    MetalNear
};

enum class GuidanceStage : std::uint8_t { Quiet, Picture, Text, Voice };

struct Guidance {
    GuidanceStage stage = GuidanceStage::Quiet;
    Move move; ///< of what is advised; Wait if only `sensing` says why
    int steps = 0;
    Sensing sensing = Sensing::Good;
    bool left_light = false;   ///< a prop of the table was lost where it was not lit
    bool speak = false;        ///< at this step the sentence begins to be spoken
    MonotonicTime since;       ///< when the picture appeared
    GuidedState tracked_state; ///< that the advice was found for
};

class Guide {
public:
    static constexpr Nanoseconds patience = std::chrono::milliseconds(400);
    /// Who has just been guided is still at it: what they lose by going too far is shown sooner.
    static constexpr Nanoseconds patience_again = std::chrono::milliseconds(100);
    static constexpr Nanoseconds again_within = std::chrono::milliseconds(1500); ///< of the latest advice
    static constexpr Nanoseconds until_text = std::chrono::milliseconds(1500);   ///< from the picture on
    static constexpr Nanoseconds until_voice = std::chrono::milliseconds(3000);  ///< from the text on
    static constexpr Nanoseconds first_pause = std::chrono::seconds(8);
    static constexpr Nanoseconds longest_pause = std::chrono::seconds(60);
    /// At most; what rests needs no other look.
    static constexpr Nanoseconds looks_every = std::chrono::milliseconds(250);

    /// About a millisecond's.
    static constexpr int looks_a_step = 2000;
    static constexpr int looks_a_step_asked = 4 * looks_a_step; ///< somebody waits

    explicit Guide(GuidanceSetup setup) : advisor_(std::move(setup)) {}

    /// The artifact that is in the prop from the next step on: the corners of its hull, prop frame, which are kept by the caller;
    /// empty: none is known, and every seen face counts.
    void show(std::span<const glm::dvec3> hull);

    /// `tracked_state`: of a lost prop the latest that was known. `may_speak`: false while something else is being said, or the
    /// words do not lie on the table.
    [[nodiscard]] const Guidance& step(MonotonicTime now, const GuidedState& tracked_state, Sensing sensing,
                                       bool may_speak);
    /// Nothing needs to be said now, whatever a visitor sees; the next step begins anew.
    void rest(MonotonicTime now);
    /// Somebody asks what to do: where there is advice, the next steps find it and give all of it at once.
    void ask() { asked_ = true; }
    /// Somebody has asked, and the answer is being looked for.
    [[nodiscard]] bool answers() const { return asked_; }
    /// The visitor has gone: the next one is told everything anew.
    void forget();
    /// The faces of the latest step.
    [[nodiscard]] const FaceSets& faces() const { return faces_; }
    [[nodiscard]] const FaceReader& reader() const { return advisor_.reader(); }

private:
    void look(MonotonicTime now, const GuidedState& tracked_state, Sensing sensing);
    void take(MonotonicTime now, const GuidedState& tracked_state, Sensing sensing);
    void raise_stage(MonotonicTime now, bool may_speak);
    void answer(MonotonicTime now, bool may_speak);
    void note_need(MonotonicTime now, bool needed);
    [[nodiscard]] bool waits(MonotonicTime now) const;

    Advisor advisor_;
    FaceSets faces_;
    Guidance guidance_;
    std::optional<MonotonicTime> last_;   ///< the step before
    Nanoseconds needed_for_{0};           ///< lately
    std::optional<MonotonicTime> guided_; ///< when an advice was there last
    std::optional<MonotonicTime> next_look_;
    std::optional<GuidedState> looks_at_; ///< while an advice is looked for
    MonotonicTime stage_since_;           ///< or since the visitor last came nearer
    double nearest_effort_ = 0.0;         ///< what was left to do, at its least
    std::optional<MonotonicTime> spoken_; ///< when it was last said
    Nanoseconds pause_ = first_pause;
    bool asked_ = false;
};

/// The sentence's key in the exhibit's own words (assets_baked/texts/words), in the visitor's own directions.
[[nodiscard]] std::string_view words_key(const Guidance& guidance);

} // namespace frustumscreen

/// Guides one visitor: when an advice is given, in which form, and when guidance is quiet.
///
/// One advice at a time. It begins as a picture on the table; then a text appears beside it; then the text is spoken.
/// Each of these follows only while the visitor does not act on the advice, and speech is repeated after increasing
/// pauses. The advice ends as soon as the visitor sees the whole artifact. A need that lasts only a moment brings no
/// advice.
///
/// Frames   table T, metres.
/// Time     `now` never goes back; the rhythm of the steps matters only for how often an advice is searched.
/// Threads  values; one caller. Allocates nothing. A step takes about a millisecond during a search, otherwise
///          microseconds.
#pragma once

#include "app/guidance/advise.h"
#include "firmware_host/base/time.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace frustumscreen::guidance {

/// How well the tracker knows the prop and the visitor. A lost prop takes priority over everything else; a lost head
/// and metal are reported only when every seen face is lit.
enum class Sensing : std::uint8_t {
    Good,
    PropLost,    ///< covered or out of reach
    TrackerAway, ///< the tracker itself does not respond
    HeadLost,
    MetalNear
};

enum class GuidanceStage : std::uint8_t { Quiet, Picture, Text, Voice };

struct Guidance {
    GuidanceStage stage = GuidanceStage::Quiet;
    Move move; ///< the advised move; Wait if only `sensing` gives the reason
    int steps = 0;
    Sensing sensing = Sensing::Good;
    bool left_light = false;   ///< a prop on the table was lost where it was not lit
    bool speak = false;        ///< the sentence's speech begins in this step
    MonotonicTime since;       ///< when the picture appeared
    GuidedState tracked_state; ///< for which the advice was found
};

class Guide {
public:
    static constexpr Nanoseconds debounce = std::chrono::milliseconds(400);
    /// A visitor who has just been guided is still moving the prop, so a loss from going too far is shown sooner.
    static constexpr Nanoseconds debounce_again = std::chrono::milliseconds(100);
    static constexpr Nanoseconds again_within = std::chrono::milliseconds(1500); ///< since the latest advice
    static constexpr Nanoseconds until_text = std::chrono::milliseconds(1500);   ///< since the picture
    static constexpr Nanoseconds until_voice = std::chrono::milliseconds(3000);  ///< since the text
    static constexpr Nanoseconds first_pause = std::chrono::seconds(8);
    static constexpr Nanoseconds longest_pause = std::chrono::seconds(60);
    /// Largest rate of searches; at rest no other search is needed.
    static constexpr Nanoseconds looks_every = std::chrono::milliseconds(250);

    /// About a millisecond of search.
    static constexpr int looks_a_step = 2000;
    static constexpr int looks_a_step_asked = 4 * looks_a_step; ///< while a visitor waits

    explicit Guide(GuidanceSetup setup) : advisor_(std::move(setup)) {}

    /// Sets the artifact in the prop from the next step on: the corners of its hull, prop frame, which the caller
    /// keeps; empty: unknown, and every seen face counts.
    void show(std::span<const glm::dvec3> hull);

    /// `tracked_state`: for a lost prop, the latest known one. `may_speak`: false while something else is spoken, or
    /// while the words are not visible on the table.
    [[nodiscard]] const Guidance& step(MonotonicTime now, const GuidedState& tracked_state, Sensing sensing,
                                       bool may_speak);
    /// Ends the advice: none is needed now, whatever the visitor sees; the next step starts a new search.
    void be_quiet(MonotonicTime now);
    /// Call when a visitor asks for help: the next steps search for an advice and give it in all forms at once.
    void ask() { asked_ = true; }
    /// True while the answer to `ask` is being searched.
    [[nodiscard]] bool answers() const { return asked_; }
    /// Forgets the visitor, who has gone: the next one gets every advice again.
    void forget();
    /// The faces seen and lit in the latest step.
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
    std::optional<MonotonicTime> last_;   ///< the previous step
    Nanoseconds needed_for_{0};           ///< need accumulated lately
    std::optional<MonotonicTime> guided_; ///< time of the latest advice
    std::optional<MonotonicTime> next_look_;
    std::optional<GuidedState> looks_at_; ///< while an advice is searched
    MonotonicTime stage_since_;           ///< or since the visitor last made progress
    double nearest_effort_ = 0.0;         ///< the least effort left so far
    std::optional<MonotonicTime> spoken_; ///< when the advice was last spoken
    Nanoseconds pause_ = first_pause;
    bool asked_ = false;
};

/// Key of the sentence in the exhibit's own texts (assets_baked/texts/words), in the visitor's own directions.
[[nodiscard]] std::string_view words_key(const Guidance& guidance);

} // namespace frustumscreen::guidance

/// What is told of an artifact, one thing after the other:
///
///     nothing -> description -> hotspot 0 -> hotspot 1 ... -> nothing
///
/// A press goes on at once. Rest leads on too: who looks at the whole picture and moves nothing is told the first thing after
/// `first_rest`, and each next one when the one before was heard or read; each thing once, until another artifact or language
/// comes, or somebody else. A description that advice interrupts in its first half is told again.
///
/// Portions a description is shown in portions. While it is heard they follow the speech, else they change at reading speed. The
///          last one may be the attribution, which is read after what was heard.
/// Ends     what is chosen or pressed ends it at once; advice, and a prop or a head that is lost, at the speech's next pause.
/// Time     `now` never goes back. No state lasts for ever: each has its longest time.
/// Threads  values; one caller. Allocates nothing.
/// Errors   none. Speech that does not come is read instead.
#pragma once

#include "firmware_host/base/time.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace frustumscreen {

/// What there is to tell of an artifact in one language.
struct Tellable {
    std::vector<Nanoseconds>
        portions; ///< of the description: how long each is read; none: there is no description
    std::vector<Nanoseconds> hotspots; ///< how long the label of each is read
    bool ends_unspoken = false;        ///< the last portion, the attribution, is read and never heard
    [[nodiscard]] std::size_t count() const { return (portions.empty() ? 0 : 1) + hotspots.size(); }
};

/// Whose description.
struct DescriptionIndex {
    std::size_t artifact = 0;
    std::size_t language = 0; ///< of its captions
    [[nodiscard]] bool operator==(const DescriptionIndex&) const = default;
};

/// How the description that is told is heard.
struct SpeechProgress {
    enum class State : std::uint8_t {
        Silent, ///< it is not heard at all
        Coming, ///< it will be heard soon
        Heard,
        Over,
    };
    State state = State::Silent;
    std::size_t portion = 0; ///< that is spoken, while it is heard
    [[nodiscard]] bool operator==(const SpeechProgress&) const = default;
};

struct NarrationInput {
    DescriptionIndex subject;           ///< that is shown, or about to be
    const Tellable* tellable = nullptr; ///< none: nothing can be told
    bool shown = true;                  ///< it is there and nothing fades: presses wait for that
    bool whole = true;                  ///< the visitor sees all of it and needs no advice
    bool in_prop = true;                ///< else no hotspot can be pointed out
    bool there = true;                  ///< somebody is there
    Nanoseconds rested{0};              ///< for how long nothing was moved or pressed
    bool next = false;                  ///< pressed: the next thing
    bool describe = false;              ///< pressed: the description
    bool gives_way = false;             ///< something else must be said or shown now
    bool stops = false;                 ///< the same, and at once
    SpeechProgress narration;           ///< as the step before has led to
};

struct Told {
    std::optional<std::size_t> portion; ///< of the description, to be shown
    std::optional<std::size_t> hotspot; ///< to be pointed out
    bool speaks = false;                ///< the description is to be heard
    bool leaves = false; ///< it goes on to the next pause; otherwise what is heard ends at once
    [[nodiscard]] bool operator==(const Told&) const = default;
};

class NarrationSequencer {
public:
    /// Long enough to look at what has come, short enough to be noticed by who waits.
    static constexpr Nanoseconds first_rest = std::chrono::seconds(6);
    /// Between what was heard or read and the next thing: a breath, as a guide in a museum takes it.
    static constexpr Nanoseconds breath = std::chrono::seconds(2);
    /// To find where a text begins, before it is read.
    static constexpr Nanoseconds finds_text = std::chrono::milliseconds(1500);
    /// A label is a few words, and the place that it means must be found on the artifact.
    static constexpr Nanoseconds min_hotspot = std::chrono::seconds(5);
    /// Who plays on without resting has seen a label by then.
    static constexpr Nanoseconds longest_hotspot = std::chrono::seconds(20);
    /// Sound that has not begun by then does not come; the description is read.
    static constexpr Nanoseconds longest_coming = std::chrono::seconds(1);
    /// A sentence's next pause comes sooner; a recording without pauses is cut off.
    static constexpr Nanoseconds longest_leaving = std::chrono::seconds(3);
    /// What is heard: a recording is no longer than three minutes.
    static constexpr Nanoseconds longest_description = std::chrono::minutes(4);
    /// Who comes after so long is somebody else, and is told all again.
    static constexpr Nanoseconds forgets = std::chrono::seconds(30);

    [[nodiscard]] Told step(MonotonicTime now, const NarrationInput& input);

private:
    enum class State : std::uint8_t { Nothing, Description, Hotspot };

    void follow_subject(MonotonicTime now, const NarrationInput& input);
    void give_way(MonotonicTime now, const NarrationInput& input);
    void take_presses(MonotonicTime now, const NarrationInput& input);
    void follow_speech(MonotonicTime now, const NarrationInput& input);
    void follow_rest(MonotonicTime now, const NarrationInput& input);
    void read_on(MonotonicTime now, const Tellable& tellable);
    void begin(std::size_t thing, MonotonicTime now, const Tellable& tellable);
    void end(MonotonicTime now);
    [[nodiscard]] std::size_t next_thing(const Tellable& tellable) const;

    DescriptionIndex subject_;
    State state_ = State::Nothing;
    MonotonicTime since_;      ///< of the state
    MonotonicTime rests_from_; ///< earlier rest does not count
    /// The thing that rest leads to: 0 is the description, or the first hotspot where there is none.
    std::size_t leads_to_ = 0;
    std::optional<MonotonicTime> nobody_since_;
    bool next_waits_ = false; ///< a press, until the artifact is there
    bool describe_waits_ = false;

    std::size_t hotspot_ = 0;
    std::size_t portion_ = 0;
    bool reads_ = false;          ///< silently
    MonotonicTime portion_since_; ///< while it is read
    std::optional<MonotonicTime> leaving_since_;
    std::optional<MonotonicTime> over_since_; ///< the description was heard or read
};

} // namespace frustumscreen

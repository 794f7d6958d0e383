/// The sequence of what is told of an artifact:
///
///     nothing -> description -> hotspot 0 -> hotspot 1 ... -> nothing
///
/// A press goes on at once. Rest goes on too: a visitor who sees the whole picture and moves nothing is told the
/// first thing after `first_rest`, and each next one when the one before has been heard or read. Each is told once,
/// until the artifact, the language or the visitor changes. A description that advice interrupts in its first half is
/// told again.
///
/// Portions a description is shown in portions. While it is heard they follow the speech, otherwise they change at
///          reading speed. The last one may be the attribution, which is read after the speech.
/// Ends     at once when something is chosen or pressed; at the speech's next pause for advice, or when prop or head
///          is lost.
/// Time     `now` never goes back. Each state has a longest time.
/// Threads  values; one caller. Allocates nothing.
/// Errors   none. Speech that does not begin is replaced by reading.
#pragma once

#include "firmware_host/base/time.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace frustumscreen::exhibit {

/// The narration that an artifact has in one language.
struct Tellable {
    std::vector<Nanoseconds>
        portions; ///< reading time of each portion of the description; empty: there is none
    std::vector<Nanoseconds> hotspots; ///< reading time of each label
    bool ends_unspoken = false;        ///< the last portion, the attribution, is read and never heard
    [[nodiscard]] std::size_t count() const { return (portions.empty() ? 0 : 1) + hotspots.size(); }
};

/// Identifies a description.
struct DescriptionIndex {
    std::size_t artifact = 0;
    std::size_t language = 0; ///< of the artifact's captions
    [[nodiscard]] bool operator==(const DescriptionIndex&) const = default;
};

/// Playback of the description being told.
struct SpeechProgress {
    enum class State : std::uint8_t {
        Silent, ///< not heard at all
        Coming, ///< will be heard soon
        Heard,
        Over,
    };
    State state = State::Silent;
    std::size_t portion = 0; ///< the portion being spoken, while heard
    [[nodiscard]] bool operator==(const SpeechProgress&) const = default;
};

struct NarrationInput {
    DescriptionIndex subject;           ///< on show, or about to be
    const Tellable* tellable = nullptr; ///< null: nothing can be told
    bool shown = true;                  ///< the artifact is there and nothing fades; presses wait for that
    bool whole = true;                  ///< the visitor sees all of it and needs no advice
    bool in_prop = true;                ///< false: no hotspot can be pointed out
    bool there = true;                  ///< a visitor is present
    Nanoseconds rested{0};              ///< time since anything was moved or pressed
    bool next = false;                  ///< pressed: the next thing
    bool describe = false;              ///< pressed: the description
    bool gives_way = false;             ///< end at the next pause of the speech
    bool stops = false;                 ///< end at once
    SpeechProgress narration;           ///< as the previous step has led to
};

struct Told {
    std::optional<std::size_t> portion; ///< portion of the description to show
    std::optional<std::size_t> hotspot; ///< to point out
    bool speaks = false;                ///< the description is to be heard
    bool leaves = false;                ///< true: speech ends at its next pause; false: at once
    [[nodiscard]] bool operator==(const Told&) const = default;
};

class NarrationSequencer {
public:
    /// Long enough to look at a new artifact, short enough to be noticed by a visitor who waits.
    static constexpr Nanoseconds first_rest = std::chrono::seconds(6);
    /// Pause between what was heard or read and the next thing: a breath, as a museum guide takes it.
    static constexpr Nanoseconds breath = std::chrono::seconds(2);
    /// Time to find where a text begins, before reading it.
    static constexpr Nanoseconds finds_text = std::chrono::milliseconds(1500);
    /// A label is a few words, but its place on the artifact must be found.
    static constexpr Nanoseconds min_hotspot = std::chrono::seconds(5);
    /// Longest time of a label while the visitor moves the prop without resting.
    static constexpr Nanoseconds longest_hotspot = std::chrono::seconds(20);
    /// Time-out for speech to begin; after it the description is shown as text to read.
    static constexpr Nanoseconds longest_coming = std::chrono::seconds(1);
    /// Time-out for the next pause of speech; a recording without pauses is cut off.
    static constexpr Nanoseconds longest_leaving = std::chrono::seconds(3);
    /// For a description that is heard: a recording lasts at most three minutes.
    static constexpr Nanoseconds longest_description = std::chrono::minutes(4);
    /// A visitor who comes after this time counts as another one, and is told everything again.
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
    MonotonicTime rests_from_; ///< rest before this does not count
    /// The next thing that rest leads to: 0 is the description, or the first hotspot if there is none.
    std::size_t leads_to_ = 0;
    std::optional<MonotonicTime> nobody_since_;
    bool next_waits_ = false; ///< a press that waits until the artifact is there
    bool describe_waits_ = false;

    std::size_t hotspot_ = 0;
    std::size_t portion_ = 0;
    bool reads_ = false;          ///< read, not heard
    MonotonicTime portion_since_; ///< since when the portion is read
    std::optional<MonotonicTime> leaving_since_;
    std::optional<MonotonicTime> over_since_; ///< when the description had been heard or read
};

} // namespace frustumscreen::exhibit

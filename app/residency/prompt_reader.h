/// Reads and decodes the recordings to be spoken, on a thread of its own, so that no frame waits for a file
/// or a decoder.
///
/// A recording is read when it is wanted, before it is spoken: a description as soon as its artifact is
/// shown, a spoken advice as soon as its sign is. Each use has one wanted recording, the newest; words are
/// read first. The cache holds the wanted description and the latest words.
///
/// Memory   96 kB for each second in the cache; a description of three minutes takes 17 MB while its artifact
///          is shown.
/// Threads  one caller, the render thread, which only waits with `Answer::Always`; one worker. A disk that
///          hangs blocks only the worker: its recording stays silent.
/// Errors   a recording that cannot be read or decoded is silent, and one line on standard error gives the
///          reason.
#pragma once

#include "firmware_host/base/file.h"
#include "firmware_host/sound/prompt.h"

#include <array>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace frustumscreen::residency {

/// A text that can be spoken: Ogg Opus in memory, or in a pack's file. Its address identifies it.
struct PromptRecording {
    std::string name; ///< for the message if it is silent
    Bytes opus;       ///< empty: it is in `pack`
    std::filesystem::path pack;
    std::string language;              ///< BCP 47
    std::string key;                   ///< as in pack_texts.h
    std::vector<Nanoseconds> portions; ///< reading time of each of its text; empty: it is one portion
    double gain_db = 0.0;              ///< at most 0: softer than recorded
};
using SharedRecording = std::shared_ptr<const PromptRecording>;

/// A decoded recording.
struct Reading {
    sound::SharedPrompt prompt;        ///< null: it is silent
    std::vector<Nanoseconds> portions; ///< start times
};
using SharedReading = std::shared_ptr<const Reading>;

enum class SpokenUse : std::uint8_t { Word, Description };

class PromptReader {
public:
    /// Always: the caller waits for the answer. For runs on a simulated clock, which must be repeatable.
    enum class Answer : std::uint8_t { WhenReady, Always };
    static constexpr std::size_t words_kept = 4;

    explicit PromptReader(Answer answer = Answer::WhenReady);

    /// Null: nothing is wanted for this use. Allocates nothing.
    void want(SpokenUse use, const SharedRecording& recording);
    /// Null: it is not read yet, or not wanted.
    [[nodiscard]] SharedReading find(const SharedRecording& recording);

private:
    struct Kept {
        SharedRecording recording;
        SharedReading reading;
        std::uint64_t wanted_at = 0;
    };

    void work(const std::stop_token& stop);
    /// A recording that is wanted and not in the cache; null if there is none.
    [[nodiscard]] SharedRecording next() const;
    [[nodiscard]] Kept* place_of(const SharedRecording& recording);
    void keep(const SharedRecording& recording, SharedReading reading);
    [[nodiscard]] SharedReading read(const PromptRecording& recording);

    Answer answer_;
    std::mutex mutex_; ///< guards all below; not held while reading or decoding
    std::condition_variable_any changed_;
    std::array<SharedRecording, 2> wanted_; ///< by SpokenUse
    std::array<Kept, words_kept + 1> kept_; ///< the last element is the description's
    std::uint64_t wants_ = 0;
    std::set<std::string> silent_; ///< used by the worker only: names already reported as silent
    std::jthread worker_;          ///< last, so that it is joined first
};

} // namespace frustumscreen::residency

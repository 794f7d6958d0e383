/// Reads and decodes what is to be spoken, on a thread of its own, so that no frame waits for a file or a decoder.
///
/// A recording is read when it is wanted, before it is spoken: a description as soon as its artifact is shown, a word of advice
/// as soon as its sign is. Of each use the newest want counts, words first. Kept are the description that is wanted, and the
/// words that were wanted last.
///
/// Memory   96 kB for each second that is kept; a description of three minutes takes 17 MB while its artifact is shown.
/// Threads  one caller, the render thread, which never waits unless `Answer::Always` asks for it; one worker. A disk that
///          hangs holds the worker alone: what it reads stays silent.
/// Errors   what cannot be read or decoded is silent, and one line on standard error says why.
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

namespace frustumscreen {

/// Something that can be spoken: Ogg Opus in memory, or in a pack's file. A recording is itself by its address.
struct PromptRecording {
    std::string name; ///< for the line that says why it is silent
    Bytes opus;       ///< none: it is in `pack`
    std::filesystem::path pack;
    std::string language;              ///< BCP 47
    std::string key;                   ///< as pack_texts.h has them
    std::vector<Nanoseconds> portions; ///< how long each of its text takes to read; none: it is one
    double gain_db = 0.0;              ///< 0 or less: softer than it was recorded
};
using SharedRecording = std::shared_ptr<const PromptRecording>;

/// A recording that was read.
struct Reading {
    SharedPrompt prompt;               ///< none: it is silent
    std::vector<Nanoseconds> portions; ///< when each begins
};
using SharedReading = std::shared_ptr<const Reading>;

enum class SpokenUse : std::uint8_t { Word, Description };

class PromptReader {
public:
    /// Always: who asks waits for the answer. For runs on a clock that is not the wall's, so that they are repeatable.
    enum class Answer : std::uint8_t { WhenReady, Always };
    static constexpr std::size_t words_kept = 4;

    explicit PromptReader(Answer answer = Answer::WhenReady);

    /// None: nothing is wanted for this use. Allocates nothing.
    void want(SpokenUse use, const SharedRecording& recording);
    /// None: it is not read yet, or not wanted.
    [[nodiscard]] SharedReading find(const SharedRecording& recording);

private:
    struct Kept {
        SharedRecording recording;
        SharedReading reading;
        std::uint64_t wanted_at = 0;
    };

    void work(const std::stop_token& stop);
    /// What is wanted and not kept; none: nothing.
    [[nodiscard]] SharedRecording next() const;
    [[nodiscard]] Kept* place_of(const SharedRecording& recording);
    void keep(const SharedRecording& recording, SharedReading reading);
    [[nodiscard]] SharedReading read(const PromptRecording& recording);

    Answer answer_;
    std::mutex mutex_; ///< for all below; nothing is read or decoded under it
    std::condition_variable_any changed_;
    std::array<SharedRecording, 2> wanted_; ///< by SpokenUse
    std::array<Kept, words_kept + 1> kept_; ///< the last place is the description's
    std::uint64_t wants_ = 0;
    std::set<std::string> silent_; ///< the worker's own: what was said to be silent
    std::jthread worker_;          ///< last, so that it ends first
};

} // namespace frustumscreen

/// What is to be heard, as a value: the exhibit changes it and hands it to a `Sound` in every frame. Nothing in
/// it is a message that could be lost or pile up; of several prompts between two frames the last one counts.
///
/// Units    decibels; 0 dB plays a recording as it is, -60 dB and less are silence, 12 dB is the most.
/// Threads  a value; any. Allocates nothing.
#pragma once

#include "firmware_host/sound/prompt.h"

namespace frustumscreen {

class SoundWish {
public:
    /// Speaks `prompt` as soon as the one that is spoken was left at its next mark, at once if there is none.
    /// It replaces one that still waits. Returns its number; numbers ascend from 1.
    std::uint64_t say(SharedPrompt prompt);
    /// What is spoken ends at its next mark, and what waits is forgotten.
    void leave();
    /// What is spoken fades within milliseconds, wherever it is, and what waits is forgotten.
    void stop();
    /// The volume of everything.
    void set_gain_db(double gain_db) { gain_db_ = gain_db; }

    /// Nothing has changed since `other`.
    [[nodiscard]] bool operator==(const SoundWish& other) const = default;

private:
    friend class Mixer;
    std::uint64_t stops_ = 0;  ///< how often it was asked to
    std::uint64_t leaves_ = 0; ///< the same
    std::uint64_t number_ = 0; ///< of the latest prompt
    SharedPrompt prompt_;      ///< the latest, or none if it was left or stopped since
    double gain_db_ = 0.0;
};

} // namespace frustumscreen

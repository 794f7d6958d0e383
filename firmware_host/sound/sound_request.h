/// The requested speech as a value: the exhibit changes it and passes it to a `Sound` in every frame. It is a
/// state, not a message, so nothing can be lost or pile up; of several prompts between two frames the last
/// one counts.
///
/// Units    decibels; 0 dB plays a recording unchanged, -60 dB and less are silence, 12 dB is the maximum.
/// Threads  a value; any. Allocates nothing.
#pragma once

#include "firmware_host/sound/prompt.h"

namespace frustumscreen::sound {

class SoundRequest {
public:
    /// Speaks `prompt` after the current one has reached its next mark, at once without a current one.
    /// Replaces a waiting prompt. Returns its number; numbers ascend from 1.
    std::uint64_t say(SharedPrompt prompt);
    /// The current prompt ends at its next mark; a waiting one is dropped.
    void leave();
    /// The current prompt fades out within milliseconds, wherever it is; a waiting one is dropped.
    void stop();
    /// The overall volume.
    void set_gain_db(double gain_db) { gain_db_ = gain_db; }

    /// True if nothing has changed since `other`.
    [[nodiscard]] bool operator==(const SoundRequest& other) const = default;

private:
    friend class Mixer;
    std::uint64_t stops_ = 0;  ///< calls of `stop`
    std::uint64_t leaves_ = 0; ///< calls of `leave`
    std::uint64_t number_ = 0; ///< of the latest prompt
    SharedPrompt prompt_;      ///< the latest; none after a leave or stop
    double gain_db_ = 0.0;
};

} // namespace frustumscreen::sound

/// The exhibit's speech, through a loudspeaker or a replacement.
///
/// Time     a prompt advances as if heard even without a loudspeaker, so its caption can follow
///          `SoundReport`.
/// Threads  one caller; `poll` neither waits nor allocates.
/// Errors   none; `state` describes them.
#pragma once

#include "firmware_host/base/device_state.h"
#include "firmware_host/base/time.h"
#include "firmware_host/sound/sound_request.h"

#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen::sound {

struct SoundReport {
    std::uint64_t number = 0;    ///< of the spoken prompt; 0: none
    Nanoseconds heard{0};        ///< length of the part heard so far
    Nanoseconds length{0};       ///< of the whole prompt
    std::uint64_t over = 0;      ///< prompts up to this number are over: heard, left, stopped or replaced
    bool audible = false;        ///< a loudspeaker is there, or a file
    std::uint64_t underruns = 0; ///< times that the device ran out of samples
    std::uint64_t losses = 0;    ///< times that the device was lost

    [[nodiscard]] bool operator==(const SoundReport&) const = default;
};

class Sound {
public:
    virtual ~Sound() = default;
    /// The request takes effect at `now`; returns what is heard.
    virtual SoundReport poll(MonotonicTime now, const SoundRequest& request) = 0;
    [[nodiscard]] virtual std::string name() const = 0;
    /// The device's state in one plain sentence, valid until the next `poll`; empty if there is nothing to
    /// report.
    [[nodiscard]] virtual std::string_view state() const { return {}; }
    /// Whether the device that the settings ask for can be used; its id is that of the sentence that `state` says.
    [[nodiscard]] virtual DeviceCondition condition() const { return {}; }
    /// Time until which the device's thread has promised a sign of life; nullopt: there is no such thread.
    [[nodiscard]] virtual std::optional<MonotonicTime> alive_until() const { return {}; }
};

} // namespace frustumscreen::sound

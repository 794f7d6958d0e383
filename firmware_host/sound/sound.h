/// What the exhibit says aloud, through a loudspeaker or something that stands in for one.
///
/// Time     a prompt goes on as if it was heard even while no loudspeaker is there, so that its caption may
///          follow `SoundReport`.
/// Threads  one caller; `poll` waits for nothing and allocates nothing.
/// Errors   none; `state` says what is the matter.
#pragma once

#include "firmware_host/base/device_state.h"
#include "firmware_host/base/time.h"
#include "firmware_host/sound/sound_wish.h"

#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen {

struct SoundReport {
    std::uint64_t number = 0;    ///< of the prompt that is spoken; 0: none
    Nanoseconds heard{0};        ///< how much of it was heard
    Nanoseconds length{0};       ///< of all of it
    std::uint64_t over = 0;      ///< prompts up to this number are over: heard, left, stopped or replaced
    bool audible = false;        ///< there is a loudspeaker, or a file
    std::uint64_t underruns = 0; ///< how often the device had nothing to play
    std::uint64_t losses = 0;    ///< how often the device was lost

    [[nodiscard]] bool operator==(const SoundReport&) const = default;
};

class Sound {
public:
    virtual ~Sound() = default;
    /// What is to be heard from `now` on; returns what is heard.
    virtual SoundReport poll(MonotonicTime now, const SoundWish& wish) = 0;
    [[nodiscard]] virtual std::string name() const = 0;
    /// The device's state in one plain sentence, valid until the next `poll`; empty: there is nothing to say.
    [[nodiscard]] virtual std::string_view state() const { return {}; }
    /// Whether the device that the settings ask for can be used; its id is that of the sentence that `state` says.
    [[nodiscard]] virtual DeviceCondition condition() const { return {}; }
    /// Until when its thread has promised to be heard from again; nothing: it has none.
    [[nodiscard]] virtual std::optional<MonotonicTime> alive_until() const { return {}; }
};

} // namespace frustumscreen

/// What `DeviceSound` needs of a sound device: a queue of samples that it plays at 48 kHz.
///
/// Errors   DeviceLost, one sentence: it must be opened again. An underrun is no error.
/// Threads  one caller. Only opening and closing may take long.
#pragma once

#include "firmware_host/base/device_state.h"
#include "firmware_host/base/result.h"
#include "firmware_host/sound/prompt.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace frustumscreen {

class PcmDevice {
public:
    virtual ~PcmDevice() = default;
    /// How many samples it takes now. Goes on after an underrun, and counts it.
    [[nodiscard]] virtual Result<std::size_t> room() = 0;
    /// Takes `samples`, at most as many as there was room for.
    [[nodiscard]] virtual Result<void> write(std::span<const std::int16_t> samples) = 0;
    /// Samples that wait in it since the last `room` and `write`.
    [[nodiscard]] virtual std::size_t queued() const = 0;
    /// Until there may be room, or `longest` has passed.
    virtual void wait(Nanoseconds longest) = 0;
    [[nodiscard]] virtual std::uint64_t underruns() const = 0;
    [[nodiscard]] virtual DeviceState state() const = 0;
};

using OpenPcm = std::function<Result<std::unique_ptr<PcmDevice>>()>;

/// A sound device of ALSA by its name: "default", "plughw:0,0", or any other that `aplay -L` lists.
///
/// Mute     a card that is muted by its own controls is woken (alsa_controls.h).
/// Delay    periods of 10 ms, and at most `longest_queue` in the device: what is written is heard within it.
///          Where a device wants longer periods, two of them wait, and `state` says how long that is.
[[nodiscard]] Result<std::unique_ptr<PcmDevice>> open_alsa(const std::string& name);

inline constexpr Nanoseconds longest_queue = std::chrono::milliseconds(50);

} // namespace frustumscreen

/// The interface of `DeviceSound` to a sound device: a queue of samples that it plays at 48 kHz.
///
/// Errors   DeviceLost, one sentence: the device must be opened again. An underrun is not an error.
/// Threads  one caller. Only opening and closing may take long.
#pragma once

#include "firmware_host/base/device_state.h"
#include "firmware_host/base/result.h"
#include "firmware_host/sound/prompt.h"

#include <functional>
#include <memory>
#include <span>
#include <string>

namespace frustumscreen::sound {

class PcmDevice {
public:
    virtual ~PcmDevice() = default;
    /// Number of samples that it accepts now. Recovers from an underrun, and counts it.
    [[nodiscard]] virtual Result<std::size_t> free_samples() = 0;
    /// Takes `samples`, at most as many as `free_samples` returned.
    [[nodiscard]] virtual Result<void> write(std::span<const std::int16_t> samples) = 0;
    /// Samples in its queue, as of the last `free_samples` and `write`.
    [[nodiscard]] virtual std::size_t queued() const = 0;
    /// Waits until there may be space, or `longest` has passed.
    virtual void wait(Nanoseconds longest) = 0;
    [[nodiscard]] virtual std::uint64_t underruns() const = 0;
    [[nodiscard]] virtual DeviceState state() const = 0;
};

using OpenPcm = std::function<Result<std::unique_ptr<PcmDevice>>()>;

/// Opens a sound device of ALSA by its name: "default", "plughw:0,0", or any other that `aplay -L` lists.
///
/// Mute     a card that is muted by its own controls is unmuted (alsa_controls.h).
/// Delay    periods of 10 ms, and at most `longest_queue` in the device: written samples are heard within
///          that time. If a device requires longer periods, two of them are queued, and `state` gives the
///          delay.
[[nodiscard]] Result<std::unique_ptr<PcmDevice>> open_alsa(const std::string& name);

inline constexpr Nanoseconds longest_queue = std::chrono::milliseconds(50);

} // namespace frustumscreen::sound

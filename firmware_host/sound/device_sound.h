/// A sound through a real device. Its own thread mixes and writes samples; it searches for a missing or lost
/// device until it is back, and keeps time meanwhile.
///
/// Delay    speech begins within 150 ms of the `poll` that first requests it: up to 10 ms until the thread
///          looks, up to 60 ms of breath if another prompt has just ended, 50 ms in the device's queue
///          (`longest_queue`); the rest is for a late thread and for amplifiers.
/// Threads  `poll`, `state`: one caller. They never wait, whatever the device does; if the other side holds a
///          lock, the next `poll` transfers the values.
/// Clock    the device's. A device that takes samples faster than a clock could is throttled.
#pragma once

#include "firmware_host/base/heartbeat.h"
#include "firmware_host/base/latest.h"
#include "firmware_host/sound/mixer.h"
#include "firmware_host/sound/pcm_device.h"
#include "firmware_host/sound/sample_clock.h"
#include "firmware_host/sound/sound.h"

#include <stop_token>
#include <thread>

namespace frustumscreen::sound {

class DeviceSound final : public Sound {
public:
    /// Longest opening or closing: a USB device that does not answer costs 5 s per transfer, until the kernel
    /// gives up, and opening takes several transfers.
    static constexpr Nanoseconds longest_round = std::chrono::seconds(60);

    explicit DeviceSound(OpenPcm open);

    SoundReport poll(MonotonicTime now, const SoundRequest& request) override;
    [[nodiscard]] std::string name() const override { return "device"; }
    [[nodiscard]] std::string_view state() const override { return state_.sentence.view(); }
    [[nodiscard]] DeviceCondition condition() const override { return state_.condition; }
    [[nodiscard]] std::optional<MonotonicTime> alive_until() const override {
        return heartbeat_.promised_until();
    }

private:
    void run(const std::stop_token& stop);
    /// Plays until the device is lost, and returns that error, or until `stop` is requested.
    [[nodiscard]] Error play(PcmDevice& device, const std::stop_token& stop);
    /// Keeps time without a device.
    void pause(Nanoseconds length, const std::stop_token& stop);
    void go_on_silently();
    void follow_request();
    void report(Nanoseconds queued, bool audible);

    OpenPcm open_;
    // Shared between the threads:
    Latest<SoundRequest> requests_;
    Latest<SoundReport> reports_;
    Latest<DeviceState> said_;
    Heartbeat heartbeat_{monotonic_now() + longest_round};
    // Used by the caller:
    SoundRequest requested_; ///< the latest one handed over
    SoundReport report_;
    DeviceState state_{{DeviceHealth::Away, "sound.not_opened"},
                       Sentence("its sound device is not opened yet")};
    // Used by the thread:
    Mixer mixer_;
    SampleClock clock_{monotonic_now()}; ///< used while there is no device
    std::uint64_t underruns_ = 0;        ///< of all devices
    std::uint64_t losses_ = 0;
    std::jthread thread_; ///< last: it uses all members above
};

} // namespace frustumscreen::sound

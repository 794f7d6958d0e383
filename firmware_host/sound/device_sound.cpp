#include "firmware_host/sound/device_sound.h"

#include "firmware_host/base/device_thread.h"

#include <algorithm>

namespace frustumscreen::sound {

namespace {

using std::chrono::milliseconds;

constexpr Nanoseconds look_again = std::chrono::seconds(1);
/// Opening a device blocks the time of a spoken prompt, so a device that takes long to fail is tried less
/// often.
constexpr int pauses_for_each_look = 10;
constexpr Nanoseconds round = milliseconds(10);
constexpr Nanoseconds stalls_after = milliseconds(500);
/// A longer round says nothing about the device: its thread stood still, and found a queue that it had just filled.
constexpr Nanoseconds longest_counted_round = 5 * round;

/// Limits a device to the clock: 2 % more than real time, plus a small burst. ALSA's 'null' device accepts
/// any number of samples at once.
class Allowance {
public:
    explicit Allowance(MonotonicTime now) : then_(now) {}

    [[nodiscard]] std::size_t samples(MonotonicTime now) {
        left_ = std::min(left_ + (now - then_) + (now - then_) / 50, most);
        then_ = now;
        return static_cast<std::size_t>(samples_in(left_));
    }
    void use(std::size_t samples) { left_ -= duration_of(samples); }

private:
    static constexpr Nanoseconds most = 2 * longest_queue;
    MonotonicTime then_;
    Nanoseconds left_ = most;
};

} // namespace

DeviceSound::DeviceSound(OpenPcm open)
    : open_(std::move(open)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

SoundReport DeviceSound::poll(MonotonicTime /*now*/, const SoundRequest& request) {
    if (request != requested_ && requests_.try_put(request)) {
        requested_ = request;
    }
    if (SoundReport latest; reports_.try_take(latest)) {
        report_ = latest;
    }
    static_cast<void>(said_.try_take(state_));
    return report_;
}

void DeviceSound::run(const std::stop_token& stop) {
    begin_device_thread("sound");
    while (!stop.stop_requested()) {
        heartbeat_.promise(monotonic_now() + longest_round);
        const MonotonicTime began = monotonic_now();
        Result<std::unique_ptr<PcmDevice>> device = open_();
        const Nanoseconds took = monotonic_now() - began;
        go_on_silently();
        if (device) {
            said_.put((*device)->state());
            const Error lost = play(**device, stop);
            clock_ = SampleClock(monotonic_now());
            ++losses_;
            said_.put(away(lost));
        } else {
            said_.put(away(device.error()));
        }
        device = {}; // close it before the next attempt
        pause(std::max(look_again, pauses_for_each_look * took), stop);
    }
}

Error DeviceSound::play(PcmDevice& device, const std::stop_token& stop) {
    const std::uint64_t underruns_before = underruns_;
    MonotonicTime before = monotonic_now();
    Nanoseconds stalled{0}; ///< since the device last had space
    Allowance allowance(before);
    while (!stop.stop_requested()) {
        const MonotonicTime now = monotonic_now();
        heartbeat_.promise(now + longest_round);
        follow_request();
        const Result<std::size_t> free = device.free_samples();
        if (!free) {
            return free.error();
        }
        const std::size_t allowed = allowance.samples(now);
        Result<void> written;
        mix_in_blocks(mixer_, std::min(*free, allowed), [&](std::span<const std::int16_t> block) {
            written = written ? device.write(block) : written;
        });
        if (!written) {
            return written.error();
        }
        allowance.use(std::min(*free, allowed));
        stalled += std::min<Nanoseconds>(now - before, longest_counted_round);
        stalled = *free > 0 ? Nanoseconds(0) : stalled;
        before = now;
        if (stalled > stalls_after) {
            return Error{ErrorKind::DeviceLost, "sound.stalled",
                         "the sound device takes no more samples; it is opened again"};
        }
        underruns_ = underruns_before + device.underruns();
        report(duration_of(device.queued()), true);
        if (*free > allowed) {
            std::this_thread::sleep_for(round);
        } else {
            device.wait(round);
        }
    }
    return Error{ErrorKind::DeviceLost, "sound.ended", {}};
}

void DeviceSound::pause(Nanoseconds length, const std::stop_token& stop) {
    const MonotonicTime end = monotonic_now() + length;
    while (!stop.stop_requested() && monotonic_now() < end) {
        heartbeat_.promise(monotonic_now() + longest_round);
        go_on_silently();
        sleep_until_stop(stop, round);
    }
}

void DeviceSound::go_on_silently() {
    mix_in_blocks(mixer_, clock_.take_due(monotonic_now()), [](std::span<const std::int16_t>) {});
    follow_request();
    report(Nanoseconds(0), false);
}

void DeviceSound::follow_request() {
    if (SoundRequest request; requests_.take(request)) {
        mixer_.follow(request);
    }
}

void DeviceSound::report(Nanoseconds queued, bool audible) {
    SoundReport report = mixer_.report(queued);
    report.audible = audible;
    report.underruns = underruns_;
    report.losses = losses_;
    reports_.put(report);
}

} // namespace frustumscreen::sound

#include "firmware_host/base/format_sentence.h"
#include "firmware_host/sound/alsa_controls.h"
#include "firmware_host/sound/pcm_device.h"

#include <alsa/asoundlib.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <thread>

namespace frustumscreen::sound {

namespace {

constexpr unsigned period_us = 10'000;

struct ClosePcm {
    void operator()(snd_pcm_t* pcm) const { ::snd_pcm_close(pcm); }
};
using Pcm = std::unique_ptr<snd_pcm_t, ClosePcm>;

struct FreeHardware {
    void operator()(snd_pcm_hw_params_t* params) const { ::snd_pcm_hw_params_free(params); }
};
struct FreeSoftware {
    void operator()(snd_pcm_sw_params_t* params) const { ::snd_pcm_sw_params_free(params); }
};
struct FreeInfo {
    void operator()(snd_pcm_info_t* info) const { ::snd_pcm_info_free(info); }
};

/// The settings of an open device.
struct SetUp {
    unsigned channels = 0;
    snd_pcm_uframes_t period = 0;
    snd_pcm_uframes_t buffer = 0; ///< capacity of the device
    snd_pcm_uframes_t queue = 0;  ///< limit of queued samples
};

std::string reason(int error) {
    switch (error) {
    case -ENOENT:
    case -ENODEV:
    case -ENXIO:
        return "it is not there; is it plugged in, and its driver loaded? 'aplay -L' lists the names";
    case -EACCES:
    case -EPERM:
        return "no permission; put the exhibit's user into the group audio";
    case -EBUSY:
        return "another program holds it; end that program";
    case -EINVAL:
        return "it does not take 16-bit samples at 48 kHz; a name that begins with plughw: converts them";
    default:
        return ::snd_strerror(error);
    }
}

tl::unexpected<Error> lost(const std::string& name, int error) {
    return fail(ErrorKind::DeviceLost, "sound.device", "sound device {}: {}", name, reason(error));
}

/// The first error of a chain of calls.
class Calls {
public:
    template <typename Call> Calls& then(const Call& call) {
        error_ = error_ < 0 ? error_ : call();
        return *this;
    }
    [[nodiscard]] int error() const { return error_ < 0 ? error_ : 0; }

private:
    int error_ = 0;
};

int set_hardware(snd_pcm_t* pcm, SetUp& set_up) {
    snd_pcm_hw_params_t* raw = nullptr;
    if (const int error = ::snd_pcm_hw_params_malloc(&raw); error < 0) {
        return error;
    }
    const std::unique_ptr<snd_pcm_hw_params_t, FreeHardware> params(raw);
    unsigned period = period_us;
    unsigned buffer = std::chrono::duration_cast<std::chrono::microseconds>(longest_queue).count();
    set_up.channels = 2; // most cards have no mono
    return Calls()
        .then([&] { return ::snd_pcm_hw_params_any(pcm, raw); })
        .then([&] { return ::snd_pcm_hw_params_set_access(pcm, raw, SND_PCM_ACCESS_RW_INTERLEAVED); })
        .then([&] { return ::snd_pcm_hw_params_set_format(pcm, raw, SND_PCM_FORMAT_S16_LE); })
        .then([&] { return ::snd_pcm_hw_params_set_channels_near(pcm, raw, &set_up.channels); })
        .then([&] { return ::snd_pcm_hw_params_set_rate(pcm, raw, sample_rate_hz, 0); })
        .then([&] { return ::snd_pcm_hw_params_set_period_time_near(pcm, raw, &period, nullptr); })
        .then([&] { return ::snd_pcm_hw_params_set_buffer_time_near(pcm, raw, &buffer, nullptr); })
        .then([&] { return ::snd_pcm_hw_params(pcm, raw); })
        .then([&] { return ::snd_pcm_hw_params_get_period_size(raw, &set_up.period, nullptr); })
        .then([&] { return ::snd_pcm_hw_params_get_buffer_size(raw, &set_up.buffer); })
        .error();
}

int set_software(snd_pcm_t* pcm, const SetUp& set_up) {
    snd_pcm_sw_params_t* raw = nullptr;
    if (const int error = ::snd_pcm_sw_params_malloc(&raw); error < 0) {
        return error;
    }
    const std::unique_ptr<snd_pcm_sw_params_t, FreeSoftware> params(raw);
    // Playback starts when the queue is full; the device wakes us when the queue has space for a period. The
    // device's own buffer may be longer than the queue.
    const snd_pcm_uframes_t wake_at = std::min(set_up.buffer - set_up.queue + set_up.period, set_up.buffer);
    return Calls()
        .then([&] { return ::snd_pcm_sw_params_current(pcm, raw); })
        .then([&] { return ::snd_pcm_sw_params_set_avail_min(pcm, raw, wake_at); })
        .then([&] { return ::snd_pcm_sw_params_set_start_threshold(pcm, raw, set_up.queue); })
        .then([&] { return ::snd_pcm_sw_params(pcm, raw); })
        .error();
}

class AlsaDevice final : public PcmDevice {
public:
    AlsaDevice(Pcm pcm, std::string name, const SetUp& set_up)
        : pcm_(std::move(pcm)), name_(std::move(name)), set_up_(set_up),
          frames_(set_up.queue * set_up.channels) {
        const double queue_ms = 1000.0 * static_cast<double>(set_up.queue) / sample_rate_hz;
        if (set_up.queue <= samples_in(longest_queue)) {
            state_ = {{DeviceHealth::Well, "sound.well"}, format_sentence("its sound goes to {}", name_)};
        } else {
            state_ = {{DeviceHealth::Impaired, "sound.late"},
                      format_sentence("its sound goes to {}, which queues {:.0f} ms: speech is late; another "
                                      "name for the same card may be quicker, 'aplay -L' lists them",
                                      name_, queue_ms)};
        }
    }

    [[nodiscard]] Result<std::size_t> free_samples() override {
        snd_pcm_sframes_t free = ::snd_pcm_avail(pcm_.get());
        if (free >= 0 && ::snd_pcm_state(pcm_.get()) == SND_PCM_STATE_SUSPENDED) {
            free = -ESTRPIPE; // a plugin with a full queue does not report it by itself
        }
        if (free < 0) {
            if (const int error = recover(static_cast<int>(free)); error < 0) {
                return lost(name_, error);
            }
            free = std::max<snd_pcm_sframes_t>(::snd_pcm_avail(pcm_.get()), 0);
        }
        const snd_pcm_uframes_t held =
            set_up_.buffer - std::min(static_cast<snd_pcm_uframes_t>(free), set_up_.buffer);
        queued_ = held;
        return set_up_.queue - std::min(held, set_up_.queue);
    }

    [[nodiscard]] Result<void> write(std::span<const std::int16_t> samples) override {
        const std::size_t channels = set_up_.channels;
        for (std::size_t k = 0; k < samples.size() * channels; ++k) {
            frames_[k] = samples[k / channels];
        }
        std::size_t done = 0;
        while (done < samples.size()) {
            const snd_pcm_sframes_t taken =
                ::snd_pcm_writei(pcm_.get(), &frames_[done * channels], samples.size() - done);
            if (taken == -EAGAIN) { // accepted less than announced: drop the rest
                break;
            }
            if (taken < 0) {
                if (const int error = recover(static_cast<int>(taken)); error < 0) {
                    return lost(name_, error);
                }
                break;
            }
            done += static_cast<std::size_t>(taken);
        }
        queued_ += done;
        return {};
    }

    [[nodiscard]] std::size_t queued() const override { return queued_; }

    void wait(Nanoseconds longest) override {
        const auto ms = std::chrono::ceil<std::chrono::milliseconds>(longest);
        if (::snd_pcm_wait(pcm_.get(), static_cast<int>(ms.count())) < 0) {
            std::this_thread::sleep_for(longest); // `free_samples` reports the error
        }
    }

    [[nodiscard]] std::uint64_t underruns() const override { return underruns_; }
    [[nodiscard]] DeviceState state() const override { return state_; }

private:
    /// Recovers from an underrun or a suspension of the machine; negative: the device is lost.
    [[nodiscard]] int recover(int error) {
        switch (error) {
        case -EPIPE:
            ++underruns_;
            return ::snd_pcm_prepare(pcm_.get());
        case -ESTRPIPE: {
            const int resumed = ::snd_pcm_resume(pcm_.get());
            return resumed == -EAGAIN ? 0 : resumed < 0 ? ::snd_pcm_prepare(pcm_.get()) : 0;
        }
        case -EAGAIN:
        case -EINTR:
            return 0;
        default:
            return error;
        }
    }

    Pcm pcm_;
    std::string name_;
    SetUp set_up_;
    std::vector<std::int16_t> frames_; ///< of all channels
    std::size_t queued_ = 0;
    std::uint64_t underruns_ = 0;
    DeviceState state_;
};

/// Number of the card that finally plays; -1: none.
int card_of(snd_pcm_t* pcm) {
    snd_pcm_info_t* raw = nullptr;
    if (::snd_pcm_info_malloc(&raw) < 0) {
        return -1;
    }
    const std::unique_ptr<snd_pcm_info_t, FreeInfo> info(raw);
    return ::snd_pcm_info(pcm, raw) < 0 ? -1 : ::snd_pcm_info_get_card(raw);
}

void say_nothing(const char*, int, const char*, int, const char*, ...) {}

} // namespace

Result<std::unique_ptr<PcmDevice>> open_alsa(const std::string& name) {
    ::snd_lib_error_set_handler(say_nothing); // the state reports errors, not standard error
    snd_pcm_t* raw = nullptr;
    if (const int error = ::snd_pcm_open(&raw, name.c_str(), SND_PCM_STREAM_PLAYBACK, SND_PCM_NONBLOCK);
        error < 0) {
        return lost(name, error);
    }
    Pcm pcm(raw);
    SetUp set_up;
    if (const int error = set_hardware(raw, set_up); error < 0) {
        return lost(name, error);
    }
    const snd_pcm_uframes_t wanted =
        std::max<snd_pcm_uframes_t>(samples_in(longest_queue), 2 * set_up.period);
    set_up.queue = std::min(set_up.buffer, wanted);
    if (const int error = set_software(raw, set_up); error < 0) {
        return lost(name, error);
    }
    wake_controls(card_of(raw));
    return std::make_unique<AlsaDevice>(std::move(pcm), name, set_up);
}

} // namespace frustumscreen::sound

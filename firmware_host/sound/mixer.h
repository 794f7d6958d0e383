/// Makes samples of a SoundRequest: one prompt after the other, at the requested volume.
///
/// Units    samples of 1/48,000 s, mono, 16-bit. The output does not depend on the block sizes.
/// Clicks   every start, end and change is a smooth step x^2 (3 - 2 x), or a straight ramp of the volume:
///          between two samples a fade changes by at most 1.5 / its length.
/// Loudness the output is linear up to `linear_up_to`, and bends smoothly below full scale above it. A prompt
///          of -2 dBTP (the bake's) at 0 dB is unchanged bit by bit.
/// Threads  a value; one caller. Allocates nothing.
#pragma once

#include "firmware_host/sound/sound.h"

#include <algorithm>
#include <array>
#include <span>

namespace frustumscreen::sound {

/// Approaches its goal by steps of bounded size.
class Ramp {
public:
    constexpr Ramp(float value, std::uint32_t samples_from_0_to_1)
        : value_(value), step_(1.0F / static_cast<float>(samples_from_0_to_1)) {}
    float next(float goal);

private:
    float value_;
    float step_;
};

class Mixer {
public:
    static constexpr std::uint32_t fade_samples = sample_rate_hz / 200; ///< 5 ms: both ends of a prompt
    /// Silence between a prompt that ended, or was left, and the next one.
    static constexpr std::uint32_t breath_samples = sample_rate_hz * 60 / 1000;
    static constexpr std::uint32_t gain_samples = sample_rate_hz / 2; ///< for the volume from 0 to 1
    static constexpr float linear_up_to = 0.8F;

    /// The request from the next sample on.
    void follow(const SoundRequest& request);
    void mix(std::span<std::int16_t> samples);
    /// `queued`: duration of the mixed samples that are not heard yet.
    [[nodiscard]] SoundReport report(Nanoseconds queued) const;

private:
    struct Numbered {
        SharedPrompt prompt;
        std::uint64_t number = 0;
    };

    [[nodiscard]] float next_of_speech();
    void end_speech();
    [[nodiscard]] bool may_leave_here();

    bool begun_ = false;   ///< before the first sample the volume changes without a ramp
    SoundRequest request_; ///< without its prompt
    Numbered spoken_;
    Numbered waiting_;
    std::uint32_t position_ = 0;                 ///< next sample of `spoken_`
    std::size_t mark_ = 0;                       ///< first mark that is not behind `position_`
    bool leaving_ = false;                       ///< `spoken_` ends at the next mark
    std::uint32_t fade_left_ = 0;                ///< samples until its early end; 0: no early end
    std::uint32_t breath_ = 0;                   ///< samples until the next prompt may begin
    std::uint32_t next_breath_ = breath_samples; ///< breath after the spoken prompt; 0 after a stop
    float gain_goal_ = 1.0F;
    Ramp gain_{1.0F, gain_samples};
};

/// Mixes `count` samples and passes them to `take(std::span<const std::int16_t>)` in blocks of at most 10 ms.
template <typename Take> void mix_in_blocks(Mixer& mixer, std::uint64_t count, const Take& take) {
    std::array<std::int16_t, sample_rate_hz / 100> block; // written before it is read
    while (count > 0) {
        const std::span<std::int16_t> part(block.data(), std::min<std::uint64_t>(block.size(), count));
        mixer.mix(part);
        take(std::span<const std::int16_t>(part));
        count -= part.size();
    }
}

/// The amplitude of `gain_db`, within the limits of sound_request.h.
[[nodiscard]] float amplitude_of(double gain_db);
/// Returns x up to `Mixer::linear_up_to`, and bends it above so that it stays below 1; odd, rising, with a
/// slope of at most 1.
[[nodiscard]] float soft_limit(float x);

} // namespace frustumscreen::sound

/// Makes samples of what is wished: one prompt after the other, at the volume that is wished.
///
/// Units    samples of 1/48,000 s, mono, 16-bit. How they are asked for in blocks changes none of them.
/// Clicks   whatever begins, ends or changes does so by a smooth step x^2 (3 - 2 x), or a straight ramp of the
///          volume: between two samples no fade moves by more than 1.5 / its length.
/// Loudness what comes out stays as it is up to `linear_up_to`, and bends smoothly below full scale from there
///          on. A prompt of -2 dBTP (the bake's) and 0 dB comes out bit by bit as it was.
/// Threads  a value; one caller. Allocates nothing.
#pragma once

#include "firmware_host/sound/sound.h"

#include <algorithm>
#include <array>
#include <span>

namespace frustumscreen {

/// Goes to its goal by a bounded step.
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
    static constexpr std::uint32_t fade_samples = sample_rate_hz / 200; ///< 5 ms: begin and end of a prompt
    /// A breath between a prompt that ended, or was left, and the next.
    static constexpr std::uint32_t breath_samples = sample_rate_hz * 60 / 1000;
    static constexpr std::uint32_t gain_samples = sample_rate_hz / 2; ///< for the volume to go from 0 to 1
    static constexpr float linear_up_to = 0.8F;

    /// What is to be heard from the next sample on.
    void follow(const SoundWish& wish);
    void mix(std::span<std::int16_t> samples);
    /// `queued`: how long what was mixed last is still to be heard.
    [[nodiscard]] SoundReport report(Nanoseconds queued) const;

private:
    struct Numbered {
        SharedPrompt prompt;
        std::uint64_t number = 0;
    };

    [[nodiscard]] float next_of_speech();
    void end_speech();
    [[nodiscard]] bool may_leave_here();

    bool begun_ = false; ///< before, the volume is simply set
    SoundWish wish_;     ///< without its prompt
    Numbered spoken_;
    Numbered waiting_;
    std::uint32_t position_ = 0;                 ///< the next sample of `spoken_`
    std::size_t mark_ = 0;                       ///< its first mark that does not lie behind
    bool leaving_ = false;                       ///< it ends at the next mark
    std::uint32_t fade_left_ = 0;                ///< samples until its early end; 0: it is not ending early
    std::uint32_t breath_ = 0;                   ///< samples until the next prompt may begin
    std::uint32_t next_breath_ = breath_samples; ///< after the one that is spoken; none where it was stopped
    float gain_goal_ = 1.0F;
    Ramp gain_{1.0F, gain_samples};
};

/// Mixes `count` samples and hands them to `take(std::span<const std::int16_t>)` in blocks of 10 ms at most.
template <typename Take> void mix_in_blocks(Mixer& mixer, std::uint64_t count, const Take& take) {
    std::array<std::int16_t, sample_rate_hz / 100> block; // written before it is read
    while (count > 0) {
        const std::span<std::int16_t> part(block.data(), std::min<std::uint64_t>(block.size(), count));
        mixer.mix(part);
        take(std::span<const std::int16_t>(part));
        count -= part.size();
    }
}

/// The amplitude of `gain_db`, within the limits of sound_wish.h.
[[nodiscard]] float amplitude_of(double gain_db);
/// x as it is up to `Mixer::linear_up_to`, then bent so that it stays below 1; odd, rising, with a slope of at
/// most 1.
[[nodiscard]] float soft_limit(float x);

} // namespace frustumscreen

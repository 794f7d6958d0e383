#include "app/show/test_tone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::show {

sound::SharedPrompt test_tone() {
    constexpr double notes_hz[] = {500.0, 1000.0, 2000.0};
    constexpr std::size_t note_samples = sound::sample_rate_hz * 2 / 5,
                          fade_samples = sound::sample_rate_hz / 50;
    constexpr double amplitude = 0.1; // a sine of 1 kHz and -20 dBFS has -23 LUFS (ITU-R BS.1770)
    auto tone = std::make_shared<sound::Prompt>();
    tone->samples.reserve(std::size(notes_hz) * note_samples);
    for (const double hz : notes_hz) {
        for (std::size_t k = 0; k < note_samples; ++k) {
            const double to_edge = static_cast<double>(std::min(k, note_samples - 1 - k));
            const double fade = std::min(1.0, to_edge / static_cast<double>(fade_samples));
            const double wave =
                std::sin(2.0 * std::numbers::pi * hz * static_cast<double>(k) / sound::sample_rate_hz);
            tone->samples.push_back(
                static_cast<std::int16_t>(std::lround(32767.0 * amplitude * fade * wave)));
        }
    }
    return tone;
}

} // namespace frustumscreen::show

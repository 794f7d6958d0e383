#include "firmware_host/sound/pauses.h"

#include "firmware_host/sound/mixer.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace frustumscreen::sound {

namespace {

constexpr std::size_t frame = sample_rate_hz / 100;
constexpr std::uint32_t after_begin = 2 * frame;
constexpr std::uint32_t before_end = frame + Mixer::fade_samples;

double sum_of_squares(std::span<const std::int16_t> samples) {
    return std::transform_reduce(samples.begin(), samples.end(), 0.0, std::plus<>(), [](std::int16_t s) {
        return static_cast<double>(s) * s / (32768.0 * 32768.0);
    });
}

double power(double decibels) {
    return std::pow(10.0, decibels / 10.0);
}

} // namespace

std::vector<Mark> find_pauses(std::span<const std::int16_t> samples, const PauseLimits& limits) {
    std::vector<Mark> marks;
    if (samples.empty()) {
        return marks;
    }
    const double mean = sum_of_squares(samples) / static_cast<double>(samples.size());
    const double quiet = std::max(mean * power(-limits.below_mean_db), power(limits.always_quiet_db));
    const std::size_t shortest =
        std::max<std::size_t>(samples_in(limits.shortest), after_begin + before_end + 1);
    std::size_t begin = 0; ///< of the current quiet stretch
    const auto end_stretch = [&](std::size_t end) {
        if (end - begin >= shortest) {
            marks.push_back({static_cast<std::uint32_t>(begin) + after_begin,
                             static_cast<std::uint32_t>(end) - before_end});
        }
    };
    for (std::size_t at = 0; at < samples.size(); at += frame) {
        const std::span<const std::int16_t> part = samples.subspan(at, std::min(frame, samples.size() - at));
        if (sum_of_squares(part) > quiet * static_cast<double>(part.size())) {
            end_stretch(at);
            begin = at + part.size();
        }
    }
    end_stretch(samples.size());
    return marks;
}

} // namespace frustumscreen::sound

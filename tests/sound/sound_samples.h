/// Prompts for tests, and properties of samples.
#pragma once

#include "firmware_host/sound/mixer.h"

#include <cmath>
#include <numbers>
#include <random>

namespace frustumscreen::testing {

template <typename Value>
sound::SharedPrompt prompt_of(std::size_t count, std::vector<sound::Mark> marks, Value&& value) {
    auto prompt = std::make_shared<sound::Prompt>();
    for (std::size_t k = 0; k < count; ++k) {
        prompt->samples.push_back(static_cast<std::int16_t>(value(k)));
    }
    prompt->marks = std::move(marks);
    return prompt;
}
/// A constant level, in which any change is a fade.
inline sound::SharedPrompt level(std::size_t count, int code, std::vector<sound::Mark> marks = {}) {
    auto prompt = std::make_shared<sound::Prompt>();
    prompt->samples.assign(count, static_cast<std::int16_t>(code));
    prompt->marks = std::move(marks);
    return prompt;
}
/// No two stretches of it are equal.
inline sound::SharedPrompt noise(std::size_t count, int loudest, unsigned seed,
                                 std::vector<sound::Mark> marks = {}) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> code(-loudest, loudest);
    return prompt_of(count, std::move(marks), [&](std::size_t) { return code(random); });
}

inline std::vector<std::int16_t> mixed(sound::Mixer& mixer, std::size_t count) {
    std::vector<std::int16_t> samples(count);
    mixer.mix(samples);
    return samples;
}
inline int largest_step(const std::vector<std::int16_t>& samples) {
    int largest = 0;
    for (std::size_t k = 1; k < samples.size(); ++k) {
        largest = std::max(largest, std::abs(samples[k] - samples[k - 1]));
    }
    return largest;
}
/// The first non-zero sample from `from` on; the end if there is none.
inline std::size_t first_heard(const std::vector<std::int16_t>& samples, std::size_t from = 0) {
    while (from < samples.size() && samples[from] == 0) {
        ++from;
    }
    return from;
}
inline std::size_t end_of_heard(const std::vector<std::int16_t>& samples) {
    std::size_t end = samples.size();
    while (end > 0 && samples[end - 1] == 0) {
        --end;
    }
    return end;
}

} // namespace frustumscreen::testing

/// A spoken text, decoded in advance.
///
/// Units    samples of 1/48,000 s, mono, 16-bit; 0x8000 is -1.
/// Threads  made once, then shared as `std::shared_ptr<const Prompt>`; the last owner frees it.
#pragma once

#include "firmware_host/base/time.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace frustumscreen::sound {

inline constexpr int sample_rate_hz = 48'000;

[[nodiscard]] constexpr Nanoseconds duration_of(std::uint64_t samples) {
    return Nanoseconds(static_cast<std::int64_t>(samples / sample_rate_hz * 1'000'000'000 +
                                                 samples % sample_rate_hz * 1'000'000'000 / sample_rate_hz));
}
/// Whole samples, rounded down.
[[nodiscard]] constexpr std::uint64_t samples_in(Nanoseconds duration) {
    const auto ns = static_cast<std::uint64_t>(duration.count());
    return ns / 1'000'000'000 * sample_rate_hz + ns % 1'000'000'000 * sample_rate_hz / 1'000'000'000;
}

/// A pause between words or sentences at which a recording may be left: a fade of `Mixer::fade_samples` may
/// begin at any sample from `begin` to `end`, both included.
struct Mark {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    [[nodiscard]] bool operator==(const Mark&) const = default;
};

struct Prompt {
    std::vector<std::int16_t> samples;
    std::vector<Mark> marks; ///< ascending, disjoint; without marks it is played to its end
};
using SharedPrompt = std::shared_ptr<const Prompt>;

} // namespace frustumscreen::sound

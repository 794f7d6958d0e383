/// Finds the pauses of a recording whose marks nobody gave.
///
/// A pause is a stretch whose short-term energy, over frames of 10 ms, stays 26 dB under the recording's mean for
/// at least 160 ms. The closures of single stops are quiet for 50 to 100 ms, those of long ones, as in Italian
/// 'gatto' or Finnish 'takka', for up to 150 ms: espeak-ng's, in nine languages. The pauses between its sentences
/// take 220 ms and more. What is noisier than that has no pauses, and is played to its end.
///
/// Threads  pure; any.
#pragma once

#include "firmware_host/sound/prompt.h"

#include <span>

namespace frustumscreen {

struct PauseLimits {
    double below_mean_db = 26.0;
    double always_quiet_db = -70.0; ///< of full scale: whatever the mean is
    Nanoseconds shortest = std::chrono::milliseconds(160);
};

/// Where a fade may begin in each pause: 20 ms after its begin, where sounds die away, and so that it is over
/// 10 ms before its end.
[[nodiscard]] std::vector<Mark> find_pauses(std::span<const std::int16_t> samples,
                                            const PauseLimits& limits = {});

} // namespace frustumscreen

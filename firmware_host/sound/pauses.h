/// Finds the pauses of a recording without marks.
///
/// A pause is a stretch in which the short-term energy, over frames of 10 ms, stays 26 dB below the
/// recording's mean for at least 160 ms. The closures of single stops are quiet for 50 to 100 ms, those of
/// long ones, as in Italian 'gatto' or Finnish 'takka', for up to 150 ms (espeak-ng, nine languages). The
/// pauses between espeak-ng's sentences take 220 ms and more. A noisier recording has no pauses and is played
/// to its end.
///
/// Threads  pure; any.
#pragma once

#include "firmware_host/sound/prompt.h"

#include <span>

namespace frustumscreen::sound {

struct PauseLimits {
    double below_mean_db = 26.0;
    double always_quiet_db = -70.0; ///< of full scale; quiet for any mean
    Nanoseconds shortest = std::chrono::milliseconds(160);
};

/// The places in each pause at which a fade may begin: from 20 ms after the pause's start, where sounds die
/// away, until a fade would end 10 ms before the pause's end.
[[nodiscard]] std::vector<Mark> find_pauses(std::span<const std::int16_t> samples,
                                            const PauseLimits& limits = {});

} // namespace frustumscreen::sound

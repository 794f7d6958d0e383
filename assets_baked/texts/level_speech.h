/// Makes speech of any recording equally loud, and stores it as Ogg Opus.
///
/// Silence at both ends is trimmed, and the loudness becomes -23 LUFS; peaks above -2 dBTP, such as a knock
/// near the microphone, are lowered individually (limit_peaks.h).
///
/// Errors   one sentence: a failure of a library.
/// Threads  pure; any.
/// Library  libebur128 (EBU R 128, ITU-R BS.1770-4), libsamplerate, libsndfile with Opus.
#pragma once

#include "assets_baked/texts/recording.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::texts {

inline constexpr double speech_lufs = -23.0;
inline constexpr double max_true_peak_db = -2.0;
inline constexpr int speech_rate_hz = 48000;

struct Loudness {
    double lufs = 0.0; ///< integrated; minus infinity for silence
    double true_peak_db = 0.0;
};
/// One channel at `speech_rate_hz`.
[[nodiscard]] Loudness loudness_of(std::span<const float> samples);

struct Speech {
    Bytes opus; ///< Ogg Opus, one channel
    double seconds = 0.0;
    Loudness loudness; ///< of the decoded sound
};
/// nullopt if the recording is silent.
[[nodiscard]] Result<std::optional<Speech>> level_speech(const Recording& recording);

} // namespace frustumscreen::texts

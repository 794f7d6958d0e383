/// Reads a recording of speech: WAV, FLAC or Ogg (Opus, Vorbis), from bytes.
///
/// Errors   one sentence: not a recording of these kinds, cut off, too long, too many channels, a sample rate
///          unusual for speech, samples that are not numbers. Memory is bounded by `longest_recording_s`,
///          whatever the file claims.
/// Threads  pure; any.
/// Library  libsndfile.
#pragma once

#include "firmware_host/base/result.h"

#include <cstddef>
#include <span>
#include <vector>

namespace frustumscreen::texts {

inline constexpr int longest_recording_s = 180;
inline constexpr std::size_t max_recording_bytes = std::size_t{128} << 20;

struct Recording {
    int rate_hz = 0;
    std::vector<float> samples; ///< one channel, full scale is 1; two channels are averaged
};

/// The origin of the bytes. A file's length must be correct, and it must have sound. A stream's header is
/// written before its length is known, and a program that had nothing to say writes nothing more.
enum class RecordingSource { File, Stream };

[[nodiscard]] Result<Recording> read_recording(std::span<const std::byte> bytes, RecordingSource source);

} // namespace frustumscreen::texts

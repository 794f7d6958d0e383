#include "assets_baked/texts/recording.h"

#include "assets_baked/texts/sound_bytes.h"
#include "firmware_host/base/byte_reader.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <cmath>

namespace frustumscreen::texts {

namespace {

constexpr int min_rate_hz = 8000;
constexpr int max_rate_hz = 96000;
constexpr int max_channels = 2;

constexpr std::uint32_t riff = 0x46464952;
constexpr std::uint32_t data_chunk = 0x61746164;

/// Bytes of sound that a WAV file claims but lacks; libsndfile reads such a file as if it were shorter.
std::uint64_t missing_wav_bytes(std::span<const std::byte> bytes) {
    ByteReader header(bytes);
    if (header.read<std::uint32_t>() != riff) {
        return 0;
    }
    std::uint64_t at = 12;
    while (at + 8 <= bytes.size()) {
        ByteReader chunk(bytes.subspan(at));
        const auto kind = chunk.read<std::uint32_t>();
        const std::uint64_t size = chunk.read<std::uint32_t>();
        const std::uint64_t end = at + 8 + size;
        if (kind == data_chunk) {
            return end > bytes.size() ? end - bytes.size() : 0;
        }
        at = end + size % 2;
    }
    return 0;
}

bool is_allowed(int format) {
    const int major = format & SF_FORMAT_TYPEMASK;
    return major == SF_FORMAT_WAV || major == SF_FORMAT_WAVEX || major == SF_FORMAT_FLAC ||
           major == SF_FORMAT_OGG;
}

Result<void> check_kind(const SF_INFO& info) {
    if (!is_allowed(info.format)) {
        return bad_input("recording.format",
                         "this is not a WAV, FLAC or Ogg file; convert it to one of these");
    }
    if (info.samplerate < min_rate_hz || info.samplerate > max_rate_hz) {
        return bad_input("recording.rate",
                         "the recording has {} samples a second; allowed are {} to {}: convert it to 48000",
                         info.samplerate, min_rate_hz, max_rate_hz);
    }
    if (info.channels < 1 || info.channels > max_channels) {
        return bad_input("recording.channels",
                         "the recording has {} channels; allowed are 1 and 2: mix it down", info.channels);
    }
    return {};
}

Result<void> append_mixed(std::span<const float> frames, int channels, std::vector<float>& samples) {
    for (std::size_t k = 0; k < frames.size(); k += static_cast<std::size_t>(channels)) {
        float sum = 0.0F;
        for (std::size_t channel = 0; channel < static_cast<std::size_t>(channels); ++channel) {
            sum += frames[k + channel];
        }
        if (!std::isfinite(sum)) {
            return bad_input("recording.not_finite",
                             "the recording has samples that are not numbers; save it again as 16 or 24 bit");
        }
        samples.push_back(sum / static_cast<float>(channels));
    }
    return {};
}

} // namespace

Result<Recording> read_recording(std::span<const std::byte> bytes, RecordingSource source) {
    if (bytes.size() > max_recording_bytes) {
        return bad_input("recording.size", "the recording has {} bytes; allowed are {}", bytes.size(),
                         max_recording_bytes);
    }
    if (const std::uint64_t missing = missing_wav_bytes(bytes);
        source == RecordingSource::File && missing > 0) {
        return bad_input("recording.cut_off",
                         "the recording is cut off: {} bytes of its sound are missing; copy it again",
                         missing);
    }
    SoundBytes sound{.view = bytes, .written = {}, .writing = false, .cursor = 0};
    SF_INFO info{};
    const SoundFile file = open_sound(sound, SFM_READ, info);
    if (!file) {
        return bad_input("recording.unreadable",
                         "this recording cannot be read ({}); allowed are WAV, FLAC and Ogg Opus: convert "
                         "it, such as with ffmpeg -i NAME.mp3 NAME.wav",
                         printable(sf_strerror(nullptr), 120));
    }
    TRY_VOID(check_kind(info));
    Recording recording;
    recording.rate_hz = info.samplerate;
    const auto max_frames =
        static_cast<std::size_t>(longest_recording_s) * static_cast<std::size_t>(info.samplerate);
    constexpr sf_count_t block_frames = 4096;
    std::vector<float> block(static_cast<std::size_t>(block_frames) *
                             static_cast<std::size_t>(info.channels));
    while (const sf_count_t count = sf_readf_float(file.get(), block.data(), block_frames)) {
        const auto values = static_cast<std::size_t>(count) * static_cast<std::size_t>(info.channels);
        TRY_VOID(append_mixed(std::span(block).first(values), info.channels, recording.samples));
        if (recording.samples.size() > max_frames) {
            return bad_input("recording.too_long",
                             "the recording is longer than the allowed {} s; shorten it",
                             longest_recording_s);
        }
    }
    if (recording.samples.empty() && source == RecordingSource::File) {
        return bad_input("recording.empty", "the recording has no sound at all; record it again");
    }
    return recording;
}

} // namespace frustumscreen::texts

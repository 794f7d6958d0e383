#include "firmware_host/sound/wav_sound.h"

#include "firmware_host/base/byte_reader.h"

#include <algorithm>

namespace frustumscreen::sound {

namespace {

constexpr std::uint64_t max_samples = samples_in(WavSound::longest);

void append_text(Bytes& bytes, std::string_view text) {
    const std::span<const std::byte> letters = as_bytes(text);
    bytes.insert(bytes.end(), letters.begin(), letters.end());
}

/// Microsoft and IBM, 'Multimedia programming interface and data specifications 1.0', 1991: WAVE.
Bytes wav_header(std::size_t samples) {
    constexpr std::uint32_t format_bytes = 16;
    constexpr std::uint16_t bytes_a_sample = sizeof(std::int16_t);
    const auto data_bytes = static_cast<std::uint32_t>(samples * bytes_a_sample);
    Bytes bytes;
    append_text(bytes, "RIFF");
    append(bytes, std::uint32_t{4 + 8 + format_bytes + 8} + data_bytes);
    append_text(bytes, "WAVEfmt ");
    append(bytes, format_bytes);
    append(bytes, std::uint16_t{1}); // PCM
    append(bytes, std::uint16_t{1}); // channels
    append(bytes, std::uint32_t{sample_rate_hz});
    append(bytes, std::uint32_t{sample_rate_hz * bytes_a_sample});
    append(bytes, bytes_a_sample);
    append(bytes, std::uint16_t{8 * bytes_a_sample});
    append_text(bytes, "data");
    append(bytes, data_bytes);
    return bytes;
}

} // namespace

SoundReport WavSound::poll(MonotonicTime now, const SoundRequest& request) {
    mix_in_blocks(mixer_, clock_.take_due(now), [this](std::span<const std::int16_t> block) {
        const std::size_t fit = std::min<std::size_t>(block.size(), max_samples - samples_.size());
        samples_.insert(samples_.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(fit));
    });
    mixer_.follow(request);
    SoundReport report = mixer_.report(Nanoseconds(0));
    report.audible = true;
    return report;
}

std::string_view WavSound::state() const {
    return samples_.size() < max_samples ? "its sound goes into a file"
                                         : "its sound goes into a file, which is full after an hour";
}

Result<void> WavSound::write(const std::filesystem::path& path) const {
    Bytes bytes = wav_header(samples_.size());
    append_all(bytes, samples_);
    return write_file(path, bytes);
}

} // namespace frustumscreen::sound

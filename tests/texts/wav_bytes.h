// WAV files byte by byte, from Microsoft's and IBM's Multimedia Programming Interface 1.0 (1991).
#pragma once

#include "firmware_host/base/byte_reader.h"
#include "firmware_host/base/file.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace frustumscreen::testing {

struct WavHeader {
    std::uint16_t format = 1; ///< 1: integers, 3: floating point
    std::uint16_t channels = 1;
    std::uint32_t rate_hz = 48000;
    std::uint16_t bits = 16;
    std::uint32_t claimed_bytes = 0; ///< 0: the true number
};

inline Bytes wav(const WavHeader& header, const Bytes& sound) {
    const auto size = static_cast<std::uint32_t>(sound.size());
    const std::uint32_t claimed = header.claimed_bytes != 0 ? header.claimed_bytes : size;
    const auto frame_bytes = static_cast<std::uint16_t>(header.channels * header.bits / 8);
    Bytes file;
    const auto word = [&](std::string_view text) {
        for (const char c : text) {
            append(file, c);
        }
    };
    word("RIFF");
    append(file, static_cast<std::uint32_t>(36 + claimed));
    word("WAVEfmt ");
    append(file, std::uint32_t{16});
    append(file, header.format);
    append(file, header.channels);
    append(file, header.rate_hz);
    append(file, static_cast<std::uint32_t>(header.rate_hz * frame_bytes));
    append(file, frame_bytes);
    append(file, header.bits);
    word("data");
    append(file, claimed);
    file.insert(file.end(), sound.begin(), sound.end());
    return file;
}

inline Bytes wav16(const std::vector<double>& samples, std::uint32_t rate_hz = 48000) {
    Bytes sound;
    for (const double sample : samples) {
        append(sound, static_cast<std::int16_t>(std::lround(std::clamp(sample, -1.0, 1.0) * 32767.0)));
    }
    WavHeader header;
    header.rate_hz = rate_hz;
    return wav(header, sound);
}

inline std::vector<double> sine(double amplitude, double seconds, double hz = 997.0,
                                double rate_hz = 48000.0) {
    std::vector<double> samples(static_cast<std::size_t>(seconds * rate_hz));
    for (std::size_t k = 0; k < samples.size(); ++k) {
        samples[k] = amplitude * std::sin(2.0 * std::numbers::pi * hz * static_cast<double>(k) / rate_hz);
    }
    return samples;
}

} // namespace frustumscreen::testing

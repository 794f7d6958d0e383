#include "firmware_host/base/file.h"
#include "firmware_host/sound/opus_reader.h"
#include "tests/base/told.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

namespace frustumscreen::sound {
namespace {

/// Recordings written by libsndfile.
Bytes fixture(const std::string& name) {
    const Result<Bytes> bytes = read_file(source_dir() + "/tests/sound/fixtures/" + name);
    EXPECT_TRUE(bytes);
    return bytes.value_or(Bytes());
}

/// Error of the samples against `amplitude` times the recorded 440 Hz tone, in dB relative to the tone.
double error_db(std::span<const std::int16_t> samples, double amplitude) {
    double error = 0.0;
    double tone = 0.0;
    for (std::size_t k = 480; k + 480 < samples.size(); ++k) { // the codec rings at the ends
        const double truth =
            amplitude * std::sin(2.0 * std::numbers::pi * 440.0 * static_cast<double>(k) / 48'000.0);
        error += std::pow(samples[k] / 32768.0 - truth, 2);
        tone += truth * truth;
    }
    return 10.0 * std::log10(error / tone);
}

/// RFC 3533: CRC of polynomial 0x04c11db7, most significant bit first, over the page with its CRC as 0.
std::uint32_t ogg_crc(std::span<const std::byte> page) {
    std::uint32_t crc = 0;
    for (const std::byte byte : page) {
        crc ^= std::to_integer<std::uint32_t>(byte) << 24U;
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc << 1U) ^ ((crc >> 31U) != 0 ? 0x04c11db7U : 0U);
        }
    }
    return crc;
}

/// Makes the last page claim that it ends at sample `position`.
Bytes claiming(Bytes file, std::int64_t position) {
    constexpr std::string_view capture = "OggS";
    std::size_t page = 0;
    for (std::size_t k = 0; k + 4 <= file.size(); ++k) {
        page = std::memcmp(&file[k], capture.data(), 4) == 0 ? k : page;
    }
    std::memcpy(&file[page + 6], &position, 8);
    std::fill_n(&file[page + 22], 4, std::byte(0));
    const std::uint32_t crc = ogg_crc(std::span(file).subspan(page));
    std::memcpy(&file[page + 22], &crc, 4);
    return file;
}

std::string refusal(std::span<const std::byte> bytes, const OpusLimits& limits = {}) {
    const Result<Prompt> prompt = read_opus(bytes, limits);
    EXPECT_FALSE(prompt);
    return prompt ? "" : test::told(prompt.error());
}

TEST(OpusReader, DecodesAToneWithoutDelay) {
    const Result<Prompt> prompt = read_opus(fixture("tone.opus"));
    ASSERT_TRUE(prompt) << prompt.error().message;
    EXPECT_EQ(prompt->samples.size(), 24'000U);
    EXPECT_LT(error_db(prompt->samples, 0.5), -30.0);
    EXPECT_TRUE(prompt->marks.empty());
}

TEST(OpusReader, TwoChannelsAreAveraged) {
    const Result<Prompt> prompt = read_opus(fixture("left.opus")); // the right channel is silent
    ASSERT_TRUE(prompt) << prompt.error().message;
    EXPECT_EQ(prompt->samples.size(), 14'400U);
    EXPECT_LT(error_db(prompt->samples, 0.25), -25.0);
}

TEST(OpusReader, RejectsFourChannelsAndChainedRecordings) {
    EXPECT_NE(refusal(fixture("four.opus")).find("4 channels"), std::string::npos);
    Bytes chain = fixture("tone.opus");
    const Bytes left = fixture("left.opus");
    chain.insert(chain.end(), left.begin(), left.end());
    EXPECT_NE(refusal(chain).find("[opus.several]"), std::string::npos);
}

TEST(OpusReader, RejectsActualAndClaimedExcessLength) {
    OpusLimits limits;
    limits.longest = std::chrono::milliseconds(499);
    EXPECT_NE(refusal(fixture("tone.opus"), limits).find("longer than 0 s"), std::string::npos);
    limits.longest = std::chrono::milliseconds(500);
    EXPECT_TRUE(read_opus(fixture("tone.opus"), limits));
    const std::string message = refusal(claiming(fixture("speech.opus"), std::int64_t{1} << 40));
    EXPECT_NE(message.find("longer than 180 s; shorten it"), std::string::npos) << message;
    const Result<Prompt> honest = read_opus(fixture("speech.opus"));
    const Result<Prompt> boastful = read_opus(claiming(fixture("speech.opus"), 100 * 48'000));
    ASSERT_TRUE(honest && boastful); // a valid claim does not extend the prompt beyond its last page
    EXPECT_LE(boastful->samples.size(), honest->samples.size() + 960);
}

TEST(OpusReader, RejectsOtherDataAndSurvivesTruncation) {
    EXPECT_NE(refusal({}).find("not an Ogg Opus"), std::string::npos);
    EXPECT_NE(refusal(as_bytes("RIFF....WAVEfmt ")).find("not an Ogg Opus"), std::string::npos);
    const Bytes whole = fixture("tone.opus");
    for (std::size_t length = 0; length < whole.size(); length += 7) { // cut at any place
        const Result<Prompt> prompt = read_opus(std::span(whole).first(length));
        if (!prompt) {
            EXPECT_EQ(prompt.error().kind, ErrorKind::BadInput);
            EXPECT_EQ(prompt.error().message.find('\n'), std::string::npos);
            EXPECT_NE(prompt.error().message.find("; "), std::string::npos) << prompt.error().message;
        } else {
            EXPECT_LE(prompt->samples.size(), 24'000U);
        }
    }
}

} // namespace
} // namespace frustumscreen::sound

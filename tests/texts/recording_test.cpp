// Recordings: which are refused, and the loudness of the resulting speech.
#include "assets_baked/texts/level_speech.h"
#include "assets_baked/texts/limit_peaks.h"
#include "tests/base/told.h"
#include "tests/texts/wav_bytes.h"

#include <gtest/gtest.h>

#include <random>

using namespace frustumscreen;
using namespace frustumscreen::texts;
using namespace frustumscreen::testing;

namespace {

std::string refusal(const Bytes& bytes) {
    const Result<Recording> recording = read_recording(bytes, RecordingSource::File);
    return recording ? std::string() : test::told(recording.error());
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// nullopt for silence.
std::optional<Speech> speech_of(const std::vector<double>& samples, std::uint32_t rate_hz = 48000) {
    const Result<Recording> recording = read_recording(wav16(samples, rate_hz), RecordingSource::File);
    EXPECT_TRUE(recording) << recording.error().message;
    const Result<std::optional<Speech>> speech = level_speech(*recording);
    EXPECT_TRUE(speech) << speech.error().message;
    return speech ? *speech : std::nullopt;
}

std::vector<float> decoded(const Speech& speech) {
    const Result<Recording> recording = read_recording(speech.opus, RecordingSource::File);
    EXPECT_TRUE(recording) << recording.error().message;
    EXPECT_EQ(recording->rate_hz, 48000);
    return recording->samples;
}

/// Root mean square of the middle half, in dB below full scale.
double middle_level_db(const std::vector<float>& samples) {
    double squares = 0.0;
    for (std::size_t k = samples.size() / 4; k < samples.size() * 3 / 4; ++k) {
        squares += static_cast<double>(samples[k]) * static_cast<double>(samples[k]);
    }
    return 10.0 * std::log10(squares / (static_cast<double>(samples.size()) / 2.0));
}

} // namespace

TEST(Recording, reads_the_samples_of_a_wav_file) {
    const std::vector<double> samples = sine(0.5, 0.2);
    const Result<Recording> recording = read_recording(wav16(samples), RecordingSource::File);
    ASSERT_TRUE(recording) << recording.error().message;
    ASSERT_EQ(recording->samples.size(), samples.size());
    for (std::size_t k = 0; k < samples.size(); ++k) {
        EXPECT_NEAR(recording->samples[k], samples[k], 1e-4);
    }
}

TEST(Recording, two_channels_are_averaged) {
    Bytes sound;
    for (int k = 0; k < 100; ++k) {
        append(sound, std::int16_t{16384});
        append(sound, std::int16_t{-8192});
    }
    WavHeader header;
    header.channels = 2;
    const Result<Recording> recording = read_recording(wav(header, sound), RecordingSource::File);
    ASSERT_TRUE(recording) << recording.error().message;
    EXPECT_EQ(recording->samples, std::vector<float>(100, 0.125F));
}

TEST(Recording, rejects_data_that_is_no_recording) {
    EXPECT_TRUE(contains(refusal({}), "[recording.unreadable]"));
    const std::string text = "The white block is found.";
    const std::span<const std::byte> as = as_bytes(text);
    EXPECT_TRUE(contains(refusal({as.begin(), as.end()}), "[recording.unreadable]"));
}

TEST(Recording, rejects_unsupported_rates_and_channel_counts) {
    const Bytes sound(19200, std::byte{1});
    WavHeader header;
    for (const std::uint32_t rate_hz : {0U, 1U, 4000U, 192000U, 0xffffffffU}) {
        header.rate_hz = rate_hz;
        EXPECT_FALSE(refusal(wav(header, sound)).empty()) << rate_hz;
    }
    header.rate_hz = 192000;
    EXPECT_TRUE(test::tells(refusal(wav(header, sound)), {"192000", "8000 to 96000", "[recording.rate]"}));
    header.rate_hz = 48000;
    header.channels = 32;
    EXPECT_TRUE(test::tells(refusal(wav(header, sound)), {"32", "[recording.channels]"}));
    header.channels = 0;
    EXPECT_FALSE(refusal(wav(header, sound)).empty());
}

TEST(Recording, rejects_a_truncated_file_but_not_a_stream) {
    WavHeader header;
    header.claimed_bytes = 0xfffffff0U;
    const Bytes bomb = wav(header, Bytes(1000, std::byte{1}));
    EXPECT_TRUE(test::tells(refusal(bomb), {"4294966280 bytes", "[recording.cut_off]"}));
    const Result<Recording> stream = read_recording(bomb, RecordingSource::Stream);
    ASSERT_TRUE(stream) << "a program that writes into a pipe does not know the length before; "
                        << stream.error().message;
    EXPECT_EQ(stream->samples.size(), 500U);
}

TEST(Recording, rejects_empty_too_long_and_non_finite_sound) {
    EXPECT_TRUE(test::tells(refusal(wav({}, {})), {"[recording.empty]"}));
    WavHeader slow;
    slow.rate_hz = 8000;
    slow.bits = 8;
    EXPECT_TRUE(
        test::tells(refusal(wav(slow, Bytes(8000 * 181, std::byte{1}))), {"180 s", "[recording.too_long]"}));
    WavHeader floating;
    floating.format = 3;
    floating.bits = 32;
    Bytes sound;
    append(sound, 0.5F);
    append(sound, std::numeric_limits<float>::quiet_NaN());
    EXPECT_TRUE(test::tells(refusal(wav(floating, sound)), {"[recording.not_finite]"}));
}

// ITU-R BS.1770-4, annex 1: a sine of 997 Hz at full scale in one channel has -3.01 LUFS, so one of -23 LUFS has an amplitude
// of -19.99 dB and a root mean square of -23.0 dB.
TEST(LevelSpeech, levels_a_sine_to_minus_23_lufs) {
    for (const double amplitude : {0.003, 0.05, 0.9}) {
        const std::optional<Speech> speech = speech_of(sine(amplitude, 3.0));
        ASSERT_TRUE(speech);
        EXPECT_NEAR(middle_level_db(decoded(*speech)), -23.0, 0.3) << amplitude;
        EXPECT_NEAR(speech->loudness.lufs, -23.0, 0.3) << amplitude;
    }
}

TEST(LevelSpeech, meter_matches_bs_1770_for_a_sine) {
    std::vector<float> samples;
    for (const double sample : sine(1.0, 5.0)) {
        samples.push_back(static_cast<float>(sample));
    }
    EXPECT_NEAR(loudness_of(samples).lufs, -3.01, 0.05);
    EXPECT_NEAR(loudness_of(samples).true_peak_db, 0.0, 0.05);
}

TEST(LevelSpeech, other_rates_keep_pitch_and_length) {
    for (const std::uint32_t rate_hz : {8000U, 22050U, 44100U, 96000U}) {
        const std::optional<Speech> speech = speech_of(sine(0.1, 2.0, 500.0, rate_hz), rate_hz);
        ASSERT_TRUE(speech);
        const std::vector<float> samples = decoded(*speech);
        EXPECT_NEAR(static_cast<double>(samples.size()) / 48000.0, 2.0, 0.03) << rate_hz;
        int crossings = 0;
        for (std::size_t k = 24000; k < 72000; ++k) {
            crossings += samples[k - 1] < 0.0F && samples[k] >= 0.0F ? 1 : 0;
        }
        EXPECT_NEAR(crossings, 500, 2) << rate_hz;
    }
}

TEST(LevelSpeech, silence_before_and_after_is_trimmed) {
    std::vector<double> samples(48000, 0.0);
    const std::vector<double> tone = sine(0.2, 1.0);
    samples.insert(samples.end(), tone.begin(), tone.end());
    samples.resize(samples.size() + 96000, 0.0);
    const std::optional<Speech> speech = speech_of(samples);
    ASSERT_TRUE(speech);
    EXPECT_NEAR(speech->seconds, 1.0 + 0.06 + 0.15, 0.03);
}

TEST(LevelSpeech, peaks_stay_below_minus_2_db) {
    std::mt19937 random(7);
    std::vector<double> clicks(96000, 0.0);
    for (std::size_t k = 0; k < clicks.size(); k += 4800) {
        for (std::size_t n = 0; n < 24; ++n) {
            clicks[k + n] = std::uniform_real_distribution<double>(-1.0, 1.0)(random);
        }
    }
    const std::optional<Speech> speech = speech_of(clicks);
    ASSERT_TRUE(speech);
    EXPECT_LE(speech->loudness.true_peak_db, -2.0);
    EXPECT_LT(speech->loudness.lufs, -23.0) << "its peaks allow no more";
    const std::vector<float> samples = decoded(*speech);
    const float most = *std::max_element(samples.begin(), samples.end());
    EXPECT_LE(20.0 * std::log10(static_cast<double>(most)), -2.0);
}

/// Speech at a level of -40 dB with one knock on the microphone, at full scale.
TEST(LevelSpeech, one_knock_does_not_attenuate_the_rest) {
    std::vector<double> samples = sine(0.01, 5.0);
    for (std::size_t k = 0; k < 96; ++k) {
        samples[120000 + k] = k % 8 < 4 ? 0.99 : -0.99;
    }
    const std::optional<Speech> speech = speech_of(samples);
    ASSERT_TRUE(speech);
    EXPECT_LE(speech->loudness.true_peak_db, -2.0);
    std::vector<float> before_knock = decoded(*speech);
    before_knock.resize(96000);
    EXPECT_NEAR(middle_level_db(before_knock), -23.0, 1.0);
    EXPECT_NEAR(speech->loudness.lufs, -23.0, 0.5);
}

TEST(LevelSpeech, limiter_lowers_only_the_neighbourhood_of_peaks) {
    std::vector<float> samples(48000, 0.25F);
    samples[20000] = -1.0F;
    const std::vector<float> limited = limit_peaks(samples, 48000, 0.5F);
    ASSERT_EQ(limited.size(), samples.size());
    for (std::size_t k = 0; k < samples.size(); ++k) {
        const bool is_near = k > 20000 - 500 && k < 20000 + 500;
        EXPECT_LE(std::abs(limited[k]), 0.5F) << k;
        EXPECT_GE(std::abs(limited[k]), 0.124F) << k;
        if (!is_near) {
            EXPECT_NEAR(limited[k], samples[k], 1e-5) << k;
        } else if (k != 20000 && k != 20001) {
            EXPECT_LT(std::abs(limited[k] - limited[k - 1]), 0.001F) << "it clicks at " << k;
        }
    }
    EXPECT_NEAR(limited[20000], -0.5F, 1e-4);
}

TEST(LevelSpeech, skips_silence_and_levels_very_short_sounds) {
    EXPECT_FALSE(speech_of(std::vector<double>(48000, 0.00001)));
    const std::optional<Speech> brief = speech_of(sine(0.3, 0.2));
    ASSERT_TRUE(brief);
    EXPECT_NEAR(middle_level_db(decoded(*brief)), -23.0, 0.5);
}

TEST(LevelSpeech, the_same_recording_gives_the_same_bytes) {
    const std::optional<Speech> one = speech_of(sine(0.3, 0.5));
    const std::optional<Speech> other = speech_of(sine(0.3, 0.5));
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->opus, other->opus);
    EXPECT_EQ(as_text(one->opus).substr(0, 4), "OggS");
}

#include "firmware_host/base/file.h"
#include "firmware_host/sound/opus_reader.h"
#include "firmware_host/sound/pauses.h"
#include "tests/folders.h"
#include "tests/sound/sound_samples.h"

#include <gtest/gtest.h>

namespace frustumscreen::sound {
namespace {

using namespace testing;

constexpr std::size_t ms = sample_rate_hz / 1000;

/// Noise, except for these stretches in ms.
std::vector<std::int16_t> broken(std::size_t length_ms,
                                 const std::vector<std::pair<std::size_t, std::size_t>>& pauses, int quiet) {
    std::vector<std::int16_t> samples = noise(length_ms * ms, 8000, 11)->samples;
    const std::vector<std::int16_t> soft = noise(length_ms * ms, quiet, 12)->samples;
    for (const auto& [begin, end] : pauses) {
        std::copy(soft.begin() + static_cast<std::ptrdiff_t>(begin * ms),
                  soft.begin() + static_cast<std::ptrdiff_t>(end * ms),
                  samples.begin() + static_cast<std::ptrdiff_t>(begin * ms));
    }
    return samples;
}

TEST(Pauses, AreFoundIfLongAndQuietEnough) {
    for (const int quiet : {0, 100, 250}) { // 250 / 8000 = -30 dB; the pauses make the mean lower, too
        const std::vector<Mark> marks =
            find_pauses(broken(2000, {{300, 470}, {800, 940}, {1500, 1900}}, quiet));
        ASSERT_EQ(marks.size(), 2U) << quiet;
        EXPECT_EQ(marks[0], (Mark{320 * ms, 455 * ms})) << quiet;
        EXPECT_EQ(marks[1], (Mark{1520 * ms, 1885 * ms})) << quiet;
    }
    EXPECT_TRUE(find_pauses(broken(2000, {{300, 600}}, 600)).empty()); // -22 dB is not a pause
}

TEST(Pauses, FadeFromAMarkEndsWithinThePause) {
    for (std::size_t at = 301; at < 320; ++at) { // at any phase of the finder's frames
        const std::vector<Mark> marks = find_pauses(broken(1000, {{at, at + 180}}, 0));
        EXPECT_EQ(marks.size(), 1U) << at;
        for (const Mark mark : marks) {
            EXPECT_GE(mark.begin, at * ms);
            EXPECT_LE(mark.begin, mark.end);
            EXPECT_LE(mark.end + Mixer::fade_samples, (at + 180) * ms);
        }
    }
}

TEST(Pauses, SilenceIsOnePauseAndEmptySoundHasNone) {
    const std::vector<Mark> marks = find_pauses(level(1000 * ms, 0)->samples);
    ASSERT_EQ(marks.size(), 1U);
    EXPECT_EQ(marks[0], (Mark{20 * ms, 985 * ms}));
    EXPECT_TRUE(find_pauses({}).empty());
    EXPECT_TRUE(find_pauses(level(10, 0)->samples).empty());
}

/// 'Spostatelo un poco a sinistra. Nella bottega c'era un gatto matto.', with three long closures inside
/// words.
TEST(Pauses, SeparateSentencesNotLongConsonants) {
    const Result<Bytes> bytes = read_file(source_dir() + "/tests/sound/fixtures/speech.opus");
    ASSERT_TRUE(bytes);
    const Result<Prompt> speech = read_opus(*bytes);
    ASSERT_TRUE(speech) << speech.error().message;
    // According to espeak-ng's events, 'sinistra' begins at 1040 ms and 'Nella' at 1924 ms.
    const std::vector<Mark> marks = find_pauses(speech->samples);
    ASSERT_EQ(marks.size(), 1U);
    EXPECT_GT(marks[0].begin, 1500 * ms);
    EXPECT_LT(marks[0].end + Mixer::fade_samples, 1924 * ms);
    PauseLimits short_ones;
    short_ones.shortest = std::chrono::milliseconds(80);
    EXPECT_GE(find_pauses(speech->samples, short_ones).size(), 4U); // bottega, gatto and matto would be cut
}

} // namespace
} // namespace frustumscreen::sound

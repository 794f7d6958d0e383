#include "firmware_host/base/file.h"
#include "firmware_host/sound/silent_sound.h"
#include "firmware_host/sound/wav_sound.h"
#include "tests/sound/sound_samples.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <fstream>

namespace frustumscreen::sound {
namespace {

using namespace testing;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr MonotonicTime start{seconds(5000)};

TEST(SampleClock, LosesNoSampleToRounding) {
    SampleClock clock(start);
    std::mt19937 random(21);
    std::uint64_t taken = 0;
    MonotonicTime now = start;
    for (int k = 0; k < 10'000; ++k) {
        now += Nanoseconds(random() % 20'000'000);
        taken += clock.take_due(now);
    }
    EXPECT_EQ(taken, samples_in(now - start));
    EXPECT_EQ(clock.take_due(now - seconds(1)), 0U);
    EXPECT_EQ(clock.take_due(now + milliseconds(1)), samples_in(now + milliseconds(1) - start) - taken);
    EXPECT_EQ(samples_in(duration_of(48'000'007)), 48'000'006U); // whole samples: a nanosecond is missing
    EXPECT_EQ(samples_in(seconds(86'400)), 86'400ULL * 48'000);
}

TEST(SilentSound, ReportsProgressInRealTime) {
    SilentSound sound(start);
    SoundRequest wish;
    wish.say(level(48'000, 1000));
    EXPECT_EQ(sound.poll(start + seconds(1), wish).number, 0U); // starts now
    const SoundReport half = sound.poll(start + milliseconds(1500), wish);
    EXPECT_EQ(half.number, 1U);
    EXPECT_EQ(half.heard, milliseconds(500));
    EXPECT_EQ(half.length, seconds(1));
    EXPECT_FALSE(half.audible);
    const SoundReport done = sound.poll(start + milliseconds(2001), wish);
    EXPECT_EQ(done.number, 0U);
    EXPECT_EQ(done.over, 1U);
    EXPECT_FALSE(sound.alive_until());
}

TEST(WavSound, ReportsMatchTheSilentSound) {
    SilentSound silent(start);
    WavSound wav(start);
    SoundRequest wish;
    std::mt19937 random(22);
    MonotonicTime now = start;
    for (int k = 0; k < 2000; ++k) {
        now += Nanoseconds(random() % 30'000'000);
        switch (random() % 40) {
        case 0:
            wish.say(
                noise(random() % 60'000, 9000, static_cast<unsigned>(k), {{5000, 6000}, {20'000, 21'000}}));
            break;
        case 1:
            wish.leave();
            break;
        case 2:
            wish.stop();
            break;
        default:
            break;
        }
        SoundReport heard = wav.poll(now, wish);
        EXPECT_TRUE(heard.audible);
        heard.audible = false;
        EXPECT_EQ(heard, silent.poll(now, wish));
    }
}

/// Python's own WAV reader gives equal samples.
TEST(WavSound, PythonReadsTheWavFile) {
    if (std::system("command -v python3 >/dev/null") != 0) {
        GTEST_SKIP() << "python3 is not installed";
    }
    const SharedPrompt prompt = noise(4800, 9000, 23);
    WavSound sound(start);
    SoundRequest wish;
    wish.say(prompt);
    (void)sound.poll(start + milliseconds(50), wish);
    (void)sound.poll(start + milliseconds(250), wish);
    ASSERT_TRUE(sound.write("said.wav"));
    ASSERT_EQ(std::system("python3 -c \"import wave; w = wave.open('said.wav'); open('said.raw', 'wb').write("
                          "w.readframes(10**9)); print(*w.getparams()[:4], file=open('said.txt', 'w'))\""),
              0);
    std::string parameters;
    std::getline(std::ifstream("said.txt") >> std::ws, parameters);
    EXPECT_EQ(parameters, "1 2 48000 12000"); // channels, bytes, rate, samples
    const Result<Bytes> raw = read_file("said.raw");
    ASSERT_TRUE(raw);
    std::vector<std::int16_t> heard(raw->size() / 2);
    std::memcpy(heard.data(), raw->data(), heard.size() * 2);
    ASSERT_EQ(heard.size(), 12'000U);
    EXPECT_EQ(first_heard(heard) / 10, 240U); // it was requested after 50 ms
    for (std::size_t k = Mixer::fade_samples; k < 4800 - Mixer::fade_samples; ++k) {
        ASSERT_EQ(heard[2400 + k], prompt->samples[k]) << k;
    }
}

} // namespace
} // namespace frustumscreen::sound

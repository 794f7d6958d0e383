#include "tests/sound/sound_samples.h"

#include <gtest/gtest.h>

namespace frustumscreen::sound {
namespace {

using namespace testing;

constexpr std::size_t fade = Mixer::fade_samples;
constexpr std::size_t breath = Mixer::breath_samples;
constexpr std::size_t second = sample_rate_hz;

/// The largest step of a fade over `length` samples of a signal of this height, plus half a code of rounding
/// at both ends.
double step_of_fade(double height, double length) {
    return 1.5 * height / length + 1.0;
}

TEST(Mixer, PlaysAPromptUnchangedExceptForItsFades) {
    Mixer mixer;
    SoundRequest wish;
    const SharedPrompt prompt = noise(2000, static_cast<int>(0.794 * 32768), 1);
    EXPECT_EQ(wish.say(prompt), 1U);
    mixer.follow(wish);
    const std::vector<std::int16_t> heard = mixed(mixer, 3000);
    for (std::size_t k = 0; k < 3000; ++k) {
        if (k < fade || (k >= 2000 - fade && k < 2000)) {
            EXPECT_LE(std::abs(heard[k]), std::abs(prompt->samples[k])) << k;
        } else {
            EXPECT_EQ(heard[k], k < 2000 ? prompt->samples[k] : 0) << k;
        }
    }
}

TEST(Mixer, BlockSizesDoNotChangeTheSamples) {
    const auto play = [](bool in_pieces) {
        Mixer mixer;
        SoundRequest wish;
        wish.set_gain_db(-3.0);
        wish.say(noise(20'000, 20'000, 3, {{5000, 6000}, {12'000, 12'000}}));
        mixer.follow(wish);
        std::mt19937 random(4);
        std::vector<std::int16_t> all;
        for (int part = 0; part < 4; ++part) {
            for (std::size_t left = 30'000; left > 0;) {
                const std::size_t count = in_pieces ? std::min<std::size_t>(left, 1 + random() % 700) : left;
                const std::vector<std::int16_t> some = mixed(mixer, count);
                all.insert(all.end(), some.begin(), some.end());
                left -= count;
            }
            wish.say(noise(25'000, 20'000, 5, {{9000, 9100}}));
            wish.set_gain_db(-1.0 * part);
            mixer.follow(wish);
        }
        return all;
    };
    EXPECT_EQ(play(true), play(false));
}

TEST(Mixer, LeavesAPromptOnlyWithinAMark) {
    std::mt19937 generator(6);
    const auto random = [&] { return static_cast<std::uint32_t>(generator()); };
    int left_early = 0;
    for (int k = 0; k < 300; ++k) {
        std::vector<Mark> marks;
        for (std::uint32_t at = 500; at < 9000;) {
            const std::uint32_t begin = at + random() % 1500;
            const std::uint32_t end = begin + random() % 300;
            marks.push_back({begin, end});
            at = end + 1 + random() % 1000;
        }
        Mixer mixer;
        SoundRequest wish;
        wish.say(level(12'000, 10'000, marks));
        mixer.follow(wish);
        const std::size_t asked = random() % 12'000;
        std::vector<std::int16_t> heard = mixed(mixer, asked);
        wish.leave();
        mixer.follow(wish);
        const std::vector<std::int16_t> rest = mixed(mixer, 12'000);
        heard.insert(heard.end(), rest.begin(), rest.end());
        const auto left = std::find_if(marks.begin(), marks.end(), [&](Mark m) { return m.end >= asked; });
        const std::size_t from = left == marks.end() ? 12'000 : std::max<std::size_t>(left->begin, asked);
        // The last sample of a fade is 0, and the one before it may round to 0.
        const std::size_t expected = std::min<std::size_t>(from + fade, 12'000);
        EXPECT_LE(end_of_heard(heard), expected);
        EXPECT_GE(end_of_heard(heard) + 4, expected);
        for (std::size_t at = fade; at < std::min(from, 12'000 - fade); ++at) {
            ASSERT_EQ(heard[at], 10'000) << at;
        }
        EXPECT_LE(largest_step(heard), step_of_fade(10'000, fade) * 2.0); // two fades may meet at the end
        EXPECT_EQ(mixer.report(Nanoseconds(0)).over, 1U);
        left_early += expected < 12'000 ? 1 : 0;
    }
    EXPECT_GT(left_early, 150);
}

TEST(Mixer, PlaysToTheEndWithoutAMark) {
    Mixer mixer;
    SoundRequest wish;
    wish.say(level(5000, 9000));
    mixer.follow(wish);
    mixed(mixer, 100);
    wish.leave();
    mixer.follow(wish);
    EXPECT_EQ(mixed(mixer, 4000).back(), 9000);
    EXPECT_NEAR(static_cast<double>(end_of_heard(mixed(mixer, 4000))), 5000 - 4100, 2.0); // fades to 0
}

TEST(Mixer, StopFadesAtOnceAndStartsTheNextPrompt) {
    Mixer mixer;
    SoundRequest wish;
    wish.say(level(second, 20'000));
    mixer.follow(wish);
    mixed(mixer, 5000);
    wish.stop();
    EXPECT_EQ(wish.say(level(second, 20'000)), 2U);
    mixer.follow(wish);
    const std::vector<std::int16_t> heard = mixed(mixer, 1000);
    EXPECT_LE(largest_step(heard), step_of_fade(20'000, fade));
    EXPECT_GT(heard[0], 19'900);
    EXPECT_EQ(heard[fade - 1], 0);
    EXPECT_EQ(heard[2 * fade], 20'000); // 5 ms fade-out, 5 ms fade-in
    EXPECT_EQ(mixer.report(Nanoseconds(0)).number, 2U);
    EXPECT_EQ(mixer.report(Nanoseconds(0)).over, 1U);
}

TEST(Mixer, NewPromptWaitsForTheMarkAndAPause) {
    Mixer mixer;
    SoundRequest wish;
    wish.say(level(second, 10'000, {{10'000, 10'100}}));
    mixer.follow(wish);
    mixed(mixer, 500);
    wish.say(level(second, -10'000));
    mixer.follow(wish);
    const std::vector<std::int16_t> heard = mixed(mixer, 20'000);
    const auto next = static_cast<std::size_t>(
        std::find_if(heard.begin(), heard.end(), [](int code) { return code < 0; }) - heard.begin());
    const std::size_t expected = 10'000 - 500 + fade + breath;
    EXPECT_GE(next, expected);
    EXPECT_LE(next, expected + 2); // its first samples round to 0
    EXPECT_LE(largest_step(heard), step_of_fade(10'000, fade));
}

TEST(Mixer, ReportsTheCurrentAndFinishedPrompts) {
    Mixer mixer;
    SoundRequest wish;
    const auto report = [&] { return mixer.report(Nanoseconds(0)); };
    EXPECT_EQ(report().over, 0U);
    wish.say(level(1000, 1, {{400, 500}}));
    mixer.follow(wish);
    EXPECT_EQ(report().over, 0U);
    mixed(mixer, 100);
    EXPECT_EQ(report().number, 1U);
    EXPECT_EQ(report().heard, duration_of(100));
    EXPECT_EQ(report().length, duration_of(1000));
    EXPECT_EQ(mixer.report(duration_of(40)).heard, duration_of(100) - duration_of(40));
    EXPECT_EQ(mixer.report(duration_of(400)).heard, Nanoseconds(0));
    wish.say(level(1000, 1));
    mixer.follow(wish);
    wish.say(level(1000, 1)); // the second prompt is never heard
    mixer.follow(wish);
    EXPECT_EQ(report().number, 1U);
    EXPECT_EQ(report().over, 0U);
    mixed(mixer, 300 + fade);
    EXPECT_EQ(report().number, 0U); // breath between prompts
    EXPECT_EQ(report().over, 2U);
    mixed(mixer, breath + 1);
    EXPECT_EQ(report().number, 3U);
    EXPECT_EQ(report().over, 2U);
    wish.leave(); // it has no mark, and plays to its end
    mixer.follow(wish);
    EXPECT_EQ(report().number, 3U);
    mixed(mixer, 1000);
    EXPECT_EQ(report().over, 3U);
    wish.say(level(1000, 1));
    wish.stop(); // before any of it was heard
    mixer.follow(wish);
    EXPECT_EQ(report().over, 4U);
    mixed(mixer, 1000);
    EXPECT_EQ(report().number, 0U);
}

TEST(Mixer, EmptyPromptEndsAtOnce) {
    Mixer mixer;
    SoundRequest wish;
    wish.say(level(0, 0));
    mixer.follow(wish);
    EXPECT_EQ(first_heard(mixed(mixer, 100)), 100U);
    EXPECT_EQ(mixer.report(Nanoseconds(0)).over, 1U);
}

TEST(Mixer, VolumeChangesSmoothly) {
    Mixer mixer;
    SoundRequest wish;
    wish.set_gain_db(-20.0);
    wish.say(level(10 * second, 10'000));
    mixer.follow(wish);
    std::vector<std::int16_t> heard = mixed(mixer, 1000);
    EXPECT_EQ(heard.back(), 1000); // the first gain is not a change
    wish.set_gain_db(0.0);
    mixer.follow(wish);
    heard = mixed(mixer, second);
    EXPECT_EQ(heard.back(), 10'000);
    EXPECT_LE(largest_step(heard), 10'000 / Mixer::gain_samples + 1);
    wish.set_gain_db(-60.0);
    mixer.follow(wish);
    EXPECT_EQ(mixed(mixer, second).back(), 0);
}

TEST(Mixer, ClampsGains) {
    EXPECT_FLOAT_EQ(amplitude_of(0.0), 1.0F);
    EXPECT_NEAR(amplitude_of(-6.0206), 0.5, 1e-6);
    EXPECT_EQ(amplitude_of(-60.0), 0.0F);
    EXPECT_EQ(amplitude_of(-1e300), 0.0F);
    EXPECT_EQ(amplitude_of(std::nan("")), 0.0F);
    EXPECT_EQ(amplitude_of(1e300), amplitude_of(12.0));
}

TEST(Mixer, LimitsWithoutClipping) {
    Mixer mixer;
    SoundRequest wish;
    wish.set_gain_db(12.0);
    wish.say(noise(second, 32'767, 8));
    mixer.follow(wish);
    for (const std::int16_t code : mixed(mixer, 2 * second)) {
        ASSERT_LE(std::abs(int{code}), 32'767);
    }
    float last = -2.0F;
    for (int k = -400; k <= 400; ++k) {
        const float x = static_cast<float>(k) / 100.0F;
        const float y = soft_limit(x);
        EXPECT_EQ(y, -soft_limit(-x));
        EXPECT_GE(y, last);
        EXPECT_LE(std::abs(y), 1.0F);
        EXPECT_LE(y - std::max(last, -1.0F), 0.01F + 1e-5F); // slope of at most 1
        if (std::abs(x) <= 0.8F) {
            EXPECT_EQ(y, x);
        }
        last = y;
    }
}

} // namespace
} // namespace frustumscreen::sound

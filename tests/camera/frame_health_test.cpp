#include "firmware_host/camera/frame_health.h"
#include "tests/camera/fake_v4l2.h"

#include <gtest/gtest.h>

namespace frustumscreen::camera {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr double rate_hz = 30.0;

/// Feeds a FrameHealth in simulated time.
struct Stream {
    MonotonicTime now{seconds(50)};
    FrameHealth judge{rate_hz, now};
    std::uint64_t number = 0;

    /// Sends frames of this look for `time`, one each `interval`; returns the last verdict.
    template <typename Look>
    FrameVerdict send(Nanoseconds time, const Look& look, Nanoseconds interval = milliseconds(33)) {
        const MonotonicTime end = now + time;
        FrameVerdict verdict = FrameVerdict::Well;
        for (; now < end; now += interval) {
            judge.see(now, look(number++));
            verdict = judge.verdict(now);
        }
        return verdict;
    }
    FrameVerdict wait(Nanoseconds time) {
        FrameVerdict verdict = FrameVerdict::Well;
        for (const MonotonicTime end = now + time; now < end; now += milliseconds(50)) {
            verdict = judge.verdict(now);
        }
        return verdict;
    }
};

FrameLook well(std::uint64_t number) {
    return look_at(noisy_ramp(64, 48, number));
}
FrameLook even(std::uint8_t code, std::uint64_t number) {
    Picture picture(64 * 48, code);
    picture[number % picture.size()] ^= 1U; // noise
    return look_at(picture);
}
FrameLook dark(std::uint64_t number) {
    return even(18, number);
}

TEST(FrameLook, MeasuresDarkestMedianAndBrightest) {
    Picture picture;
    for (int k = 0; k < 70000; ++k) {
        picture.push_back(static_cast<std::uint8_t>(k % 200)); // all codes below 200, equally often
    }
    const FrameLook look = look_at(picture);
    EXPECT_NEAR(look.darkest, 2, 1);
    EXPECT_NEAR(look.median, 100, 1);
    EXPECT_NEAR(look.brightest, 198, 1);
}

TEST(FrameLook, HashDependsOnEachByte) {
    const Picture picture = noisy_ramp(61, 3, 1); // a length not divisible by a word
    const std::uint64_t hash = look_at(picture).bytes_hash;
    EXPECT_EQ(look_at(Picture(picture)).bytes_hash, hash);
    for (std::size_t k = 0; k < picture.size(); ++k) {
        Picture other = picture;
        other[k] ^= 1U;
        EXPECT_NE(look_at(other).bytes_hash, hash) << k;
    }
    Picture longer = picture;
    longer.push_back(0);
    EXPECT_NE(look_at(longer).bytes_hash, hash);
}

TEST(FrameHealth, NoisyStreamIsHealthy) {
    Stream stream;
    EXPECT_EQ(stream.send(seconds(10), well), FrameVerdict::Well);
    EXPECT_NEAR(stream.judge.rate_hz(stream.now), 30.0, 0.5);
}

TEST(FrameHealth, ReportsADarkPictureOnlyAfterADelay) {
    Stream stream;
    static_cast<void>(stream.send(seconds(3), well));
    EXPECT_EQ(stream.send(milliseconds(450), dark), FrameVerdict::Well)
        << "a hand that passes by covers nothing";
    EXPECT_EQ(stream.send(milliseconds(200), dark), FrameVerdict::Dark);
    EXPECT_EQ(stream.send(milliseconds(450), well), FrameVerdict::Dark);
    EXPECT_EQ(stream.send(milliseconds(200), well), FrameVerdict::Well);
}

TEST(FrameHealth, ADimRoomIsNotDark) {
    Stream stream;
    const auto dim = [](std::uint64_t number) {
        Picture picture = noisy_ramp(64, 48, number);
        for (std::uint8_t& code : picture) {
            code = static_cast<std::uint8_t>(10 + code / 5); // 18 to 50
        }
        return look_at(picture);
    };
    EXPECT_EQ(stream.send(seconds(3), dim), FrameVerdict::Well);
}

TEST(FrameHealth, ReportsBlindedIfHalfThePictureIsSaturated) {
    Stream stream;
    const auto with_light = [](double share) {
        return [share](std::uint64_t number) {
            Picture picture = noisy_ramp(64, 48, number);
            std::fill_n(picture.begin(), static_cast<std::size_t>(share * 64 * 48), 255);
            return look_at(picture);
        };
    };
    EXPECT_EQ(stream.send(seconds(3), with_light(0.4)), FrameVerdict::Well)
        << "the projector's table is bright";
    EXPECT_EQ(stream.send(seconds(3), with_light(0.6)), FrameVerdict::Blinded);
    EXPECT_EQ(stream.send(seconds(3), [](auto number) { return even(235, number); }), FrameVerdict::Blinded)
        << "white in video's range";
    EXPECT_EQ(stream.send(seconds(3), [](auto number) { return even(200, number); }), FrameVerdict::Well);
}

TEST(FrameHealth, ReportsFrozenAfterASecondOfEqualFrames) {
    Stream stream;
    const FrameLook one = well(7);
    const auto same = [&](std::uint64_t) { return one; };
    static_cast<void>(stream.send(seconds(3), well));
    EXPECT_EQ(stream.send(milliseconds(900), same), FrameVerdict::Well);
    EXPECT_EQ(stream.send(milliseconds(900), same), FrameVerdict::Frozen);
    EXPECT_EQ(stream.send(milliseconds(700), well), FrameVerdict::Well);
    // Occasionally repeated frames, like a camera that duplicates frames in the dark.
    EXPECT_EQ(stream.send(seconds(5), [](std::uint64_t number) { return well(number / 2); }),
              FrameVerdict::Well);
}

TEST(FrameHealth, DarkAndBlindedTakePrecedenceOverFrozen) {
    Stream stream;
    const FrameLook black = look_at(Picture(64 * 48, 16));
    const FrameLook white = look_at(Picture(64 * 48, 255));
    EXPECT_EQ(stream.send(seconds(4), [&](std::uint64_t) { return black; }), FrameVerdict::Dark);
    EXPECT_EQ(stream.send(seconds(4), [&](std::uint64_t) { return white; }), FrameVerdict::Blinded);
}

TEST(FrameHealth, ReportsSlowBelowHalfTheRate) {
    Stream stream;
    EXPECT_EQ(stream.send(seconds(5), well, milliseconds(60)), FrameVerdict::Well) << "17 Hz of 30";
    EXPECT_EQ(stream.send(seconds(5), well, milliseconds(75)), FrameVerdict::Slow) << "13 Hz of 30";
    EXPECT_NEAR(stream.judge.rate_hz(stream.now), 13.3, 0.6);
    EXPECT_EQ(stream.send(seconds(3), well), FrameVerdict::Well);
}

TEST(FrameHealth, SkippedFramesCountForTheRate) {
    Stream stream;
    FrameVerdict verdict = FrameVerdict::Well;
    for (int k = 0; k < 60; ++k, stream.now += milliseconds(100)) { // ten checks per second of thirty frames
        stream.judge.see(stream.now, well(stream.number++), 2);
        verdict = stream.judge.verdict(stream.now);
    }
    EXPECT_EQ(verdict, FrameVerdict::Well);
}

TEST(FrameHealth, ReportsAPauseAsSilentAndItsEndNotAsSlow) {
    Stream stream;
    static_cast<void>(stream.send(seconds(3), well));
    EXPECT_EQ(stream.wait(milliseconds(950)), FrameVerdict::Well);
    EXPECT_EQ(stream.wait(milliseconds(700)), FrameVerdict::Silent);
    for (int k = 0; k < 100; ++k) {
        EXPECT_NE(stream.send(milliseconds(33), well), FrameVerdict::Slow) << k;
    }
    EXPECT_EQ(stream.judge.verdict(stream.now), FrameVerdict::Well);
}

TEST(FrameHealth, ReportsSilentIfNoFrameArrivesAfterTheStart) {
    Stream stream;
    EXPECT_EQ(stream.wait(milliseconds(1950)), FrameVerdict::Well);
    EXPECT_EQ(stream.wait(milliseconds(700)), FrameVerdict::Silent);
}

TEST(FrameHealth, OneHertzCameraIsNeitherSlowNorSilent) {
    MonotonicTime now(seconds(50));
    FrameHealth judge(1.0, now);
    for (int k = 0; k < 200; ++k, now += milliseconds(100)) {
        if (k % 10 == 0) {
            judge.see(now, well(static_cast<std::uint64_t>(k)));
        }
        EXPECT_EQ(judge.verdict(now), FrameVerdict::Well) << k;
    }
}

} // namespace
} // namespace frustumscreen::camera

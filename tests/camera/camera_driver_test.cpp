#include "firmware_host/camera/camera_driver.h"
#include "tests/camera/fake_v4l2.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <cerrno>

namespace frustumscreen::camera {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A driver over fake cameras, on simulated time: the first camera's clock.
struct Driven {
    explicit Driven(CameraRequest wish = {}, std::vector<FakeCamera*> more = {}, FrameUse use = {},
                    CpuThrottle share = CpuThrottle(1.0))
        : driver(
              [&] {
                  make_usual(camera);
                  for (FakeCamera* const other : more) {
                      other->now = camera.now;
                  }
                  std::vector<FakeCamera*> all{&camera};
                  all.insert(all.end(), more.begin(), more.end());
                  return std::make_unique<FakeDevices>(all);
              }(),
              std::move(wish), [this] { return now(); }, std::move(use), std::move(share)) {}

    /// Steps for this time; returns the number of frames.
    int run(Nanoseconds time) {
        int frames = 0;
        for (const MonotonicTime end = now() + time; now() < end;) {
            const auto [fresh, pause] = driver.step(frame);
            frames += fresh ? 1 : 0;
            now() += pause;
        }
        return frames;
    }
    /// Steps until the driver reports `state`; returns the time this took, a minute at most.
    Nanoseconds until(CameraState state) {
        const MonotonicTime begin = now();
        MonotonicTime told = begin;
        while (driver.state() != state && now() < begin + seconds(60)) {
            const Nanoseconds pause = driver.step(frame).pause;
            told = now();
            now() += pause;
        }
        return told - begin;
    }

    [[nodiscard]] MonotonicTime& now() const { return *camera.now; }

    FakeCamera camera;
    CameraDriver driver;
    CameraFrame frame;
};

TEST(CameraDriver, SetsUpACameraAndPassesItsFramesOn) {
    Driven driven;
    EXPECT_NEAR(driven.run(seconds(2)), 60, 1);
    EXPECT_EQ(driven.driver.state(), CameraState::Running);
    const std::optional<CameraSetUp>& set_up = driven.driver.set_up();
    ASSERT_TRUE(set_up);
    EXPECT_EQ(set_up->name, "Fake Camera");
    EXPECT_EQ(set_up->mode, (CameraMode{PixelFormat::Grey, 64, 48, 30.0}));
    EXPECT_EQ(set_up->controls.size(), 3U);
    const CameraFrame& frame = driven.frame;
    EXPECT_EQ(frame.luma, noisy_ramp(64, 48, frame.number - 1));
    EXPECT_GE(frame.time, driven.now() - milliseconds(34));
    EXPECT_LE(frame.time, driven.now());
    EXPECT_NEAR(driven.driver.rate_hz(), 30.0, 1.0);
}

/// Each frame takes 20 ms of CPU time, i.e. 80 ms at a quarter of a core: 12.5 of 30 frames per second are
/// used, and the camera is healthy.
TEST(CameraDriver, SkipsFramesToKeepItsCpuShare) {
    double busy_s = 0.0;
    int used = 0;
    std::uint64_t decoded = 0;
    Driven driven(
        {}, {},
        [&](const CameraFrame&) {
            ++used;
            busy_s += 0.02;
        },
        CpuThrottle(0.25, [&busy_s] { return busy_s; }));
    driven.run(seconds(2));
    decoded = driven.driver.counts().frames;
    EXPECT_NEAR(used, 25, 2);
    EXPECT_EQ(decoded, static_cast<std::uint64_t>(used));
    EXPECT_NEAR(static_cast<double>(driven.driver.counts().skipped), 60.0 - used, 2.0);
    driven.run(seconds(3));
    EXPECT_EQ(driven.driver.state(), CameraState::Running);
    EXPECT_NEAR(driven.driver.rate_hz(), 30.0, 1.0); // arrived frames, not used ones
    EXPECT_NEAR(busy_s / 5.0, 0.25, 0.01);
}

/// Nine milliseconds are 27 per cent of a core at 30 Hz: one frame of thirteen is skipped, not every other
/// one.
TEST(CameraDriver, SkipsFewFramesIfTheyCostSlightlyTooMuch) {
    double busy_s = 0.0;
    Driven driven(
        {}, {}, [&busy_s](const CameraFrame&) { busy_s += 0.009; },
        CpuThrottle(0.25, [&busy_s] { return busy_s; }));
    driven.run(seconds(10));
    EXPECT_NEAR(static_cast<double>(driven.driver.counts().frames), 0.25 / 0.009 * 10.0, 3.0);
}

TEST(CameraDriver, RunsAgainWithinTwoSecondsOfReplugging) {
    Driven driven;
    static_cast<void>(driven.run(seconds(2)));
    for (int k = 0; k < 20; ++k) {
        driven.camera.plugged = false;
        EXPECT_LT(driven.until(CameraState::NotConnected), milliseconds(100));
        static_cast<void>(driven.run(milliseconds(137 * k)));
        driven.camera.plugged = true;
        EXPECT_LT(driven.until(CameraState::Running), seconds(2)) << k;
    }
    EXPECT_EQ(driven.driver.counts().connections, 21U);
    EXPECT_EQ(driven.camera.streams, 1);
    EXPECT_EQ(driven.camera.unmapped, 20 * 4) << "the buffers of those that are gone";
}

TEST(CameraDriver, ReportsDarkBlindedFrozenAndSlowPictures) {
    Driven driven;
    static_cast<void>(driven.run(seconds(3)));
    const auto usual = driven.camera.picture;
    const auto even = [](int code) {
        return [code](std::uint64_t number) {
            Picture picture(64 * 48, static_cast<std::uint8_t>(code));
            picture[number % picture.size()] ^= 1U;
            return picture;
        };
    };
    const std::vector<std::pair<std::function<Picture(std::uint64_t)>, CameraState>> faults{
        {even(17), CameraState::Dark},
        {even(254), CameraState::Blinded},
        {[](std::uint64_t) { return noisy_ramp(64, 48, 1); }, CameraState::Frozen}};
    for (const auto& [picture, state] : faults) {
        driven.camera.picture = picture;
        EXPECT_LT(driven.until(state), seconds(2)) << sentence_of(state);
        EXPECT_EQ(health_of(driven.driver.state()), CameraHealth::Impaired);
        driven.camera.picture = usual;
        EXPECT_LT(driven.until(CameraState::Running), seconds(2)) << sentence_of(state);
    }
    driven.camera.slower = 3.0;
    EXPECT_LT(driven.until(CameraState::Slow), seconds(3));
    driven.camera.slower = 1.0;
    EXPECT_LT(driven.until(CameraState::Running), seconds(3));
    EXPECT_EQ(driven.driver.counts().connections, 1U) << "none of this needs a new set-up";
}

TEST(CameraDriver, ReportsASilentCameraAndSetsItUpAgainUntilItSends) {
    Driven driven;
    static_cast<void>(driven.run(seconds(3)));
    driven.camera.sends = false;
    EXPECT_LT(driven.until(CameraState::Silent), seconds(2));
    for (int k = 0; k < 100; ++k) {
        static_cast<void>(driven.run(milliseconds(100)));
        EXPECT_EQ(driven.driver.state(), CameraState::Silent) << "also while it is set up again";
    }
    EXPECT_GT(driven.driver.counts().connections, 2U);
    driven.camera.sends = true;
    EXPECT_LT(driven.until(CameraState::Running), seconds(2));
}

TEST(CameraDriver, CountsAndReportsBrokenFrames) {
    Driven driven;
    static_cast<void>(driven.run(seconds(3)));
    driven.camera.marks_broken = true;
    EXPECT_LT(driven.until(CameraState::Broken), seconds(2));
    EXPECT_GT(driven.driver.counts().broken, 20U);
    driven.camera.marks_broken = false;
    EXPECT_LT(driven.until(CameraState::Running), seconds(2));
    driven.camera.picture = [](std::uint64_t number) {
        Picture picture = noisy_ramp(64, 48, number);
        picture.pop_back();
        return picture;
    };
    EXPECT_LT(driven.until(CameraState::Broken), seconds(2)) << "one byte is missing";
}

TEST(CameraDriver, MissingNumbersAreCounted) {
    Driven driven;
    static_cast<void>(driven.run(seconds(1)));
    driven.camera.skips = 7;
    static_cast<void>(driven.run(seconds(1)));
    EXPECT_EQ(driven.driver.counts().lost, 7U);
}

TEST(CameraDriver, ReportsWhyACameraCannotBeOpened) {
    const std::vector<std::pair<int, CameraState>> reasons{{EACCES, CameraState::NoPermission},
                                                           {EBUSY, CameraState::InUse},
                                                           {EIO, CameraState::CannotBeOpened},
                                                           {ENODEV, CameraState::NotConnected}};
    Driven driven;
    for (const auto& [error, state] : reasons) {
        driven.camera.open_error = error;
        static_cast<void>(driven.run(seconds(1)));
        EXPECT_EQ(driven.driver.state(), state) << error;
    }
    driven.camera.open_error = 0;
    driven.camera.start_error = EBUSY;
    static_cast<void>(driven.run(seconds(1)));
    EXPECT_EQ(driven.driver.state(), CameraState::InUse);
    driven.camera.start_error = ENOSPC; // not enough USB bandwidth
    static_cast<void>(driven.run(seconds(1)));
    EXPECT_EQ(driven.driver.state(), CameraState::SetUpRefused);
    driven.camera.start_error = 0;
    EXPECT_LT(driven.until(CameraState::Running), seconds(1));
}

TEST(CameraDriver, RunsAndReportsAnUnlockableExposure) {
    Driven driven;
    driven.camera.controls[V4L2_CID_EXPOSURE_AUTO].stubborn = true;
    static_cast<void>(driven.run(seconds(1)));
    EXPECT_EQ(driven.driver.state(), CameraState::Unlocked);
    EXPECT_EQ(health_of(driven.driver.state()), CameraHealth::Well);
}

TEST(CameraDriver, SelectsACameraByNameOrPath) {
    FakeCamera second;
    make_usual(second);
    second.name = "Above the table";
    for (const char* device : {"Above the table", "/dev/video1"}) {
        CameraRequest wish;
        wish.device = device;
        Driven driven(wish, {&second});
        static_cast<void>(driven.run(milliseconds(100)));
        ASSERT_TRUE(driven.driver.set_up()) << device;
        EXPECT_EQ(driven.driver.set_up()->name, "Above the table");
        EXPECT_EQ(driven.camera.started, 0);
        second.plugged = false;
        static_cast<void>(driven.run(seconds(1)));
        EXPECT_EQ(driven.driver.state(), CameraState::NotConnected) << "another camera is no replacement";
        second.plugged = true;
    }
}

TEST(CameraDriver, TriesAnotherCameraIfOneNeverSends) {
    FakeCamera second;
    make_usual(second);
    second.sends = false;
    Driven driven({}, {&second});
    driven.camera.sends = false;
    static_cast<void>(driven.run(seconds(20)));
    EXPECT_GT(driven.camera.started, 1);
    EXPECT_GT(second.started, 1) << "the one that failed last is tried last";
}

TEST(ListCameras, ListsAvailableCamerasWithTheirModes) {
    FakeCamera one;
    FakeCamera two;
    FakeCamera held;
    for (FakeCamera* camera : {&one, &two, &held}) {
        make_usual(*camera);
    }
    held.open_error = EBUSY;
    two.name = "Two";
    FakeDevices devices({&one, &held, &two});
    const std::vector<FoundCamera> found = list_cameras(devices, {});
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[1].path, "/dev/video2");
    EXPECT_EQ(found[1].name, "Two");
    EXPECT_EQ(found[1].modes.size(), 4U);
}

} // namespace
} // namespace frustumscreen::camera

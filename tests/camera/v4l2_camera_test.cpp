#include "firmware_host/camera/v4l2_camera.h"
#include "tests/base/comes_true.h"
#include "tests/camera/fake_v4l2.h"

#include <gtest/gtest.h>

namespace frustumscreen::camera {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(V4l2Camera, DeliversEachFrameOnceAndReconnects) {
    FakeCamera fake;
    make_usual(fake);
    fake.real_time = true;
    V4l2Camera camera(std::make_unique<FakeDevices>(std::vector{&fake}), {});
    CameraFrame frame;
    std::uint64_t last = 0;
    std::uint64_t sequence = 0;
    const auto next = [&] {
        if (!camera.poll(frame)) {
            return false;
        }
        EXPECT_GT(frame.number, last);
        last = frame.number;
        return true;
    };
    ASSERT_TRUE(comes_true([&] { return next() && ++sequence == 10; }));
    EXPECT_TRUE(comes_true([&] { return camera.state() == CameraState::Running; }));
    EXPECT_EQ(frame.luma, noisy_ramp(64, 48, frame.number - 1));
    ASSERT_TRUE(camera.set_up());
    EXPECT_EQ(camera.set_up()->path, "/dev/video0");
    EXPECT_GT(camera.alive_until(), monotonic_now());

    fake.plugged = false;
    ASSERT_TRUE(comes_true([&] { return camera.state() == CameraState::NotConnected; }));
    static_cast<void>(next()); // one frame may have been waiting
    EXPECT_FALSE(camera.poll(frame)) << "an old frame is handed on once";
    fake.plugged = true;
    ASSERT_TRUE(comes_true([&] { return next(); }));
    EXPECT_EQ(camera.counts().connections, 2U);
    EXPECT_GE(camera.counts().frames, last);
}

TEST(FrameMailbox, RecyclesFrameBuffersWithoutCopying) {
    FrameMailbox mailbox;
    CameraFrame filled;
    CameraFrame taken;
    for (CameraFrame* frame : {&filled, &taken}) {
        frame->luma.resize(100);
    }
    EXPECT_FALSE(mailbox.try_take(taken));
    const std::uint8_t* const memory = filled.luma.data();
    filled.number = 1;
    mailbox.put(filled);
    EXPECT_TRUE(filled.luma.empty()) << "the mailbox's first, which has no memory yet";
    filled.number = 2;
    filled.luma.resize(100);
    mailbox.put(filled);
    EXPECT_EQ(filled.luma.data(), memory) << "the first one was not taken, and is filled again";
    ASSERT_TRUE(mailbox.try_take(taken));
    EXPECT_EQ(taken.number, 2U);
    EXPECT_FALSE(mailbox.try_take(taken));
}

} // namespace
} // namespace frustumscreen::camera

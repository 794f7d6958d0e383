#include "firmware_host/camera/v4l2_controls.h"
#include "tests/camera/fake_v4l2.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

namespace frustumscreen::camera {
namespace {

/// Exposure, gain, white balance.
std::vector<LockedControl> locked(FakeCamera& camera, const CameraRequest& wish) {
    const auto device = FakeDevices({&camera}).open("/dev/video0");
    return device ? lock_controls(**device, wish) : std::vector<LockedControl>();
}

TEST(CameraControls, DisablesAutomaticsAndKeepsTheCamerasValues) {
    FakeCamera camera;
    make_usual(camera);
    const auto controls = locked(camera, {});
    ASSERT_EQ(controls.size(), 3U);
    EXPECT_EQ(controls[0].name, "exposure");
    EXPECT_EQ(controls[0].lock, Lock::Locked);
    EXPECT_DOUBLE_EQ(controls[0].value, 33.3);
    EXPECT_EQ(controls[1].lock, Lock::Locked);
    EXPECT_EQ(controls[1].value, 16.0);
    EXPECT_EQ(controls[2].lock, Lock::Locked);
    EXPECT_EQ(controls[2].value, 4600.0);
    EXPECT_EQ(camera.controls[V4L2_CID_EXPOSURE_AUTO].value, V4L2_EXPOSURE_MANUAL);
    EXPECT_EQ(camera.controls[V4L2_CID_AUTO_WHITE_BALANCE].value, 0);
}

TEST(CameraControls, SetsRequestedValuesAndReadsThemBack) {
    FakeCamera camera;
    make_usual(camera);
    CameraRequest wish;
    wish.exposure_ms = 8.0;
    wish.gain = 1000; // more than its maximum
    wish.white_balance_k = 5200;
    const auto controls = locked(camera, wish);
    EXPECT_EQ(camera.controls[V4L2_CID_EXPOSURE_ABSOLUTE].value, 80) << "tenths of a millisecond";
    EXPECT_EQ(controls[0].lock, Lock::Locked);
    EXPECT_DOUBLE_EQ(controls[0].value, 8.0);
    EXPECT_EQ(controls[1].lock, Lock::Changed);
    EXPECT_EQ(controls[1].value, 255.0);
    EXPECT_EQ(controls[2].value, 5200.0);
}

TEST(CameraControls, DistinguishesRefusedFromMissingControls) {
    FakeCamera camera;
    make_usual(camera);
    camera.controls[V4L2_CID_EXPOSURE_AUTO].stubborn = true;
    camera.controls.erase(V4L2_CID_AUTO_WHITE_BALANCE);
    camera.controls.erase(V4L2_CID_WHITE_BALANCE_TEMPERATURE);
    CameraRequest wish;
    wish.exposure_ms = 8.0;
    wish.white_balance_k = 5200;
    const auto controls = locked(camera, wish);
    EXPECT_EQ(controls[0].lock, Lock::Refused);
    EXPECT_EQ(controls[1].lock, Lock::Locked);
    EXPECT_EQ(controls[2].lock, Lock::NotThere);
}

TEST(CameraControls, DisablesExposurePriority) {
    FakeCamera camera;
    make_usual(camera);
    camera.controls[V4L2_CID_EXPOSURE_AUTO_PRIORITY] = {1, 0, 1};
    static_cast<void>(locked(camera, {}));
    EXPECT_EQ(camera.controls[V4L2_CID_EXPOSURE_AUTO_PRIORITY].value, 0);
}

} // namespace
} // namespace frustumscreen::camera

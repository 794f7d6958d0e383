// Each frame is judged. A hand that covers the lens is reported after half a second.
#include "firmware_host/camera/camera.h"
#include "firmware_host/camera/frame_health.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Camera) {
    // example
    camera::CameraFrame frame;
    frame.luma.assign(640 * 480, 4); // almost black
    camera::FrameHealth health(30.0, frame.time);
    for (int k = 0; k < 30; ++k) {
        frame.time += std::chrono::milliseconds(33);
        health.see(frame.time, camera::look_at(frame.luma));
        EXPECT_EQ(health.verdict(frame.time),
                  k < 16 ? camera::FrameVerdict::Well : camera::FrameVerdict::Dark)
            << k;
    }
    // end
}

} // namespace
} // namespace frustumscreen::example

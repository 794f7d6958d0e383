#include "firmware_host/camera/v4l2_mode.h"
#include "tests/camera/fake_v4l2.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <cerrno>

namespace frustumscreen::camera {
namespace {

std::unique_ptr<V4l2Device> device_of(FakeCamera& camera) {
    auto device = FakeDevices({&camera}).open("/dev/video0");
    EXPECT_TRUE(device);
    return std::move(*device);
}

/// A typical webcam: uncompressed pictures are fast only at small sizes.
void make_webcam(FakeCamera& camera) {
    make_usual(camera);
    camera.formats = {{V4L2_PIX_FMT_MJPEG, {{1920, 1080, {30, 15}}, {1280, 720, {60, 30}}, {640, 480, {30}}}},
                      {V4L2_PIX_FMT_YUYV, {{640, 480, {30, 15}}, {1280, 720, {10, 5}}}},
                      {V4L2_PIX_FMT_H264, {{1280, 720, {30}}}}};
}

CameraRequest wish_of(int width, int height, double rate_hz) {
    CameraRequest wish;
    wish.width = width;
    wish.height = height;
    wish.rate_hz = rate_hz;
    return wish;
}

TEST(CameraMode, ListsAllReadableModes) {
    FakeCamera camera;
    make_webcam(camera);
    const auto device = device_of(camera);
    const std::vector<CameraMode> modes = list_modes(*device, {});
    EXPECT_EQ(modes.size(), 5U + 4U) << "and none in H.264";
    EXPECT_EQ(modes.front(), (CameraMode{PixelFormat::Mjpeg, 1920, 1080, 30.0}));
}

TEST(CameraMode, PrefersSizeThenRateThenTheCheapestFormat) {
    FakeCamera camera;
    make_webcam(camera);
    const auto device = device_of(camera);
    const auto chosen = [&device](const CameraRequest& wish) {
        return choose_mode(list_modes(*device, wish), wish).value_or(CameraMode{});
    };
    EXPECT_EQ(chosen(wish_of(1280, 720, 30)), (CameraMode{PixelFormat::Mjpeg, 1280, 720, 30}));
    EXPECT_EQ(chosen(wish_of(1280, 720, 10)), (CameraMode{PixelFormat::Yuyv, 1280, 720, 10}));
    EXPECT_EQ(chosen(wish_of(640, 480, 30)), (CameraMode{PixelFormat::Yuyv, 640, 480, 30}));
    EXPECT_EQ(chosen(wish_of(700, 500, 29.97)), (CameraMode{PixelFormat::Yuyv, 640, 480, 30}));
    EXPECT_EQ(chosen(wish_of(1920, 1080, 60)), (CameraMode{PixelFormat::Mjpeg, 1920, 1080, 30}))
        << "the fastest, where none is fast enough";
    EXPECT_FALSE(choose_mode({}, {}));
}

/// vivid, and cameras on a chip's own bus, report ranges.
class RangeDevice final : public V4l2Device {
public:
    int control(unsigned long request, void* argument) override {
        if (request == VIDIOC_ENUM_FMT && static_cast<v4l2_fmtdesc*>(argument)->index == 0) {
            static_cast<v4l2_fmtdesc*>(argument)->pixelformat = V4L2_PIX_FMT_GREY;
            return 0;
        }
        if (request == VIDIOC_ENUM_FRAMESIZES && static_cast<v4l2_frmsizeenum*>(argument)->index == 0) {
            auto& size = *static_cast<v4l2_frmsizeenum*>(argument);
            size.type = V4L2_FRMSIZE_TYPE_STEPWISE;
            size.stepwise = {32, 1600, 16, 32, 1200, 8};
            return 0;
        }
        if (request == VIDIOC_ENUM_FRAMEINTERVALS && static_cast<v4l2_frmivalenum*>(argument)->index == 0) {
            auto& rate = *static_cast<v4l2_frmivalenum*>(argument);
            rate.type = V4L2_FRMIVAL_TYPE_STEPWISE;
            rate.stepwise = {{1, 50}, {1, 5}, {1, 1}};
            return 0;
        }
        return EINVAL;
    }
    int wait(Nanoseconds) override { return EAGAIN; }
    tl::expected<std::span<const std::byte>, int> map(std::size_t, std::size_t) override {
        return tl::unexpected(EINVAL);
    }
};

TEST(CameraMode, PicksTheNearestSizeAndRateOfARange) {
    RangeDevice device;
    const auto modes = [&device](const CameraRequest& wish) { return list_modes(device, wish); };
    EXPECT_EQ(modes(wish_of(700, 500, 30)), (std::vector{CameraMode{PixelFormat::Grey, 688, 496, 30}}));
    EXPECT_EQ(modes(wish_of(4000, 10, 100)), (std::vector{CameraMode{PixelFormat::Grey, 1600, 32, 50}}));
    EXPECT_EQ(modes(wish_of(64, 64, 1)), (std::vector{CameraMode{PixelFormat::Grey, 64, 64, 5}}));
}

/// A device with endless lists.
class EndlessDevice final : public V4l2Device {
public:
    int control(unsigned long request, void* argument) override {
        if (request == VIDIOC_ENUM_FMT) {
            static_cast<v4l2_fmtdesc*>(argument)->pixelformat = V4L2_PIX_FMT_GREY;
        } else if (request == VIDIOC_ENUM_FRAMESIZES) {
            auto& size = *static_cast<v4l2_frmsizeenum*>(argument);
            size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
            size.discrete = {64 + size.index,
                             0xFFFFFFFFU - size.index % 2 * 0xFFFFFFF0U}; // half of them absurd
        } else if (request == VIDIOC_ENUM_FRAMEINTERVALS) {
            auto& rate = *static_cast<v4l2_frmivalenum*>(argument);
            rate.type = V4L2_FRMIVAL_TYPE_DISCRETE;
            rate.discrete = {rate.index % 2, 0}; // rate zero or invalid
        }
        return 0;
    }
    int wait(Nanoseconds) override { return EAGAIN; }
    tl::expected<std::span<const std::byte>, int> map(std::size_t, std::size_t) override {
        return tl::unexpected(EINVAL);
    }
};

TEST(CameraMode, LimitsEndlessLists) {
    EndlessDevice device;
    const std::vector<CameraMode> modes = list_modes(device, {});
    EXPECT_EQ(modes.size(), 64U * 64U * 64U); // formats, half of the sizes, rates
    EXPECT_TRUE(choose_mode(modes, {}));
}

TEST(CameraMode, ReadsBackTheModeThatTheDriverSet) {
    FakeCamera camera;
    make_usual(camera);
    camera.row_padding = 64;
    const auto set = set_mode(*device_of(camera), {PixelFormat::Yuyv, 1280, 720, 24.0});
    ASSERT_TRUE(set);
    EXPECT_EQ(set->frame.format, PixelFormat::Yuyv);
    EXPECT_EQ(set->frame.width, 64);
    EXPECT_EQ(set->frame.height, 48);
    EXPECT_EQ(set->frame.row_bytes, 2 * 64 + 64U);
    EXPECT_EQ(set->rate_hz, 30.0);
}

TEST(CameraMode, RateIsZeroIfTheDriverReportsNone) {
    FakeCamera camera;
    make_usual(camera);
    camera.formats.front().sizes.front().rates_hz.clear();
    const auto set = set_mode(*device_of(camera), {PixelFormat::Grey, 64, 48, 0.0});
    ASSERT_TRUE(set);
    EXPECT_EQ(set->rate_hz, 0.0);
}

TEST(CameraMode, DistinguishesInUseRefusedAndNoFormat) {
    FakeCamera camera;
    make_usual(camera);
    const auto device = device_of(camera);
    camera.format_error = EBUSY;
    EXPECT_EQ(set_mode(*device, {PixelFormat::Grey, 64, 48, 30.0}).error(), CameraState::InUse);
    camera.format_error = EIO;
    EXPECT_EQ(set_mode(*device, {PixelFormat::Grey, 64, 48, 30.0}).error(), CameraState::SetUpRefused);
    camera.format_error = 0;
    camera.formats = {{V4L2_PIX_FMT_H264, {{64, 48, {30}}}}};
    EXPECT_EQ(set_mode(*device, {PixelFormat::Grey, 64, 48, 30.0}).error(), CameraState::NoFormat);
}

} // namespace
} // namespace frustumscreen::camera

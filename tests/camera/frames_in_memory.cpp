// Takes frames for a second, in each format and while the camera is covered, frozen and unplugged, and prints
// their number. keeps_nothing_test runs it under strace.
//
//   frames_in_memory [FILE]     FILE: does the forbidden thing: one frame is written there
#include "firmware_host/camera/v4l2_camera.h"
#include "tests/camera/fake_v4l2.h"

#include <linux/videodev2.h>
#include <turbojpeg.h>

#include <cstdio>
#include <thread>

namespace frustumscreen::camera {
namespace {

Picture jpeg_of(const Picture& grey) {
    tjhandle handle = ::tjInitCompress();
    unsigned char* file = nullptr;
    unsigned long size = 0;
    ::tjCompress2(handle, grey.data(), 64, 0, 48, TJPF_GRAY, &file, &size, TJSAMP_GRAY, 90, 0);
    Picture bytes(file, file + size);
    ::tjFree(file);
    ::tjDestroy(handle);
    return bytes;
}

std::uint64_t frames_of(std::uint32_t fourcc, CameraFrame& frame) {
    FakeCamera fake;
    make_usual(fake);
    fake.real_time = true;
    fake.formats = {{fourcc, {{64, 48, {100}}}}};
    fake.picture = [fourcc](std::uint64_t number) {
        const std::uint64_t shown = number % 100 < 50 ? number : 1; // frozen at times
        const Picture grey = number % 50 < 40 ? noisy_ramp(64, 48, shown) : Picture(64 * 48, 16);
        return fourcc == V4L2_PIX_FMT_MJPEG  ? jpeg_of(grey)
               : fourcc == V4L2_PIX_FMT_YUYV ? noisy_ramp(64, 48, shown, 2)
                                             : grey;
    };
    V4l2Camera camera(std::make_unique<FakeDevices>(std::vector{&fake}), {});
    std::uint64_t taken = 0;
    for (int k = 0; taken < 20 && k < 20'000; ++k) {
        taken += camera.poll(frame) ? 1 : 0;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    fake.plugged = false;
    for (int k = 0; camera.state() != CameraState::NotConnected && k < 20'000; ++k) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return taken;
}

} // namespace
} // namespace frustumscreen::camera

int main(int argc, char** argv) {
    using namespace frustumscreen;
    using namespace frustumscreen::camera;
    CameraFrame frame;
    unsigned long frames = 0;
    for (const std::uint32_t fourcc : {V4L2_PIX_FMT_GREY, V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_MJPEG}) {
        frames += frames_of(fourcc, frame);
    }
    // The machine's own devices too: only queries them.
    const auto devices = kernel_v4l2_devices();
    static_cast<void>(list_cameras(*devices, {}));
    static_cast<void>(devices->open("/dev/video_that_is_none"));
    if (argc > 1) {
        std::FILE* const file = std::fopen(argv[1], "wb");
        std::fwrite(frame.luma.data(), 1, frame.luma.size(), file);
        std::fclose(file);
    }
    std::printf("%lu frames\n", frames);
}

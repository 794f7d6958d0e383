#include "firmware_host/display/drawing_gpu.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <string>
#include <vector>

extern "C" {
#include <gbm.h>
#include <xf86drm.h>
}

namespace frustumscreen::display {

namespace {

/// Render nodes of the other GPUs, in the kernel's order.
std::vector<std::string> other_render_nodes(int card) {
    const std::unique_ptr<char, decltype(&std::free)> own(drmGetRenderDeviceNameFromFd(card), std::free);
    std::array<drmDevicePtr, 16> devices{};
    const int count = drmGetDevices2(0, devices.data(), static_cast<int>(devices.size()));
    std::vector<std::string> paths;
    for (int k = 0; k < count; ++k) {
        const drmDevice& device = *devices.at(static_cast<std::size_t>(k));
        if ((device.available_nodes & (1 << DRM_NODE_RENDER)) != 0) {
            const std::string path = device.nodes[DRM_NODE_RENDER];
            if (own == nullptr || path != own.get()) {
                paths.push_back(path);
            }
        }
    }
    if (count > 0) {
        drmFreeDevices(devices.data(), count);
    }
    return paths;
}

void destroy_and_close(gbm_device* device) {
    const int file = gbm_device_get_fd(device);
    gbm_device_destroy(device);
    ::close(file);
}

} // namespace

Result<DrawingGpu> DrawingGpu::choose_for(int card) {
    Result<DrawingGpu> own = on(Device(gbm_create_device(card), gbm_device_destroy), true);
    if (own && !draws_on_processor(gl_driver_name())) {
        return own;
    }
    for (const std::string& path : other_render_nodes(card)) {
        if (Result<DrawingGpu> other = on_render_node(path.c_str());
            other && !draws_on_processor(gl_driver_name())) {
            return other;
        }
    }
    if (own) {
        if (own->context_.make_current()) {
            return own;
        }
        return fail(ErrorKind::Internal, "display.context_lost",
                    "display: the OpenGL ES context cannot be made current again");
    }
    Result<EglContext> context = EglContext::without_screen();
    if (!context) {
        return tl::unexpected<Error>(own.error());
    }
    return DrawingGpu(Device(nullptr, gbm_device_destroy), std::move(*context), false);
}

Result<DrawingGpu> DrawingGpu::on(Device device, bool shows) {
    if (!device) {
        return fail(ErrorKind::BadConfiguration, "display.no_gbm",
                    "display: no memory for pictures on the graphics card (GBM); install libgl1-mesa-dri");
    }
    TRY(EglContext context, EglContext::on_gbm(device.get()));
    return DrawingGpu(std::move(device), std::move(context), shows);
}

Result<DrawingGpu> DrawingGpu::on_render_node(const char* path) {
    const int file = ::open(path, O_RDWR | O_CLOEXEC);
    Device device(file >= 0 ? gbm_create_device(file) : nullptr, destroy_and_close);
    if (!device && file >= 0) {
        ::close(file);
    }
    return on(std::move(device), false);
}

} // namespace frustumscreen::display

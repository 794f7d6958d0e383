// The display's libgbm functions, and the libdrm functions that list GPUs, on the fake kernel. They are
// hidden: Mesa continues to use the real ones.
#include "tests/display/fake_gbm.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

using namespace frustumscreen;
using namespace frustumscreen::display;

namespace {

/// A device in the form of drmGetDevices2.
struct Device {
    explicit Device(const FakeGpu& gpu) : path(gpu.path) {
        nodes.fill(no_path.data());
        nodes[DRM_NODE_RENDER] = path.data();
        device.nodes = nodes.data();
        device.available_nodes = path.empty() ? 1 << DRM_NODE_PRIMARY : 1 << DRM_NODE_RENDER;
    }
    std::string path, no_path;
    std::array<char*, DRM_NODE_MAX> nodes{};
    drmDevice device{};
};

} // namespace

#pragma GCC visibility push(hidden)
extern "C" {

gbm_device* gbm_create_device(int number) {
    FakeKernel& kernel = FakeKernel::instance();
    const FakeFile* file = kernel.file(number);
    const int error = kernel.enter("gbm_create_device");
    if (error != 0 || file == nullptr || (file->card != nullptr && !file->card->has_gbm)) {
        errno = error != 0 ? error : ENOSYS;
        return nullptr;
    }
    const auto made = std::make_shared<gbm_device>(
        gbm_device{number, file->card != nullptr ? file->card->renderer : file->renderer});
    kernel.hand_out(made.get(), "GBM device", made);
    return made.get();
}
void gbm_device_destroy(gbm_device* device) {
    FakeKernel::instance().give_back(device, "GBM device");
}
int gbm_device_get_fd(gbm_device* device) {
    return device->file;
}

gbm_bo* gbm_bo_create(gbm_device* device, std::uint32_t width, std::uint32_t height, std::uint32_t /*format*/,
                      std::uint32_t /*use*/) {
    FakeKernel& kernel = FakeKernel::instance();
    FakeFile& file = *kernel.file(device->file);
    errno = kernel.enter("gbm_bo_create");
    if (errno != 0) {
        return nullptr;
    }
    const auto made = std::make_shared<gbm_bo>();
    made->file = device->file;
    made->width = static_cast<int>(width);
    made->height = static_cast<int>(height);
    made->handle = file.card->create_buffer(file, width, height);
    kernel.hand_out(made.get(), "GBM buffer", made);
    return made.get();
}
void gbm_bo_destroy(gbm_bo* buffer) {
    FakeFile& file = *FakeKernel::instance().file(buffer->file);
    file.card->destroy_buffer(file, buffer->handle);
    FakeKernel::instance().give_back(buffer, "GBM buffer");
}
union gbm_bo_handle gbm_bo_get_handle(gbm_bo* buffer) {
    gbm_bo_handle handle{};
    handle.u32 = buffer->handle;
    return handle;
}
std::uint32_t gbm_bo_get_stride(gbm_bo* buffer) {
    const FakeFile& file = *FakeKernel::instance().file(buffer->file);
    return file.card->buffer(file, buffer->handle)->pitch;
}

/// The caller frees it; NULL: the card has no render node.
char* drmGetRenderDeviceNameFromFd(int number) {
    FakeKernel& kernel = FakeKernel::instance();
    const FakeFile* file = kernel.file(number);
    if (kernel.enter("drmGetRenderDeviceNameFromFd") == 0) {
        for (const FakeGpu& gpu : kernel.gpus()) {
            if (gpu.of != nullptr && gpu.of == file->card) {
                return ::strdup(gpu.path.c_str());
            }
        }
    }
    return nullptr;
}
/// Returns a negative error number, or the number of devices.
int drmGetDevices2(std::uint32_t /*flags*/, drmDevicePtr devices[], int most) {
    FakeKernel& kernel = FakeKernel::instance();
    if (const int error = kernel.enter("drmGetDevices2"); error != 0) {
        return -error;
    }
    int count = 0;
    for (const FakeGpu& gpu : kernel.gpus()) {
        if (count < most) {
            const auto made = std::make_shared<Device>(gpu);
            devices[count++] = &made->device;
            kernel.hand_out(&made->device, "device", made);
        }
    }
    return count;
}
void drmFreeDevices(drmDevicePtr devices[], int count) {
    for (int k = 0; k < count; ++k) {
        FakeKernel::instance().give_back(devices[k], "device");
    }
}

} // extern "C"
#pragma GCC visibility pop

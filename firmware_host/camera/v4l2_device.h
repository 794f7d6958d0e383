/// The kernel's calls for a V4L2 camera, as an interface that tests can replace.
///
/// Source   the kernel's documentation, userspace-api/media/v4l.
/// Threads  the camera's own; `control` may block for seconds at a USB device that does not answer.
/// Errors   numbers of errno.h.
#pragma once

#include "firmware_host/base/time.h"

#include <tl/expected.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::camera {

class V4l2Device {
public:
    virtual ~V4l2Device() = default;
    /// ioctl(2) with a VIDIOC_... request; `argument` has the request's type. Returns 0 or an error number.
    [[nodiscard]] virtual int control(unsigned long request, void* argument) = 0;
    /// Waits for a frame; 0: one can be taken, EAGAIN: none came in time.
    [[nodiscard]] virtual int wait(Nanoseconds timeout) = 0;
    /// A buffer's memory, read-only, valid until the device is destroyed.
    [[nodiscard]] virtual tl::expected<std::span<const std::byte>, int> map(std::size_t offset,
                                                                            std::size_t size) = 0;

    /// As `control`, with the request's own type.
    template <typename Argument> [[nodiscard]] int ask(unsigned long request, Argument& argument) {
        return control(request, &argument);
    }
};

class V4l2Devices {
public:
    virtual ~V4l2Devices() = default;
    /// Paths of all possible cameras, in the order of their numbers.
    [[nodiscard]] virtual std::vector<std::string> list() = 0;
    [[nodiscard]] virtual tl::expected<std::unique_ptr<V4l2Device>, int> open(const std::string& path) = 0;
};

/// The cameras of this machine. They are opened for writing too, although nothing is ever written: the kernel
/// shares its buffers only with such a descriptor.
[[nodiscard]] std::unique_ptr<V4l2Devices> kernel_v4l2_devices();

} // namespace frustumscreen::camera

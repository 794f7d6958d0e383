/// A V4L2 camera as the kernel offers it: the calls alone, so that what is asked and what may go wrong is tested without one.
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

namespace frustumscreen {

class V4l2Device {
public:
    virtual ~V4l2Device() = default;
    /// ioctl(2) with one of VIDIOC_...; `argument` is what that request takes. 0, or what went wrong.
    [[nodiscard]] virtual int control(unsigned long request, void* argument) = 0;
    /// Waits until a frame can be taken; 0: it can be, EAGAIN: none came in time.
    [[nodiscard]] virtual int wait(Nanoseconds timeout) = 0;
    /// A buffer's memory, until the device is destroyed. Only to be read.
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
    /// Paths of all that may be cameras, in the order of their numbers.
    [[nodiscard]] virtual std::vector<std::string> list() = 0;
    [[nodiscard]] virtual tl::expected<std::unique_ptr<V4l2Device>, int> open(const std::string& path) = 0;
};

/// Those of the machine's kernel. A camera is open for writing too, although nothing is ever written to it: the kernel shares its
/// buffers with nobody who may only read.
[[nodiscard]] std::unique_ptr<V4l2Devices> kernel_v4l2_devices();

} // namespace frustumscreen

/// Plain memory of a graphics card that the processor writes and the card scans out. All display drivers have
/// it.
///
/// Shape    rows from the top, `stride` bytes each; pixels of four bytes: blue, green, red, unused.
/// Threads  the render thread.
/// Errors   nullopt, or an empty `memory`: the card lacks it.
/// Source   the kernel's "Dumb Buffer Objects": DRM_IOCTL_MODE_CREATE_DUMB, _MAP_DUMB.
#pragma once

#include "firmware_host/display/kms_device.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace frustumscreen::display {

class DumbBuffer {
public:
    /// `card` must stay open for the lifetime of the result.
    [[nodiscard]] static std::optional<DumbBuffer> create(int card, PixelSize size);
    ~DumbBuffer();
    DumbBuffer(DumbBuffer&& other) noexcept;
    DumbBuffer& operator=(DumbBuffer&& other) noexcept;
    DumbBuffer(const DumbBuffer&) = delete;
    DumbBuffer& operator=(const DumbBuffer&) = delete;

    [[nodiscard]] FramebufferId shown() const { return shown_; }
    [[nodiscard]] std::uint32_t stride() const { return stride_; }
    /// Empty while the buffer is not mapped.
    [[nodiscard]] std::span<std::byte> memory() const { return memory_; }
    /// Maps the memory into this process, which accounts for it while it is mapped. Returns false on failure.
    [[nodiscard]] bool map();
    void unmap();

private:
    DumbBuffer(int card, std::uint32_t handle, std::uint32_t stride, std::uint64_t bytes)
        : card_(card), handle_(handle), stride_(stride), bytes_(bytes) {}

    int card_ = -1;
    std::uint32_t handle_ = 0;
    std::uint32_t stride_ = 0;
    std::uint64_t bytes_ = 0;
    std::span<std::byte> memory_;
    FramebufferId shown_ = 0;
};

} // namespace frustumscreen::display

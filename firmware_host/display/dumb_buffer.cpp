#include "firmware_host/display/dumb_buffer.h"

#include "firmware_host/display/kms_framebuffer.h"

#include <sys/mman.h>

#include <utility>

extern "C" {
#include <xf86drm.h>
#include <xf86drmMode.h>
}

namespace frustumscreen::display {

std::optional<DumbBuffer> DumbBuffer::create(int card, PixelSize size) {
    std::uint32_t handle = 0;
    std::uint32_t stride = 0;
    std::uint64_t bytes = 0;
    if (drmModeCreateDumbBuffer(card, static_cast<std::uint32_t>(size.width),
                                static_cast<std::uint32_t>(size.height), 32, 0, &handle, &stride,
                                &bytes) != 0) {
        return std::nullopt;
    }
    DumbBuffer buffer(card, handle, stride, bytes);
    buffer.shown_ = add_framebuffer(card, size, handle, stride);
    return buffer.shown_ != 0 ? std::optional<DumbBuffer>(std::move(buffer)) : std::nullopt;
}

DumbBuffer::~DumbBuffer() {
    unmap();
    remove_framebuffer(card_, shown_);
    if (handle_ != 0) {
        drmModeDestroyDumbBuffer(card_, handle_);
    }
}

DumbBuffer::DumbBuffer(DumbBuffer&& other) noexcept
    : card_(other.card_), handle_(std::exchange(other.handle_, 0)), stride_(other.stride_),
      bytes_(other.bytes_), memory_(std::exchange(other.memory_, {})),
      shown_(std::exchange(other.shown_, 0)) {}

DumbBuffer& DumbBuffer::operator=(DumbBuffer&& other) noexcept {
    std::swap(card_, other.card_);
    std::swap(handle_, other.handle_);
    std::swap(stride_, other.stride_);
    std::swap(bytes_, other.bytes_);
    std::swap(memory_, other.memory_);
    std::swap(shown_, other.shown_);
    return *this;
}

bool DumbBuffer::map() {
    std::uint64_t offset = 0;
    if (!memory_.empty()) {
        return true;
    }
    if (drmModeMapDumbBuffer(card_, handle_, &offset) != 0) {
        return false;
    }
    void* const mapped =
        ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED, card_, static_cast<off_t>(offset));
    if (mapped == MAP_FAILED) {
        return false;
    }
    memory_ = {static_cast<std::byte*>(mapped), bytes_};
    return true;
}

void DumbBuffer::unmap() {
    if (!memory_.empty()) {
        ::munmap(memory_.data(), memory_.size());
        memory_ = {};
    }
}

} // namespace frustumscreen::display

#include "firmware_host/display/dumb_scanout.h"

#include "firmware_host/display/kms_framebuffer.h"
#include "firmware_host/display/read_back.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <optional>

extern "C" {
#include <xf86drm.h>
#include <xf86drmMode.h>
}

namespace frustumscreen {

namespace {

class DumbScanoutPair final : public ScanoutPair {
public:
    DumbScanoutPair(const CardScreen& screen, PixelSize size) : screen_(screen), size_(size) {}
    ~DumbScanoutPair() override;
    DumbScanoutPair(const DumbScanoutPair&) = delete;
    DumbScanoutPair& operator=(const DumbScanoutPair&) = delete;

    [[nodiscard]] Result<void> make();
    [[nodiscard]] PixelSize size() const override { return size_; }
    [[nodiscard]] FramebufferId fill(int which, const PixelRectangle& part) override;
    [[nodiscard]] bool read(int which, std::span<std::byte> rgba) const override;

private:
    struct Buffer {
        std::uint32_t handle = 0;
        std::uint32_t stride = 0;
        std::span<std::byte> memory; ///< mapped
        FramebufferId shown = 0;
    };
    [[nodiscard]] bool make(Buffer& buffer) const;

    const CardScreen& screen_;
    PixelSize size_;
    std::optional<ReadBack> read_back_;
    std::array<Buffer, 2> buffers_;
};

Result<void> DumbScanoutPair::make() {
    const CopyingNow copying(screen_);
    Result<ReadBack> read_back = ReadBack::create(size_);
    if (!read_back) {
        return tl::unexpected<Error>(read_back.error());
    }
    read_back_ = std::move(*read_back);
    for (Buffer& buffer : buffers_) {
        if (!make(buffer)) {
            return fail(
                ErrorKind::BadConfiguration,
                fmt::format("the graphics card has no memory for {} x {} pixels", size_.width, size_.height));
        }
    }
    return {};
}

bool DumbScanoutPair::make(Buffer& buffer) const {
    std::uint64_t bytes = 0;
    std::uint64_t offset = 0;
    if (drmModeCreateDumbBuffer(screen_.card(), static_cast<std::uint32_t>(size_.width),
                                static_cast<std::uint32_t>(size_.height), 32, 0, &buffer.handle,
                                &buffer.stride, &bytes) != 0 ||
        drmModeMapDumbBuffer(screen_.card(), buffer.handle, &offset) != 0) {
        return false;
    }
    void* const mapped = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, screen_.card(),
                                static_cast<off_t>(offset));
    if (mapped == MAP_FAILED) {
        return false;
    }
    buffer.memory = {static_cast<std::byte*>(mapped), bytes};
    buffer.shown = add_framebuffer(screen_.card(), size_, buffer.handle, buffer.stride);
    return buffer.shown != 0;
}

DumbScanoutPair::~DumbScanoutPair() {
    const CopyingNow copying(screen_);
    read_back_.reset();
    for (const Buffer& buffer : buffers_) {
        remove_framebuffer(screen_.card(), buffer.shown);
        if (!buffer.memory.empty()) {
            ::munmap(buffer.memory.data(), buffer.memory.size());
        }
        if (buffer.handle != 0) {
            drmModeDestroyDumbBuffer(screen_.card(), buffer.handle);
        }
    }
}

FramebufferId DumbScanoutPair::fill(int which, const PixelRectangle& part) {
    const Buffer& buffer = buffers_.at(static_cast<std::size_t>(which));
    if (const CopyingNow copying(screen_); copying.current()) {
        read_back_->fill(screen_.copy(), screen_.picture(), part, buffer.memory, buffer.stride);
    }
    return buffer.shown;
}

bool DumbScanoutPair::read(int which, std::span<std::byte> rgba) const {
    const std::span<const std::byte> row = buffers_.at(static_cast<std::size_t>(which)).memory;
    for (std::size_t k = 0; k + 4 <= std::min(rgba.size(), row.size()); k += 4) {
        rgba[k] = row[k + 2];
        rgba[k + 1] = row[k + 1];
        rgba[k + 2] = row[k];
        rgba[k + 3] = std::byte{255};
    }
    return true;
}

} // namespace

Result<std::unique_ptr<ScanoutPair>> make_dumb_scanout(const CardScreen& screen, PixelSize size) {
    auto pair = std::make_unique<DumbScanoutPair>(screen, size);
    if (Result<void> made = pair->make(); !made) {
        return tl::unexpected<Error>(made.error());
    }
    return pair;
}

} // namespace frustumscreen

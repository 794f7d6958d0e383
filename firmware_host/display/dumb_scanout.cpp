#include "firmware_host/display/dumb_scanout.h"

#include "firmware_host/display/dumb_buffer.h"
#include "firmware_host/display/read_back.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace frustumscreen::display {

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
    const CardScreen& screen_;
    PixelSize size_;
    std::optional<ReadBack> read_back_;
    std::vector<DumbBuffer> buffers_; ///< two
};

Result<void> DumbScanoutPair::make() {
    const CopyingNow copying(screen_);
    if (!copying.current()) {
        return fail(ErrorKind::BadConfiguration, "display.no_second_context",
                    "the graphics card lacks the second OpenGL ES context for {} x {} pixels", size_.width,
                    size_.height);
    }
    TRY(read_back_, ReadBack::create(size_));
    for (int k = 0; k < 2; ++k) {
        std::optional<DumbBuffer> buffer = DumbBuffer::create(screen_.card(), size_);
        if (!buffer || !buffer->map()) {
            return fail(ErrorKind::BadConfiguration, "display.no_memory",
                        "the graphics card has no memory for {} x {} pixels", size_.width, size_.height);
        }
        buffers_.push_back(*std::move(buffer));
    }
    return {};
}

DumbScanoutPair::~DumbScanoutPair() {
    const CopyingNow copying(screen_);
    read_back_.reset();
}

FramebufferId DumbScanoutPair::fill(int which, const PixelRectangle& part) {
    const DumbBuffer& buffer = buffers_.at(static_cast<std::size_t>(which));
    if (const CopyingNow copying(screen_); copying.current()) {
        read_back_->fill(screen_.copy(), screen_.picture(), part, buffer.memory(), buffer.stride());
    }
    return buffer.shown();
}

bool DumbScanoutPair::read(int which, std::span<std::byte> rgba) const {
    const std::span<const std::byte> row = buffers_.at(static_cast<std::size_t>(which)).memory();
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
    TRY_VOID(pair->make());
    return pair;
}

} // namespace frustumscreen::display

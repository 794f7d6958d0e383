/// The safe picture in two framebuffers of plain memory, drawn by the processor.
///
/// Threads  one.
/// Errors   the card has no memory for the size.
#pragma once

#include "app/safe/safe_page.h"
#include "firmware_host/display/dumb_buffer.h"
#include "firmware_host/display/kms_device.h"

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// What is to be shown now.
struct SafePicture {
    std::vector<std::string_view> languages;
    SafeText text;
    std::uint8_t code = 0; ///< base/probe_code.h
};

class SafeScanout final : public ScanoutPair {
public:
    /// `picture` is looked at in each `fill` and must outlive this.
    [[nodiscard]] static Result<std::unique_ptr<ScanoutPair>> make(int card, PixelSize size,
                                                                   const SafePicture& picture);

    [[nodiscard]] PixelSize size() const override { return size_; }
    /// Draws all of the picture where its text has changed, else its code alone.
    [[nodiscard]] FramebufferId fill(int which, const PixelRectangle& part) override;

private:
    struct Framebuffer {
        DumbBuffer buffer;
        std::optional<SafeText> drawn;
    };
    SafeScanout(PixelSize size, const SafePicture& picture, DumbBuffer first, DumbBuffer second)
        : size_(size), picture_(picture), framebuffers_{{{std::move(first), {}}, {std::move(second), {}}}} {}
    [[nodiscard]] bool draw(DumbBuffer& buffer) const;

    PixelSize size_;
    const SafePicture& picture_;
    std::array<Framebuffer, 2> framebuffers_;
};

} // namespace frustumscreen

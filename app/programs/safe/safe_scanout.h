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

/// The content of the safe picture.
struct SafePicture {
    std::vector<std::string_view> languages;
    SafeText text;
    std::uint8_t code = 0; ///< base/probe_code.h
};

class SafeScanout final : public ScanoutPair {
public:
    /// Each `fill` reads `picture`, which must outlive the result.
    [[nodiscard]] static Result<std::unique_ptr<ScanoutPair>> make(int card, PixelSize size,
                                                                   const SafePicture& picture);

    [[nodiscard]] PixelSize size() const override { return size_; }
    /// Draws the whole picture if its text has changed, otherwise only its code.
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

/// The safe picture in two framebuffers of plain memory, drawn by the processor.
///
/// Threads  one.
/// Errors   the card has no memory for the size.
#pragma once

#include "app/safe/eye_halves.h"
#include "app/safe/safe_page.h"
#include "firmware_host/display/dumb_buffer.h"
#include "firmware_host/display/kms_device.h"

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace frustumscreen::programs {

/// The content of the safe picture.
struct SafePicture {
    std::vector<std::string_view> languages;
    safe::SafeText text;
    std::uint8_t code = 0; ///< base/probe_code.h
    safe::EyeHalves halves = safe::EyeHalves::None;
};

class SafeScanout final : public display::ScanoutPair {
public:
    /// Each `fill` reads `picture`, which must outlive the result.
    [[nodiscard]] static Result<std::unique_ptr<display::ScanoutPair>> make(int card, PixelSize size,
                                                                            const SafePicture& picture);

    [[nodiscard]] PixelSize size() const override { return size_; }
    /// Draws the whole picture if its text has changed, otherwise only its code.
    [[nodiscard]] display::FramebufferId fill(int which, const PixelRectangle& part) override;

private:
    struct Framebuffer {
        display::DumbBuffer buffer;
        std::optional<safe::SafeText> drawn;
    };
    SafeScanout(PixelSize size, const SafePicture& picture, display::DumbBuffer first,
                display::DumbBuffer second)
        : size_(size), picture_(picture), framebuffers_{{{std::move(first), {}}, {std::move(second), {}}}} {}
    [[nodiscard]] bool draw(display::DumbBuffer& buffer) const;

    PixelSize size_;
    const SafePicture& picture_;
    std::array<Framebuffer, 2> framebuffers_;
};

} // namespace frustumscreen::programs

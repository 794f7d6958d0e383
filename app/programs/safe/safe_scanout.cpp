#include "app/programs/safe/safe_scanout.h"

#include "firmware_host/base/probe_code.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace frustumscreen::programs {

namespace {

constexpr int rows_at_once = 32; ///< limits the memory for grey values

/// Writes pixels from `x` on in row `y`; the alpha byte is unused.
void write_row(const display::DumbBuffer& buffer, int y, std::span<const std::uint8_t> greys,
               std::vector<std::uint32_t>& row) {
    row.resize(greys.size());
    std::transform(greys.begin(), greys.end(), row.begin(),
                   [](std::uint8_t grey) { return 0x010101U * grey; });
    const std::span<std::byte> memory = buffer.memory();
    const std::size_t begin = static_cast<std::size_t>(y) * buffer.stride();
    const std::size_t bytes = row.size() * sizeof row[0];
    if (begin + bytes <= memory.size()) {
        std::memcpy(memory.data() + begin, row.data(), bytes);
    }
}

} // namespace

Result<std::unique_ptr<display::ScanoutPair>> SafeScanout::make(int card, PixelSize size,
                                                                const SafePicture& picture) {
    std::optional<display::DumbBuffer> first = display::DumbBuffer::create(card, size);
    std::optional<display::DumbBuffer> second = display::DumbBuffer::create(card, size);
    if (!first || !second) {
        return fail(ErrorKind::BadConfiguration, "safe.no_memory",
                    "the graphics card has no memory for {} x {} pixels", size.width, size.height);
    }
    return std::unique_ptr<display::ScanoutPair>(
        new SafeScanout(size, picture, *std::move(first), *std::move(second)));
}

display::FramebufferId SafeScanout::fill(int which, const PixelRectangle& /*part*/) {
    Framebuffer& framebuffer = framebuffers_.at(static_cast<std::size_t>(which));
    display::DumbBuffer& buffer = framebuffer.buffer;
    if (framebuffer.drawn != picture_.text && draw(buffer)) {
        framebuffer.drawn = picture_.text;
    }
    if (buffer.map()) {
        std::array<std::uint8_t, probe_pixels> corner{};
        for (int k = 0; k < probe_pixels; ++k) {
            corner.at(static_cast<std::size_t>(k)) = probe_grey(picture_.code, k, safe_probe_greys);
        }
        std::vector<std::uint32_t> row;
        write_row(buffer, 0, corner, row);
        buffer.unmap();
    }
    return buffer.shown();
}

bool SafeScanout::draw(display::DumbBuffer& buffer) const {
    const safe::SafePage page =
        safe::lay_out_safe_page(size_.width, size_.height, picture_.text, picture_.languages);
    const auto width = static_cast<std::size_t>(size_.width);
    std::vector<std::uint8_t> greys;
    std::vector<std::uint32_t> row;
    for (int y = 0; y < size_.height; y += rows_at_once) {
        const auto rows = static_cast<std::size_t>(std::min(rows_at_once, size_.height - y));
        greys.resize(rows * width);
        safe::draw_rows_for_eyes(page, picture_.halves, y, greys);
        if (!buffer.map()) {
            return false;
        }
        for (std::size_t k = 0; k < rows; ++k) {
            write_row(buffer, y + static_cast<int>(k), std::span(greys).subspan(k * width, width), row);
        }
        buffer.unmap(); // while it is mapped, the memory counts as this process's
    }
    return true;
}

} // namespace frustumscreen::programs

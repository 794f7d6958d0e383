#include "app/show/qr_code.h"

#include <qrencode.h>

#include <memory>

namespace frustumscreen::show {

image::Image<std::uint8_t> qr_code(std::string_view text) {
    constexpr int quiet = 4;
    constexpr int smallest_version = 0; // as small as the text allows
    if (text.empty() || text.size() > max_qr_bytes) {
        return {};
    }
    const std::unique_ptr<QRcode, decltype(&QRcode_free)> code(
        QRcode_encodeData(static_cast<int>(text.size()), reinterpret_cast<const unsigned char*>(text.data()),
                          smallest_version, QR_ECLEVEL_M),
        QRcode_free);
    if (!code) {
        return {};
    }
    image::Image<std::uint8_t> picture(code->width + 2 * quiet, code->width + 2 * quiet, 255);
    for (int y = 0; y < code->width; ++y) {
        for (int x = 0; x < code->width; ++x) {
            const bool dark = (code->data[y * code->width + x] & 1U) != 0;
            picture.at(x + quiet, y + quiet) = dark ? 0 : 255;
        }
    }
    return picture;
}

} // namespace frustumscreen::show

#include "app/programs/preview/html_parts.h"

#include "app/pack/container/sha256.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace frustumscreen::programs {

std::string base64(std::span<const std::byte> bytes) {
    static constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            group = group << 8U | (k < count ? std::to_integer<unsigned>(bytes[at + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += k <= count ? digits[group >> (18 - 6 * k) & 63U] : '=';
        }
    }
    return text;
}

std::string data_address(std::string_view type, std::span<const std::byte> bytes) {
    return fmt::format("data:{};base64,{}", type, base64(bytes));
}

std::string html_lines(std::string_view text) {
    std::string html;
    for (;;) {
        const std::size_t end = text.find('\n');
        html += xml_text(text.substr(0, end));
        if (end == std::string_view::npos) {
            return html;
        }
        html += "<br>";
        text.remove_prefix(end + 1);
    }
}

std::string policy_hash(std::string_view content) {
    const std::string hex = pack::sha256_hex(as_bytes(content));
    Bytes hash(hex.size() / 2);
    for (std::size_t k = 0; k < hash.size(); ++k) {
        unsigned value = 0;
        std::from_chars(hex.data() + 2 * k, hex.data() + 2 * k + 2, value, 16);
        hash[k] = static_cast<std::byte>(value);
    }
    return "'sha256-" + base64(hash) + "'";
}

std::string bytes_in_words(std::size_t bytes) {
    return bytes < 1'000'000 ? fmt::format("{:.0f} kB", std::ceil(static_cast<double>(bytes) / 1e3))
                             : fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
}

} // namespace frustumscreen::programs

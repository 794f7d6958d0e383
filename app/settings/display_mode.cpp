#include "app/settings/display_mode.h"

#include <fmt/format.h>

#include <charconv>
#include <system_error>

namespace frustumscreen::settings {

namespace {

constexpr std::string_view preferred = "preferred";

/// Takes a number off the front of `text`; false if there is none between `low` and `high`.
template <typename Number> bool take(std::string_view& text, Number low, Number high, Number& number) {
    const auto [after, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failed != std::errc{} || !(number >= low && number <= high)) {
        return false;
    }
    text.remove_prefix(static_cast<std::size_t>(after - text.data()));
    return true;
}

bool take(std::string_view& text, char expected) {
    const bool there = !text.empty() && text.front() == expected;
    text.remove_prefix(there ? 1 : 0);
    return there;
}

} // namespace

std::optional<DisplayMode> parse_display_mode(std::string_view text) {
    DisplayMode mode;
    if (text == preferred) {
        return mode;
    }
    if (!take(text, 64, 8192, mode.width) || !take(text, 'x') || !take(text, 64, 8192, mode.height)) {
        return std::nullopt;
    }
    if (text.empty()) {
        return mode;
    }
    if (!take(text, '@') || !take(text, 10.0, 480.0, mode.refresh_hz) || !text.empty()) {
        return std::nullopt;
    }
    return mode;
}

std::string text_of(const DisplayMode& mode) {
    if (mode.width == 0) {
        return std::string(preferred);
    }
    return mode.refresh_hz > 0.0 ? fmt::format("{}x{}@{}", mode.width, mode.height, mode.refresh_hz)
                                 : fmt::format("{}x{}", mode.width, mode.height);
}

} // namespace frustumscreen::settings

#include "firmware_host/tracker/text_rows.h"

#include "firmware_host/base/printable.h"
#include "firmware_host/base/trimmed.h"

#include <fmt/format.h>

#include <charconv>

namespace frustumscreen::tracker {

namespace {

constexpr std::string_view blanks = " \t"; ///< between fields
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

template <typename T> std::optional<T> whole(std::string_view field) {
    T value{};
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size()) {
        return std::nullopt;
    }
    return value;
}

} // namespace

TextRows::TextRows(std::string_view text, std::string_view name)
    : rest_(text.starts_with(byte_order_mark) ? text.substr(byte_order_mark.size()) : text), name_(name) {}

bool TextRows::next() {
    while (!rest_.empty()) {
        const std::size_t end = rest_.find('\n');
        std::string_view line = rest_.substr(0, end);
        rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
        ++line_;
        if (line.ends_with('\r')) {
            line.remove_suffix(1);
        }
        line = trimmed(line);
        if (!line.empty() && line.front() != '#') {
            split(line);
            return true;
        }
    }
    return false;
}

void TextRows::split(std::string_view line) {
    fields_.clear();
    const bool commas = line.find(',') != std::string_view::npos;
    while (true) {
        const std::size_t end = commas ? line.find(',') : line.find_first_of(blanks);
        fields_.push_back(trimmed(line.substr(0, end)));
        if (end == std::string_view::npos) {
            return;
        }
        line.remove_prefix(end + 1);
        if (!commas) {
            line = trimmed(line);
        }
    }
}

std::string TextRows::located(std::string_view what) const {
    return fmt::format("{}:{}: {}", name_, line_, what);
}

std::optional<double> number_in(std::string_view field) {
    return whole<double>(field);
}
std::optional<std::int64_t> integer_in(std::string_view field) {
    return whole<std::int64_t>(field);
}

std::string quoted(std::string_view field) {
    return '"' + printable(field, 30) + '"';
}

} // namespace frustumscreen::tracker

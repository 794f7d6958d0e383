#include "assets_baked/bake/loaders/text.h"

#include <charconv>
#include <cstdlib>
#include <string>

namespace frustumscreen::bake {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

std::string_view WordReader::next() {
    while (position_ < text_.size() && is_blank(text_[position_])) {
        line_ += text_[position_] == '\n' ? 1 : 0;
        ++position_;
    }
    const std::size_t begin = position_;
    while (position_ < text_.size() && !is_blank(text_[position_])) {
        ++position_;
    }
    return text_.substr(begin, position_ - begin);
}

std::string_view WordReader::rest_of_line() {
    const std::size_t begin = position_;
    position_ = std::min(text_.find('\n', begin), text_.size());
    return text_.substr(begin, position_ - begin);
}

std::optional<double> number_from(std::string_view word) {
    if (word.starts_with('+')) {
        word.remove_prefix(1);
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || end != word.data() + word.size()) {
        return std::nullopt;
    }
    if (error == std::errc::result_out_of_range) {
        return std::strtod(std::string(word).c_str(), nullptr); // 0 or infinity, as in IEEE 754
    }
    return error == std::errc() ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> whole_from(std::string_view word) {
    if (word.starts_with('+')) {
        word.remove_prefix(1);
    }
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || end != word.data() + word.size()) {
        return std::nullopt;
    }
    return value;
}

} // namespace frustumscreen::bake

#include "tests/layers/cpp_tokens.h"

#include <algorithm>

namespace frustumscreen::tests {
namespace {

bool is_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

class Reader {
public:
    explicit Reader(std::string_view text) : rest_(text) {}

    std::vector<std::string> tokens() {
        while (!rest_.empty()) {
            step();
        }
        return std::move(tokens_);
    }

private:
    void step() {
        const char c = rest_.front();
        if (c == '\n') {
            begins_line_ = true;
            drop(1);
        } else if (c == ' ' || c == '\t' || c == '\r') {
            drop(1);
        } else if (rest_.starts_with("//")) {
            drop_line();
        } else if (rest_.starts_with("/*")) {
            drop_past("*/", 2);
        } else if (c == '#' && begins_line_) {
            drop_line();
        } else {
            begins_line_ = false;
            take();
        }
    }

    void take() {
        const char c = rest_.front();
        if (c == '"' || c == '\'') {
            drop_literal(c);
        } else if (c >= '0' && c <= '9') {
            take_while([](char next) { return is_word(next) || next == '.' || next == '\''; });
        } else if (is_word(c)) {
            take_while(is_word);
            take_prefixed_string();
        } else {
            const std::size_t length = rest_.starts_with("::") ? 2 : 1;
            tokens_.emplace_back(rest_.substr(0, length));
            drop(length);
        }
    }

    /// A string whose prefix was taken as a word becomes part of it; a raw one has no escapes.
    void take_prefixed_string() {
        if (!rest_.starts_with('"')) {
            return;
        }
        const bool is_raw = tokens_.back().ends_with('R');
        tokens_.pop_back();
        if (!is_raw) {
            drop_literal('"');
            return;
        }
        const std::size_t bracket = rest_.find('(');
        const std::string end = ")" + std::string(rest_.substr(1, bracket - 1)) + "\"";
        drop_past(end, bracket);
        tokens_.emplace_back("\"\"");
    }

    void drop_literal(char quote) {
        std::size_t end = 1;
        while (end < rest_.size() && rest_[end] != quote) {
            end += rest_[end] == '\\' ? 2 : 1;
        }
        drop(end + 1);
        tokens_.emplace_back("\"\"");
    }

    /// To the line's end, and over those that a backslash joins to it.
    void drop_line() {
        std::size_t end = rest_.find('\n');
        while (end != std::string_view::npos && end > 0 && rest_[end - 1] == '\\') {
            end = rest_.find('\n', end + 1);
        }
        drop(end);
    }

    void drop_past(std::string_view mark, std::size_t from) {
        const std::size_t found = rest_.find(mark, from);
        drop(found == std::string_view::npos ? found : found + mark.size());
    }

    void take_while(auto belongs) {
        const auto end = std::find_if_not(rest_.begin(), rest_.end(), belongs);
        tokens_.emplace_back(rest_.begin(), end);
        drop(tokens_.back().size());
    }

    void drop(std::size_t count) { rest_.remove_prefix(std::min(count, rest_.size())); }

    std::string_view rest_;
    bool begins_line_ = true;
    std::vector<std::string> tokens_;
};

} // namespace

std::vector<std::string> cpp_tokens(std::string_view text) {
    return Reader(text).tokens();
}

} // namespace frustumscreen::tests

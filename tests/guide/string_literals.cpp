#include "tests/guide/string_literals.h"

#include <cstddef>
#include <string>

namespace {

class Reader {
public:
    explicit Reader(std::string_view source) : source_(source) {}

    std::vector<std::string> read() {
        while (at_ < source_.size()) {
            if (!pass_comment() && !pass_directive() && !pass_raw() && !pass_character() && !take_literal()) {
                pass_one();
            }
        }
        end_run();
        return std::move(literals_);
    }

private:
    [[nodiscard]] bool sees(std::string_view what) const { return source_.substr(at_, what.size()) == what; }
    void pass_to(std::string_view end) {
        const std::size_t found = source_.find(end, at_);
        at_ = found == std::string_view::npos ? source_.size() : found + end.size();
    }
    bool pass_comment() {
        const bool line = sees("//");
        const bool block = sees("/*");
        if (line || block) {
            pass_to(line ? "\n" : "*/");
        }
        return line || block;
    }
    bool pass_directive() {
        const bool begins_line = at_ == 0 || source_[at_ - 1] == '\n';
        const bool is_one = begins_line && (sees("#include") || sees("#error"));
        if (is_one) {
            pass_to("\n");
        }
        return is_one;
    }
    bool pass_raw() {
        if (!sees("R\"")) {
            return false;
        }
        const std::size_t open = source_.find('(', at_);
        const std::string end = ")" + std::string(source_.substr(at_ + 2, open - at_ - 2)) + "\"";
        pass_to(end);
        end_run();
        return true;
    }
    bool pass_character() {
        // After a digit it separates thousands, as in 1'000'000.
        const bool is_one = source_[at_] == '\'' &&
                            (at_ == 0 || std::string_view("0123456789abcdefABCDEF").find(source_[at_ - 1]) ==
                                             std::string_view::npos);
        if (is_one) {
            at_ += source_[at_ + 1] == '\\' ? 2 : 1;
            pass_to("'");
            end_run();
        }
        return is_one;
    }
    bool take_literal() {
        if (source_[at_] != '"') {
            return false;
        }
        for (++at_; at_ < source_.size() && source_[at_] != '"'; ++at_) {
            if (source_[at_] == '\\') {
                ++at_;
                take_escape();
            } else {
                run_ += source_[at_];
            }
        }
        ++at_;
        return true;
    }
    /// \n becomes a space, \uXXXX becomes UTF-8 of two or three bytes; other escapes stand for themselves.
    void take_escape() {
        if (source_[at_] == 'u') {
            const int code = std::stoi(std::string(source_.substr(at_ + 1, 4)), nullptr, 16);
            const bool two = code < 0x800;
            run_ += two ? static_cast<char>(0xc0 | (code >> 6)) : static_cast<char>(0xe0 | (code >> 12));
            if (!two) {
                run_ += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
            }
            run_ += static_cast<char>(0x80 | (code & 0x3f));
            at_ += 4;
        } else {
            run_ += source_[at_] == 'n' ? ' ' : source_[at_];
        }
    }
    void pass_one() {
        if (std::string_view(" \t\n\r").find(source_[at_]) == std::string_view::npos) {
            end_run();
        }
        ++at_;
    }
    void end_run() {
        if (!run_.empty()) {
            literals_.push_back(run_);
            run_.clear();
        }
    }

    std::string_view source_;
    std::size_t at_ = 0;
    std::string run_; ///< adjacent literals so far
    std::vector<std::string> literals_;
};

} // namespace

std::vector<std::string> string_literals(std::string_view source) {
    return Reader(source).read();
}

/// A password from the person at the terminal, unseen; or the first line of standard input where that is no terminal.
///
/// Threads  the main one.
/// Errors   one sentence: no line comes, the two are not the same.
#pragma once

#include "firmware_host/base/result.h"

#include <string>
#include <string_view>

namespace frustumscreen {

/// Wiped when it goes.
class Password {
public:
    explicit Password(std::string text) : text_(std::move(text)) {}
    ~Password();
    Password(Password&&) noexcept = default;
    Password& operator=(Password&&) = delete;
    [[nodiscard]] std::string_view view() const { return text_; }

private:
    std::string text_;
};

[[nodiscard]] bool is_at_terminal();
[[nodiscard]] Result<Password> ask_password(const std::string& question);
/// Twice, so that a slip does not lock the person out.
[[nodiscard]] Result<Password> ask_new_password();

} // namespace frustumscreen

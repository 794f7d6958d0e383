/// Reads a password at the terminal without echo; without a terminal, the first line of standard input.
///
/// Threads  the main one.
/// Errors   one sentence: no line comes, or the two passwords differ.
#pragma once

#include "firmware_host/base/result.h"

#include <string>
#include <string_view>

namespace frustumscreen::programs {

/// A password that is wiped when it is destroyed.
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
/// Asks twice, so that a typing error does not lock the person out.
[[nodiscard]] Result<Password> ask_new_password();

} // namespace frustumscreen::programs

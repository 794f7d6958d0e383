#include "app/programs/pack/password_prompt.h"

#include <sodium.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

namespace frustumscreen::programs {

namespace {

constexpr std::size_t longest_password = 1024;

/// Switches off the terminal's echo during its lifetime.
class Unseen {
public:
    Unseen() : changed_(::tcgetattr(STDIN_FILENO, &before_) == 0) {
        if (changed_) {
            termios unseen = before_;
            unseen.c_lflag &= ~static_cast<tcflag_t>(ECHO);
            ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &unseen);
        }
    }
    ~Unseen() {
        if (changed_) {
            ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
        }
    }
    Unseen(const Unseen&) = delete;
    Unseen& operator=(const Unseen&) = delete;

private:
    termios before_{};
    bool changed_;
};

/// Reads byte by byte, because a library's buffer would keep the password.
Result<Password> read_line() {
    std::string line;
    line.reserve(longest_password); // growing would leave copies behind
    for (;;) {
        char letter = '\0';
        const ssize_t got = ::read(STDIN_FILENO, &letter, 1);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0 && line.empty()) {
            return bad_input("password.none",
                             "no password was given; type it, or give it in one line on standard input");
        }
        if (got <= 0 || letter == '\n') {
            return Password(std::move(line));
        }
        if (line.size() == longest_password) {
            sodium_memzero(line.data(), line.size());
            return bad_input("password.too_long",
                             "the password is longer than 1024 bytes; choose a shorter one");
        }
        line += letter;
    }
}

} // namespace

Password::~Password() {
    sodium_memzero(text_.data(), text_.size());
}

bool is_at_terminal() {
    return ::isatty(STDIN_FILENO) == 1;
}

Result<Password> ask_password(const std::string& question) {
    if (!is_at_terminal()) {
        return read_line();
    }
    const Unseen unseen; // before the question: it drops earlier input
    std::fprintf(stderr, "%s: ", question.c_str());
    Result<Password> password = read_line();
    std::fputc('\n', stderr); // the person's own line break was not echoed
    return password;
}

Result<Password> ask_new_password() {
    TRY(Password first, ask_password("Password for the new key (none: it is not encrypted)"));
    TRY(const Password second, ask_password("The same again"));
    if (first.view() != second.view()) {
        return bad_input("password.different", "the two passwords are not the same; try again");
    }
    return first;
}

} // namespace frustumscreen::programs

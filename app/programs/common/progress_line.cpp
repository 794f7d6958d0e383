#include "app/programs/common/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace frustumscreen {

namespace {
constexpr std::chrono::seconds patience(2);
constexpr std::chrono::milliseconds pause(100);
} // namespace

ProgressLine::ProgressLine(std::string what)
    : what_(std::move(what)), on_terminal_(::isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()), last_(start_) {}

ProgressLine::~ProgressLine() {
    clear();
}

bool ProgressLine::is_due() const {
    const auto now = std::chrono::steady_clock::now();
    return on_terminal_ && now - start_ >= patience && now - last_ >= pause;
}

void ProgressLine::show(std::size_t done, std::size_t all) {
    if (is_due()) {
        say(fmt::format("{} {} of {}", what_, done, all));
    }
}

void ProgressLine::say(std::string_view line) {
    if (!is_due()) {
        return;
    }
    last_ = std::chrono::steady_clock::now();
    shown_ = true;
    fmt::print(stderr, "\r\033[K{}", line);
    std::fflush(stderr);
}

void ProgressLine::clear() {
    if (shown_) {
        fmt::print(stderr, "\r\033[K");
        shown_ = false;
    }
}

} // namespace frustumscreen

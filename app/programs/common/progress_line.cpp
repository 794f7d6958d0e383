#include "app/programs/common/progress_line.h"

#include "firmware_host/base/words_of_time.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace frustumscreen::programs {

namespace {
constexpr std::chrono::seconds delay(2);
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
    return on_terminal_ && now - start_ >= delay && now - last_ >= pause;
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

double ProgressLine::passed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void ProgressLine::show_share(std::string_view step, double done) {
    constexpr double enough_to_tell = 0.05;
    if (done >= enough_to_tell) {
        show_share(step, done, passed_s() * (1.0 - done) / done);
    } else if (is_due()) {
        say(fmt::format("{}{:.0f} % ({})", what_, 100.0 * done, step));
    }
}

void ProgressLine::show_share(std::string_view step, double done, double left_s) {
    if (is_due()) {
        say(fmt::format("{}{:.0f} %, about {} left ({})", what_, 100.0 * done, words_of_time(left_s), step));
    }
}

void ProgressLine::clear() {
    if (shown_) {
        fmt::print(stderr, "\r\033[K");
        shown_ = false;
    }
}

} // namespace frustumscreen::programs

/// One line of progress on a terminal, shown after two seconds; silent in a pipe.
///
/// Threads  one caller.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace frustumscreen::programs {

class ProgressLine {
public:
    explicit ProgressLine(std::string what = {});
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    void show(std::size_t done, std::size_t all);
    void say(std::string_view line);
    /// Shows the current step, the share (0..1) of the work that is done, and the remaining time at that speed.
    void show_share(std::string_view step, double done);
    /// As above, with a remaining time that is known better (time_left.h).
    void show_share(std::string_view step, double done, double left_s);
    /// Clears the line, so the program can print.
    void clear();

    /// Since the line was made.
    [[nodiscard]] double passed_s() const;

private:
    /// True if enough time has passed for another line.
    [[nodiscard]] bool is_due() const;

    std::string what_;
    bool on_terminal_;
    bool shown_ = false;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point last_;
};

} // namespace frustumscreen::programs

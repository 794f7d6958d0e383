/// What went wrong and what was done about it: the latest in memory, for the status; all in a ring on the disk, for those who are
/// called later.
///
/// File     `most_lines` lines of `line_bytes`, filled up with blanks, in turn; each begins with its number, so that the latest
///          one can be found. A person can read it with `sort -n`.
/// Writes   at most one a minute; what comes in between waits, at most `most_waiting` lines, and the oldest of these are lost.
/// Threads  one caller; a write waits for the disk.
/// Errors   none: a line that cannot be written waits.
#pragma once

#include "app/watch/ladder.h"
#include "firmware_host/base/descriptor.h"
#include "firmware_host/base/time.h"

#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>

namespace frustumscreen {

struct Fault {
    std::string at; ///< by the clock on the wall, UTC, as it was then
    Awake awake{0};
    std::optional<Cause> cause; ///< none: ten good minutes
    Step step = Step::RestartExhibit;
    std::string detail;         ///< what else is known, a few words
    std::optional<bool> helped; ///< ten good minutes came of it, or another step had to; none: not known yet
};

class FaultBook {
public:
    static constexpr std::size_t line_bytes = 256;
    static constexpr std::uint64_t most_lines = 4096; ///< 1 MiB
    static constexpr std::size_t most_waiting = 64;
    static constexpr std::size_t most_latest = 16;
    static constexpr Nanoseconds between_writes = std::chrono::minutes(1);

    explicit FaultBook(const std::filesystem::path& file);

    /// The step before it, unless it led down, did not help.
    void enter(Fault fault);
    /// Ten good minutes have come of the latest step.
    void note_good();
    /// Writes what waits, if it is time.
    void keep(MonotonicTime now, bool at_once);
    /// Of this run of the program; the latest is the last.
    [[nodiscard]] const std::deque<Fault>& latest() const { return latest_; }

private:
    Descriptor descriptor_;
    std::uint64_t next_ = 1; ///< number of the next line
    std::deque<std::string> waiting_;
    std::deque<Fault> latest_;
    std::optional<MonotonicTime> written_at_;
};

} // namespace frustumscreen

/// The log of faults and actions: the latest in memory, for the status; all of them in a ring on the disk,
/// for later analysis.
///
/// File     `max_lines` lines of `line_bytes`, padded with blanks, written in turn; each begins with its
///          number, which identifies the latest one. `sort -n` makes it readable.
/// Writes   at most one a minute; further lines wait, at most `max_waiting`; beyond that the oldest are
///          lost.
/// Threads  one caller; a write waits for the disk.
/// Errors   none: a line that cannot be written stays in the queue.
#pragma once

#include "app/watch/ladder.h"
#include "firmware_host/base/descriptor.h"
#include "firmware_host/base/time.h"

#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>

namespace frustumscreen::programs {

struct Fault {
    std::string at; ///< UTC, by the wall clock of that moment
    watch::Awake awake{0};
    std::optional<watch::Cause> cause; ///< none: ten good minutes
    watch::Step step = watch::Step::RestartExhibit;
    std::string detail;         ///< further facts, a few words
    std::optional<bool> helped; ///< true: ten good minutes followed; false: another action did
};

class FaultBook {
public:
    static constexpr std::size_t line_bytes = 256;
    static constexpr std::uint64_t max_lines = 4096; ///< 1 MiB in all
    static constexpr std::size_t max_waiting = 64;
    static constexpr std::size_t max_latest = 16;
    static constexpr Nanoseconds between_writes = std::chrono::minutes(1);

    explicit FaultBook(const std::filesystem::path& file);

    /// Adds a fault. The previous action, unless it led down, did not help.
    void enter(Fault fault);
    /// Ten good minutes have followed the latest action.
    void note_good();
    /// Writes the queue if a write is due.
    void keep(MonotonicTime now, bool at_once);
    /// Faults of this run of the program, the latest last.
    [[nodiscard]] const std::deque<Fault>& latest() const { return latest_; }

private:
    Descriptor descriptor_;
    std::uint64_t next_ = 1; ///< number of the next line
    std::deque<std::string> waiting_;
    std::deque<Fault> latest_;
    std::optional<MonotonicTime> written_at_;
};

} // namespace frustumscreen::programs

/// Keeps the numbers of visits: takes pieces of visits from the render thread, and writes the day's file some minutes later.
///
/// Writes   at most every `between_writes`, where something was counted; at midnight; at the end. A power cut loses what was counted
///          since: ten minutes at most.
/// Time     days and hours are local, by the wall clock. While that is older than the program, the numbers have no day.
/// Threads  one of its own, of low priority, which alone reads and writes files. The render thread calls `post` and `read`, which never
///          wait. While the disk hangs, what does not fit into the list any more is lost.
/// Errors   none: what goes wrong stands in the report, and is tried again.
#pragma once

#include "app/counts/day_counts.h"
#include "firmware_host/base/time.h"

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace frustumscreen {

using LocalOffset = std::function<std::chrono::seconds(std::chrono::sys_seconds)>;

struct CountedVisits {
    Tally today, since_start;
    std::string trouble; ///< a sentence; empty: all is well
};

/// The numbers of the day that it is, and when they are written: all decisions, with time as a parameter.
class DayKeeper {
public:
    static constexpr Nanoseconds between_writes = std::chrono::minutes(10);
    static constexpr Nanoseconds between_tries =
        std::chrono::minutes(1); ///< of what could not be read or written

    DayKeeper(std::filesystem::path folder, LocalOffset offset)
        : folder_(std::move(folder)), offset_(std::move(offset)) {}

    /// `now` and `wall`: the same moment, when the pieces came.
    void take(std::span<const VisitPiece> pieces, MonotonicTime now, std::chrono::sys_seconds wall);
    /// Writes what is not written, now.
    void finish();
    [[nodiscard]] const CountedVisits& visits() const { return visits_; }

private:
    void turn_to(std::optional<std::chrono::sys_days> day, MonotonicTime now);
    void open(MonotonicTime now);
    void keep(MonotonicTime now);

    std::filesystem::path folder_;
    LocalOffset offset_;
    DayCounts counts_;                  ///< of the day: the file's, once that was read, and what came since
    bool opened_ = false;               ///< the file was read
    bool changed_ = false;              ///< it lacks something
    std::optional<MonotonicTime> next_; ///< not before: a write, or another try
    std::string aside_;                 ///< a damaged file was put aside
    CountedVisits visits_;
};

class VisitBook {
public:
    VisitBook(std::filesystem::path folder, LocalOffset offset);
    ~VisitBook();
    VisitBook(const VisitBook&) = delete;
    VisitBook& operator=(const VisitBook&) = delete;

    /// Takes all of them, or none of them now.
    void post(std::vector<VisitPiece>& pieces);
    /// The same at the end of a run, when nobody waits for a frame.
    void post_last(std::vector<VisitPiece>& pieces);
    /// Leaves it as it is where there is no news.
    void read(CountedVisits& visits);

private:
    void work(const std::stop_token& stop);
    void take(std::vector<VisitPiece>& pieces); ///< with the lock held

    DayKeeper keeper_; ///< the thread's alone
    std::mutex mutex_;
    std::vector<VisitPiece> posted_;
    CountedVisits visits_;
    std::jthread thread_; ///< last: it uses the others
};

} // namespace frustumscreen

/// Keeps the numbers of visits: takes pieces of visits from the render thread, and writes the day's file some
/// minutes later.
///
/// Writes   if there are new counts, at most every `between_writes`, at midnight, and at the end. A power cut loses
///          the counts since the last write: those of ten minutes at most.
/// Time     days and hours are local, by the wall clock. While the clock is earlier than the program's build, the
///          numbers have no day.
/// Threads  one of its own, of low priority, which alone reads and writes files. The render thread calls `post` and
///          `read`, which never wait. While the disk hangs, pieces that do not fit into the list are lost.
/// Errors   none: a failure is in the report, and is tried again.
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

namespace frustumscreen::counts {

using LocalOffset = std::function<std::chrono::seconds(std::chrono::sys_seconds)>;

struct CountedVisits {
    Tally today, since_start;
    std::string trouble; ///< a sentence; empty: no trouble
};

/// The numbers of the current day, and the times of writing: all decisions, with time as a parameter.
class DayKeeper {
public:
    static constexpr Nanoseconds between_writes = std::chrono::minutes(10);
    static constexpr Nanoseconds between_tries =
        std::chrono::minutes(1); ///< after a read or a write has failed

    DayKeeper(std::filesystem::path folder, LocalOffset offset)
        : folder_(std::move(folder)), offset_(std::move(offset)) {}

    /// `now` and `wall`: the same moment, at which the pieces came.
    void take(std::span<const VisitPiece> pieces, MonotonicTime now, std::chrono::sys_seconds wall);
    /// Writes all that is not yet written, at once.
    void finish();
    [[nodiscard]] const CountedVisits& visits() const { return visits_; }

private:
    void turn_to(std::optional<std::chrono::sys_days> day, MonotonicTime now);
    void open(MonotonicTime now);
    void keep(MonotonicTime now);

    std::filesystem::path folder_;
    LocalOffset offset_;
    DayCounts counts_;                  ///< of the day: from the file, once that is read, and since then
    bool opened_ = false;               ///< the file was read
    bool changed_ = false;              ///< the file lacks some counts
    std::optional<MonotonicTime> next_; ///< earliest time of the next write or try
    std::string aside_;                 ///< a sentence: a damaged file was put aside
    CountedVisits visits_;
};

class VisitBook {
public:
    VisitBook(std::filesystem::path folder, LocalOffset offset);
    ~VisitBook();
    VisitBook(const VisitBook&) = delete;
    VisitBook& operator=(const VisitBook&) = delete;

    /// Takes all pieces, or none if the list's lock is held.
    void post(std::vector<VisitPiece>& pieces);
    /// The same at the end of a run, when it may wait for the lock.
    void post_last(std::vector<VisitPiece>& pieces);
    /// Leaves `visits` unchanged if the list's lock is held.
    void read(CountedVisits& visits);

private:
    void work(const std::stop_token& stop);
    void take(std::vector<VisitPiece>& pieces); ///< with the lock held

    DayKeeper keeper_; ///< used by the thread alone
    std::mutex mutex_;
    std::vector<VisitPiece> posted_;
    CountedVisits visits_;
    std::jthread thread_; ///< last: uses the other members
};

} // namespace frustumscreen::counts

/// Costs of a stick so far: whether it still delivers bytes fast enough, and how much work went into packs that
/// were refused.
///
/// Units    reads: wall time; work: processor time.
/// Threads  one caller.
#pragma once

#include "app/library/import_limits.h"

#include <cstdint>
#include <map>
#include <string>

namespace frustumscreen::library {

/// Read rate of the stick. Time spent writing does not count: a slow disk is not the stick's fault.
class ReadingPace {
public:
    explicit ReadingPace(const ImportLimits& limits) : limits_(limits) {}
    /// Adds `bytes` that took `reading`. False if the stick is too slow.
    [[nodiscard]] bool add(std::uint64_t bytes, Nanoseconds reading);

private:
    const ImportLimits& limits_;
    std::uint64_t bytes_ = 0;
    Nanoseconds reading_{0};
};

/// Work on packs that were refused. A pack may be large, and a damaged one costs as much as a good one, so a few
/// copies in vain are allowed; hundreds are not.
class WastedWorkBudget {
public:
    explicit WastedWorkBudget(const ImportLimits& limits) : limits_(limits) {}
    void add_look(Nanoseconds work) { work_ += work; }
    /// Adds a refused copy. `manifest_sha256`: of the pack.
    void add_copy(Nanoseconds work, const std::string& manifest_sha256);
    [[nodiscard]] bool is_too_much() const {
        return work_ > limits_.refused_work && (copies_ == 0 || copies_ > limits_.max_refused_copies);
    }
    /// True if copies of the pack with this manifest were refused so often that another one is not tried.
    [[nodiscard]] bool is_hopeless(const std::string& manifest_sha256) const;

private:
    const ImportLimits& limits_;
    Nanoseconds work_{0};
    int copies_ = 0;
    std::map<std::string, int> copies_of_; ///< by the manifest's hash
};

} // namespace frustumscreen::library

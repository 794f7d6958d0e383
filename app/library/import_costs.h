/// What a stick has cost so far: whether it still gives bytes fast enough, and how much work was done for packs that are refused.
///
/// Units    time by the clock for reads, of the processor for work.
/// Threads  one caller.
#pragma once

#include "app/library/import_limits.h"

#include <cstdint>
#include <map>
#include <string>

namespace frustumscreen {

/// Only reads of the stick count: a disk that writes slowly is not the stick's fault.
class ReadingPace {
public:
    explicit ReadingPace(const ImportLimits& limits) : limits_(limits) {}
    /// `bytes` took `reading`. False: it is too slow.
    [[nodiscard]] bool add(std::uint64_t bytes, Nanoseconds reading);

private:
    const ImportLimits& limits_;
    std::uint64_t bytes_ = 0;
    Nanoseconds reading_{0};
};

/// A pack of the museum's may be large, and one that is damaged costs as much as a good one: some copies in vain are nobody's
/// harm, hundreds are.
class WorkInVain {
public:
    explicit WorkInVain(const ImportLimits& limits) : limits_(limits) {}
    void add_look(Nanoseconds work) { work_ += work; }
    /// `manifest_sha256`: of the pack whose copy was refused.
    void add_copy(Nanoseconds work, const std::string& manifest_sha256);
    [[nodiscard]] bool is_too_much() const {
        return work_ > limits_.refused_work && (copies_ == 0 || copies_ > limits_.most_refused_copies);
    }
    /// Whether copies of the pack with this manifest were refused so often that another one need not be tried.
    [[nodiscard]] bool is_hopeless(const std::string& manifest_sha256) const;

private:
    const ImportLimits& limits_;
    Nanoseconds work_{0};
    int copies_ = 0;
    std::map<std::string, int> copies_of_; ///< by the manifest's hash
};

} // namespace frustumscreen

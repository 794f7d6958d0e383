/// Detects that another set of packs was installed since a run began, for a run that has nothing to show.
///
/// Threads  its own thread checks the file four times a second, as a disk may hang. `came` is called in each frame
///          and never waits. A hanging thread ends with the process (end_within).
/// Errors   none: a file that cannot be checked counts as unchanged.
#pragma once

#include "app/show/library_files.h"

#include <atomic>
#include <filesystem>
#include <optional>
#include <thread>

namespace frustumscreen::show {

class SetArrival {
public:
    static constexpr Nanoseconds between_looks = std::chrono::milliseconds(250);

    /// `before`: stamp_of_set before the packs were searched.
    SetArrival(std::filesystem::path library, const std::optional<FileStamp>& before);
    [[nodiscard]] bool came() const { return came_; }

private:
    std::atomic<bool> came_ = false;
    std::jthread thread_; ///< last, so that it ends first
};

} // namespace frustumscreen::show

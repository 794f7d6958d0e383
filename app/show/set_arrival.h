/// Looks whether another set of packs is installed than when a run began, for a run that has nothing to show.
///
/// Threads  one of its own looks at the file, four times a second: a disk may hang. `came` is asked in each frame and waits for
///          nothing. A thread that hangs ends with the process (end_within).
/// Errors   none: what cannot be looked at has not come.
#pragma once

#include "app/show/library_files.h"

#include <atomic>
#include <filesystem>
#include <optional>
#include <thread>

namespace frustumscreen {

class SetArrival {
public:
    static constexpr Nanoseconds between_looks = std::chrono::milliseconds(250);

    /// `before`: stamp_of_set before the packs were looked for.
    SetArrival(std::filesystem::path library, const std::optional<FileStamp>& before);
    [[nodiscard]] bool came() const { return came_; }

private:
    std::atomic<bool> came_ = false;
    std::jthread thread_; ///< last, so that it ends first
};

} // namespace frustumscreen

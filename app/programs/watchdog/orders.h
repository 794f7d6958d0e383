/// How the watchdog triggers an action: it writes a file, and a path unit of the service manager starts the
/// action. The watchdog thus needs no right except to write in its own folder.
///
/// Files    `mode`: a word, the exhibit's mode from its next start on; `reason`: a sentence for the staff;
///          `steps/restart-exhibit`, `steps/reset-device`, `steps/safe-picture`, `steps/reboot`: requested
///          actions; the unit that performs one removes its file first.
/// Threads  one caller.
/// Errors   one sentence: the file that cannot be written.
#pragma once

#include "app/watch/ladder.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <string_view>

namespace frustumscreen::programs {

class Orders {
public:
    explicit Orders(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Prepares the folder, and sets the exhibit's mode from its next start on. Pending orders of an earlier
    /// watchdog are void.
    [[nodiscard]] Result<void> begin(watch::Mode mode) const;
    [[nodiscard]] Result<void> give(watch::Step step, watch::Mode mode, std::string_view reason) const;

    /// The file's name under `steps`.
    [[nodiscard]] static std::string_view order_for(watch::Step step);

private:
    [[nodiscard]] Result<void> set_mode(watch::Mode mode) const;

    std::filesystem::path folder_;
};

} // namespace frustumscreen::programs

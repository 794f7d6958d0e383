/// How the watchdog gets a step done: it leaves a file, and a path unit of the service manager starts what the file asks for. So
/// the watchdog needs no right but to write into its own folder.
///
/// Files    `mode`: a word, what the exhibit shows from its next start on; `reason`: a sentence for the staff;
///          `steps/restart-exhibit`, `steps/reset-device`, `steps/safe-picture`, `steps/reboot`: asked for; whoever does it
///          removes the file first.
/// Threads  one caller.
/// Errors   one sentence: what cannot be written.
#pragma once

#include "app/watch/ladder.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace frustumscreen {

class Orders {
public:
    explicit Orders(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Makes the folder ready, with what the exhibit is to show from its next start on. An order that an earlier watchdog gave and
    /// nobody took counts no more.
    [[nodiscard]] Result<void> begin(Mode mode) const;
    [[nodiscard]] Result<void> give(Step step, Mode mode, std::string_view reason) const;

    /// The file's name under `steps`.
    [[nodiscard]] static std::string_view order_for(Step step);

private:
    [[nodiscard]] Result<void> set_mode(Mode mode) const;

    std::filesystem::path folder_;
};

} // namespace frustumscreen

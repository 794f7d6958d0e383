/// Shows the safe picture during the life of the process: once a second with the next code and the current
/// reason.
///
/// Watched  after each flip the file `alive` is rewritten and the service manager's watchdog is fed; without
///          a projector only the watchdog is.
/// Threads  one. A stop signal ends the process at once: there is nothing to save, and the kernel releases
///          the screen.
/// Errors   as SafeScreen once it is open; before that it waits for the card.
#pragma once

#include "app/safe/eye_halves.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::programs {

struct SafeArguments {
    std::string card;             ///< as KmsCard::open
    std::filesystem::path reason; ///< empty: no reason is read
    std::filesystem::path alive;  ///< empty: none is written
    std::filesystem::path stereo; ///< file with the projector's stereo layout; empty: none
    std::vector<std::string_view> languages;
};

/// Returns only after an error.
[[nodiscard]] Result<void> show_safe_picture(const SafeArguments& arguments);

/// Read once. A file that is missing or says something else: none.
[[nodiscard]] safe::EyeHalves read_halves(const std::filesystem::path& stereo);

/// The beginning of the file; empty if it is unreadable.
[[nodiscard]] std::string read_reason(const std::filesystem::path& file);

} // namespace frustumscreen::programs

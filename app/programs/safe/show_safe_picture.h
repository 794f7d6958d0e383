/// Shows the safe picture for as long as the process lives: once a second with another code, with the reason as it is then.
///
/// Watched  after each flip the file `alive` is rewritten and the service manager's watchdog is fed; without a projector the
///          watchdog alone.
/// Threads  one. A stop signal ends the process at once: there is nothing to put away, and the kernel gives the screen back.
/// Errors   as SafeScreen once it was open; before that it waits for the card.
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

struct SafeArguments {
    std::string card;             ///< as KmsCard::open
    std::filesystem::path reason; ///< empty: none is read
    std::filesystem::path alive;  ///< empty: none is written
    std::vector<std::string_view> languages;
};

/// Comes back only with an error.
[[nodiscard]] Result<void> show_safe_picture(const SafeArguments& arguments);

/// The beginning of the file; empty if it cannot be read.
[[nodiscard]] std::string read_reason(const std::filesystem::path& file);

} // namespace frustumscreen

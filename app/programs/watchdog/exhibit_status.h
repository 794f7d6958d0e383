/// What the watchdog takes from the exhibit's status file: a few fields, whatever else it holds.
///
/// Threads  pure; any.
/// Errors   nothing: it is no status.
#pragma once

#include "app/watch/outcome.h"

#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen {

struct ExhibitStatus {
    ExhibitSays says; ///< `age` is for the caller
    std::string boot_id;
    MonotonicTime written_at;
};

[[nodiscard]] std::optional<ExhibitStatus> read_exhibit_status(std::string_view json);

} // namespace frustumscreen

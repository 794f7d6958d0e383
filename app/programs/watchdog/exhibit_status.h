/// The fields of the exhibit's status file that the watchdog uses.
///
/// Threads  pure; any.
/// Errors   nullopt: it is not a status.
#pragma once

#include "app/watch/outcome.h"

#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen::programs {

struct ExhibitStatus {
    watch::ExhibitSays says; ///< the caller sets `age`
    std::string boot_id;
    MonotonicTime written_at;
};

[[nodiscard]] std::optional<ExhibitStatus> read_exhibit_status(std::string_view json);

} // namespace frustumscreen::programs

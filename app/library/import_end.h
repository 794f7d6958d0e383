/// The final report of an import that was stopped before it could write one: the service manager starts another run
/// of the program, which writes it. Also decides which report stands while several sticks are put in.
///
/// Threads  pure; any.
#pragma once

#include "app/library/import_report.h"
#include "firmware_host/base/time.h"

#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen::library {

/// The final report of the import `import_id`, which has ended; `last` is the report on file. None if the import
/// wrote its own final report, if another stick is being read, or if another stick's report came after this import
/// had succeeded. `service_result`: systemd's SERVICE_RESULT. `set_number`: of the installed set.
[[nodiscard]] std::optional<ImportReport> final_report_of(const std::optional<ImportReport>& last,
                                                          std::string import_id,
                                                          std::string_view service_result,
                                                          std::uint64_t set_number);

/// True if the staff is told that the stick cannot be mounted; `last` is the report on file. False if `last` is
/// about this stick, or if another partition of the same disk was read. Ids are those of the udev rules: stick7p1.
[[nodiscard]] bool must_report_unmounted(const std::optional<ImportReport>& last, std::string_view import_id);

/// How long the import `import_id` waits before its first report, so that the final report `last` of another stick
/// stays for `stands`. `age`: of `last`, by a clock that may have been set in between.
[[nodiscard]] Nanoseconds delay_before_first_report(const std::optional<ImportReport>& last,
                                                    std::string_view import_id, Nanoseconds age,
                                                    Nanoseconds stands);

} // namespace frustumscreen::library

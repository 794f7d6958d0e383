/// The last word on an import that could not say it itself, because it was stopped in the middle: the service manager says so,
/// and another run of the program writes it. And whose report stands while several sticks are put in.
///
/// Threads  pure; any.
#pragma once

#include "app/library/import_report.h"
#include "firmware_host/base/time.h"

#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen {

/// Of the import `import_id` that has ended, while the report said `last`; none: it was said, or the report is that of another
/// stick which is being read, or came after this one had ended well. `service_result`: why it ended, as systemd calls it in
/// SERVICE_RESULT. `set_number`: of what is installed.
[[nodiscard]] std::optional<ImportReport> last_word(const std::optional<ImportReport>& last,
                                                    std::string import_id, std::string_view service_result,
                                                    std::uint64_t set_number);

/// The stick cannot be mounted, and the report said `last`. False: that was about this stick, or another partition of the same disk
/// was read. Ids are as the udev rules give them: stick7p1.
[[nodiscard]] bool is_to_be_told_unmounted(const std::optional<ImportReport>& last,
                                           std::string_view import_id);

/// How long the import `import_id` waits, so that another one's report `last` that is over stands for `stands`. `age`: of that, by
/// a clock that may have been set meanwhile.
[[nodiscard]] Nanoseconds wait_before_first_word(const std::optional<ImportReport>& last,
                                                 std::string_view import_id, Nanoseconds age,
                                                 Nanoseconds stands);

} // namespace frustumscreen

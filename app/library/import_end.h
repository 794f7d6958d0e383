/// The last word on an import that could not say it itself, because it was stopped in the middle: the service manager says so,
/// and another run of the program writes it.
///
/// Threads  pure; any.
#pragma once

#include "app/library/import_report.h"

#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen {

/// Of the import `import_id` that has ended, while the report said `last`; none: it was said, or the report is that of another
/// stick which is being read, or came after this one had ended well. `service_result`: why it ended, as systemd calls it in SERVICE_RESULT. `set_number`: of what is
/// installed.
[[nodiscard]] std::optional<ImportReport> last_word(const std::optional<ImportReport>& last,
                                                    std::string import_id, std::string_view service_result,
                                                    std::uint64_t set_number);

} // namespace frustumscreen

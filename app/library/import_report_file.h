/// The file of the import report.
///
/// Threads  any.
/// Errors   none: a missing file, and one that is no report, give nullopt.
#pragma once

#include "app/library/import_report.h"

#include <filesystem>
#include <optional>
#include <string_view>

namespace frustumscreen::library {

[[nodiscard]] std::optional<ImportReport> read_import_report(const std::filesystem::path& file);
/// Waits until the final report of another stick than `import_id` has stood for `stands_s`, to be read on the table.
void wait_for_readers(const std::filesystem::path& file, std::string_view import_id, double stands_s);

} // namespace frustumscreen::library

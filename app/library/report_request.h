/// A stick's requests: for a report on the kiosk, an empty file of a fixed name in its root; for a copy of the kiosk, a
/// signed one (kiosk_copy/copy_request.h), or an empty one that waits for the staff's buttons. Another unit of the image
/// writes both before the import; the importer tells the outcome with that of the packs.
///
/// Threads  one caller.
/// Errors   in the lines, one sentence each.
#pragma once

#include "app/library/import_report.h"
#include "firmware_host/base/file_tree.h"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace frustumscreen::library {

inline constexpr std::string_view report_request_name = "frustumscreen-report.toml";
inline constexpr std::size_t max_report_request_bytes = 4096;
/// The signed request for a copy of the kiosk, and that copy as another kiosk takes it (kiosk_copy/).
inline constexpr std::string_view copy_request_name = "frustumscreen-request.toml";
inline constexpr std::string_view copy_request_signature = "frustumscreen-request.toml.minisig";
inline constexpr std::size_t max_copy_request_bytes = 4096;
inline constexpr std::string_view kiosk_copy_name = "kiosk.fsk";

/// Once the staff have confirmed a copy, the same stick is looked through as another import: its id with this ending.
inline constexpr std::string_view staff_import_ending = ".staff";

/// True if the stick's request for a copy is empty and has no signature. It asks for everything once the staff's buttons
/// have confirmed it, and for nothing before.
[[nodiscard]] bool waits_for_staff(FileTree& stick);
/// The line with which the importer offers that.
[[nodiscard]] ImportedPack copy_offer();
[[nodiscard]] bool offers_copy(const ImportedPack& line);
/// True for the line about a signed request for the state of delivery, which waits for a button too.
[[nodiscard]] bool offers_reset(const ImportedPack& line);

/// The lines on the stick's requests: `outcome`, and faults of the request files. `outcome`: the lines of
/// the unit that writes; none: it left no report, which is a fault if the request is valid.
/// `is_confirmed`: by the staff's buttons.
[[nodiscard]] std::vector<ImportedPack>
lines_of_stick_report(FileTree& stick, std::optional<std::vector<ImportedPack>> outcome, bool is_confirmed);

} // namespace frustumscreen::library

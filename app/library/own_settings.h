/// The kiosk's own settings in their folder: whom they believe, and how others take their place.
///
/// Trusted   if they name no key: any file. If they name keys: a file signed with one of them, with a serial not lower
///           than the highest that was taken. Keys that sets brought count for packs alone.
/// Order     the serial is written before what it belongs to: after a power cut between the two the same stick is
///           taken again.
/// Threads   one caller.
/// Errors    one sentence; the settings stay as they are.
#pragma once

#include "app/library/import_report.h"
#include "app/library/signed_text.h"
#include "firmware_host/base/file_tree.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// The kiosk's present settings.
struct OwnSettings {
    std::string text;             ///< of kiosk.toml; empty: unreadable
    bool sound = false;           ///< `text` is valid settings
    std::vector<TrustedKey> keys; ///< named by the settings
    std::uint64_t serial = 0;     ///< the highest that was taken; 0: none
};
[[nodiscard]] tl::expected<OwnSettings, ImportFailure> read_own_settings(WritableTree& folder);

/// The serial of a trusted file, which is not parsed; 0 if no signature is needed.
[[nodiscard]] tl::expected<std::uint64_t, ImportFailure>
serial_of_trusted(std::string_view name, const SignedText& file, const OwnSettings& own,
                  std::optional<std::chrono::sys_days> today);
/// The serial of a file that needed no signature but is signed with one of the keys that it brings: older ones are
/// refused afterwards. 0: it is not.
[[nodiscard]] std::uint64_t serial_of_first(std::string_view name, const SignedText& file,
                                            std::span<const TrustedKey> brought);
[[nodiscard]] tl::expected<void, ImportFailure> keep_serial(WritableTree& folder, const OwnSettings& own,
                                                            std::uint64_t serial);
/// `text`: valid settings. Keeps what the kiosk goes back to.
[[nodiscard]] tl::expected<ImportOutcome, ImportFailure>
replace_settings(WritableTree& folder, const OwnSettings& own, std::string_view text);

} // namespace frustumscreen

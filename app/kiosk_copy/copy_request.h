/// frustumscreen-request.toml on a stick: which of its things the kiosk is to write to the stick. It counts only with its
/// signature, made with one of the keys that the kiosk's settings name; or empty, with the staff's buttons.
///
/// Keys     reset = true: the kiosk goes back to the state of delivery, once the staff's button confirms it; what =
///          ["settings", "calibration", "counts", "packs"]; until = "2031-12-31", its last day; machine =
///          "frustumscreen-1a2b3c", the host's name of the one kiosk that is meant. `machine` may be left out, and
///          `what` or `reset`.
/// Errors   one sentence that begins with the file's name.
/// Threads  one caller; parsing is pure.
#pragma once

#include "app/library/import_failure.h"
#include "firmware_host/base/file_tree.h"
#include "firmware_host/base/result.h"

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace frustumscreen::kiosk_copy {

struct CopyRequest {
    bool settings = false;
    bool calibration = false;
    bool counts = false;
    bool packs = false;
    bool reset = false;
    bool by_staff = false;         ///< confirmed by the staff's buttons, not signed
    std::chrono::sys_days until{}; ///< its last day
    std::string machine{};         ///< empty: each kiosk that trusts the signer's key
    [[nodiscard]] bool asks_for_copy() const { return settings || calibration || counts || packs; }
    [[nodiscard]] bool operator==(const CopyRequest&) const = default;
};
[[nodiscard]] Result<CopyRequest> parse_copy_request(std::string_view text);
/// An empty request (library/report_request.h) that the staff have confirmed.
[[nodiscard]] CopyRequest whole_copy();

/// None: the stick has no such file. The file is parsed only after its signature is checked. `keys`: of the kiosk's
/// settings. `machine`: this one's host name. `today`: none: no last day is over.
[[nodiscard]] tl::expected<std::optional<CopyRequest>, library::ImportFailure>
read_copy_request(FileTree& stick, std::span<const pack::TrustedKey> keys, std::string_view machine,
                  std::optional<std::chrono::sys_days> today);

} // namespace frustumscreen::kiosk_copy

/// Attribution of the artifact and its scan, as visitors read it on the table: below the caption, and after the
/// description.
///
///     maker · place · period
///     credit line
///     3D: author of the scan · licence
///
/// A line without content is left out. Web addresses are shortened to their hosts, since a visitor cannot follow
/// one from a table; the pack keeps them whole. A licence that the credit line names is not repeated.
///
/// Author and source are in the pack's section `attribution`.
///
/// Text     UTF-8; lines separated by line feeds; no words of any language, so that one text serves all.
/// Errors   one line: a section that FORMAT.md does not allow. A pack without the section is no error.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::pack {

/// The key of the attribution among a pack's set texts.
inline constexpr std::string_view attribution_key = "attribution";

/// The rights in a pack's scan, one line each; empty: not stated.
struct ScanRights {
    std::string licence; ///< SPDX expression or free text
    std::string author;  ///< of the scan, or its copyright notice
    std::string source;  ///< where it was published: a web address
    [[nodiscard]] bool operator==(const ScanRights&) const = default;
};
/// Call once for a pack.
void put_scan_rights(Pack& pack, const ScanRights& rights);
[[nodiscard]] Result<ScanRights> scan_rights(const PackDescription& pack);

/// Empty if nothing is known.
[[nodiscard]] std::string attribution_of(const PackCaption& caption, const ScanRights& rights);

/// "Name (https://example.org/name?id=1)" as "Name (example.org)".
[[nodiscard]] std::string with_short_addresses(std::string_view text);

/// Missing statements, a sentence each: a licence, the author that the licence requires, an id.
[[nodiscard]] std::vector<std::string> missing_in(const PackDescription& pack, const ScanRights& rights);

} // namespace frustumscreen::pack

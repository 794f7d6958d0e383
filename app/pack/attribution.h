/// Whose the artifact and its scan are, as visitors read it on the table: below the caption, and at the end of what is told.
///
///     maker · place · period
///     credit line
///     3D: author of the scan · licence
///
/// A line of which nothing is known is not there. Web addresses are shortened to their hosts, since nobody can follow one from a
/// table; the pack keeps them whole. A licence that the credit line names is not said twice.
///
/// Author and source are the pack's section `attribution`.
///
/// Text     UTF-8; lines apart by line feeds; without words of any language, so that it suits each.
/// Errors   one line: a section that FORMAT.md does not allow. A pack without it is no error.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// The key of the attribution among a pack's set texts.
inline constexpr std::string_view attribution_key = "attribution";

/// What a pack says of its scan, one line each; empty: nothing.
struct ScanRights {
    std::string licence; ///< SPDX expression or free text
    std::string author;  ///< of the scan, or its copyright notice
    std::string source;  ///< where it was published: a web address
    [[nodiscard]] bool operator==(const ScanRights&) const = default;
};
/// Once for a pack.
void put_scan_rights(Pack& pack, const ScanRights& rights);
[[nodiscard]] Result<ScanRights> scan_rights(const PackDescription& pack);

/// Empty where nothing is known.
[[nodiscard]] std::string attribution_of(const PackCaption& caption, const ScanRights& rights);

/// "Name (https://example.org/name?id=1)" as "Name (example.org)".
[[nodiscard]] std::string with_short_addresses(std::string_view text);

/// What a pack should say and does not, a sentence each: a licence, the author that its licence asks for, an id.
[[nodiscard]] std::vector<std::string> missing_in(const PackDescription& pack, const ScanRights& rights);

} // namespace frustumscreen

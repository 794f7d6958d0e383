/// The reports of frustumscreen-pack about a pack, as JSON for programs and as text for people.
///
/// Errors   as verify_pack, beginning with the file's name.
/// Threads  one caller.
#pragma once

#include "app/pack/pack_contents.h"
#include "app/pack/pack_file.h"
#include "app/pack/signature/signature.h"
#include "app/settings/settings.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::programs {

/// A valid pack and its container's contents.
struct OpenedPack {
    std::filesystem::path file;
    std::uint64_t file_bytes = 0;
    pack::VerifiedPack pack;
    std::vector<pack::PackPart> parts;
    std::optional<pack::SignatureClaim> claim; ///< its signature, not verified; none: unsigned
};
[[nodiscard]] Result<OpenedPack> open_pack(const std::filesystem::path& file);

/// {file, bytes, signed, serial (if signed; not verified), id, title, languages, levels with errors in mm on this prop,
/// default_level, parts}
[[nodiscard]] nlohmann::ordered_json list_json(const OpenedPack& opened, const settings::PropSettings& prop);
/// list_json and {format_version, captions with their details and the keys of their spoken texts, hotspots,
/// table_picture, sections, provenance, prop_kind, unlit, relief_size, box_size, textures, relief, prop,
/// metres_per_box, artifact_size_m, prop_from_artifact: 16 numbers, column-major, cells, behaviours (world_report.h), torches
/// (torch_report.h)}.
[[nodiscard]] nlohmann::ordered_json explain_json(const OpenedPack& opened,
                                                  const settings::PropSettings& prop);

/// Both reports as text; each ends with a line break.
[[nodiscard]] std::string list_text(const OpenedPack& opened, const settings::PropSettings& prop);
[[nodiscard]] std::string explain_text(const OpenedPack& opened, const settings::PropSettings& prop);

} // namespace frustumscreen::programs

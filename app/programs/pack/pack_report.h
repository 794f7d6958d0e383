/// What frustumscreen-pack says about a pack, for programs (JSON) and for people.
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

namespace frustumscreen {

/// A sound pack and what its container holds.
struct OpenedPack {
    std::filesystem::path file;
    std::uint64_t file_bytes = 0;
    VerifiedPack pack;
    std::vector<PackPart> parts;
    std::optional<SignatureClaim> claim; ///< of its signature, which nobody checked; none: it is unsigned
};
[[nodiscard]] Result<OpenedPack> open_pack(const std::filesystem::path& file);

/// {file, bytes, signed, serial (of a signed one; not checked), id, title, languages, levels with errors in mm on this prop, default_level, parts}
[[nodiscard]] nlohmann::ordered_json list_json(const OpenedPack& opened, const PropSettings& prop);
/// list_json and {format_version, captions with their details and the keys of what is spoken, hotspots, table_picture, sections, provenance, prop_kind,
/// unlit, relief_size, box_size, textures, relief, prop, metres_per_box, artifact_size_m, prop_from_artifact: 16
/// numbers, column-major}.
[[nodiscard]] nlohmann::ordered_json explain_json(const OpenedPack& opened, const PropSettings& prop);

/// The same for people; each ends with a line break.
[[nodiscard]] std::string list_text(const OpenedPack& opened, const PropSettings& prop);
[[nodiscard]] std::string explain_text(const OpenedPack& opened, const PropSettings& prop);

} // namespace frustumscreen

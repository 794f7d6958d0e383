/// The manifest of a pack: `manifest.json`, its first entry. FORMAT.md lists the fields.
///
/// Errors   one line beginning with the field's place in the manifest.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack_outline.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::pack {

inline constexpr std::string_view manifest_name = "manifest.json";
inline constexpr std::string_view signature_name = "signature";

struct PartRecord {
    std::string name;
    std::uint64_t bytes = 0; ///< unpacked
    std::string sha256;      ///< of the unpacked bytes
};

struct ReliefRecord {
    float texel_box = 0.0F;
    std::string atlas;  ///< part
    std::string charts; ///< part
};

/// A level in the file; its texture is named by the texture's part.
struct LevelRecord : LevelOutline {
    std::string mesh; ///< part
};

/// A section as in the file.
struct SectionRecord {
    std::string name;
    std::vector<std::string> parts;
    std::string data; ///< as PackSection
};

struct Manifest {
    PackDescription description;
    std::string table_picture; ///< part; empty: none
    std::vector<std::string> textures;
    std::optional<ReliefRecord> relief;
    std::vector<LevelRecord> levels;
    std::vector<PartRecord> parts;
};

/// Checks syntax, types and names, and only the values that give a size or refer to something.
[[nodiscard]] Result<Manifest> parse_manifest(std::string_view text);
[[nodiscard]] std::string write_manifest(const Manifest& manifest);

/// True if a part may have this name.
[[nodiscard]] bool is_part_name(std::string_view name);

} // namespace frustumscreen::pack

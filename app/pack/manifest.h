/// The manifest of a pack: `manifest.json`, its first entry. FORMAT.md lists the fields.
///
/// Errors   one line beginning with the field's place in the manifest.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::pack_format {

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

struct LevelRecord {
    LevelTechnique technique = LevelTechnique::Mesh;
    LevelError error;
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    std::uint32_t texture = 0; ///< index into Manifest::textures; by its part's name in the file
    std::string mesh;          ///< part
};

struct Manifest {
    Pack description; ///< everything but pictures and levels
    std::vector<std::string> textures;
    std::optional<ReliefRecord> relief;
    std::vector<LevelRecord> levels;
    std::vector<PartRecord> parts;
};

/// Syntax, types and names; of the values, only those that size something or refer to something.
[[nodiscard]] Result<Manifest> parse_manifest(std::string_view text);
[[nodiscard]] std::string write_manifest(const Manifest& manifest);

} // namespace frustumscreen::pack_format

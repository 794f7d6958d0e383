/// The header of a PLY file: which elements follow, and their format.
///
/// Errors   throws Refusal naming the line.
/// Source   G. Turk, The PLY Polygon File Format, 1994.
#pragma once

#include "assets_baked/bake/loaders/bytes.h"
#include "assets_baked/bake/source_mesh.h"

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::bake {

enum class PlyType { I8, U8, I16, U16, I32, U32, I64, U64, F32, F64 };

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::F32;
    std::optional<PlyType> list_count; ///< type of a list's length
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    bool is_text = false;
    std::endian order = std::endian::little; ///< for binary data
    std::vector<PlyElement> elements;
    std::vector<std::string> pictures; ///< named by comments "TextureFile NAME", as in MeshLab's files
    SourceAbout about;                 ///< from the other comments
    std::size_t size = 0;              ///< bytes up to the data
};

[[nodiscard]] PlyHeader ply_header_from(ByteView file);
[[nodiscard]] std::size_t size_of(PlyType type);

} // namespace frustumscreen::bake

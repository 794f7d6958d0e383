/// Size limits of everything in a pack. A pack is untrusted data: every size in it is checked against these
/// before memory is allocated for it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace frustumscreen::pack {

/// The whole file; ZIP without ZIP64.
inline constexpr std::uint64_t max_pack_bytes = std::uint64_t{2} << 30;
inline constexpr std::uint64_t max_manifest_bytes = 16U << 20;
inline constexpr std::uint64_t max_part_bytes = std::uint64_t{1} << 29;  ///< one part, unpacked
inline constexpr std::uint64_t max_parts_bytes = std::uint64_t{2} << 30; ///< all of them, unpacked
inline constexpr std::uint64_t max_signature_bytes = 64U << 10;
inline constexpr std::size_t max_name_bytes = 100;

inline constexpr std::size_t max_languages = 64;
inline constexpr std::size_t max_language_bytes = 35; ///< RFC 5646, 4.4.1
inline constexpr std::size_t max_line_bytes = 1000;   ///< titles, names, licences
inline constexpr std::size_t max_text_bytes = 100000; ///< a caption's text
inline constexpr std::size_t max_text_lines = 1000;

inline constexpr std::size_t max_sections = 64;
inline constexpr std::size_t max_section_name_bytes = 40;
inline constexpr std::size_t max_section_parts = 4096; ///< of all sections together
/// All sections together, serialized without white space.
inline constexpr std::size_t max_section_data_bytes = 1U << 20;
inline constexpr std::size_t max_manifest_depth = 32; ///< nesting of objects and lists
/// Names, numbers, texts, objects and lists. Together with `max_object_names` it keeps a manifest's memory
/// below 48 MiB.
inline constexpr std::size_t max_manifest_values = 1U << 19;
inline constexpr std::size_t max_object_names = 4096; ///< in one object
inline constexpr std::size_t max_id_bytes = 64;
inline constexpr std::size_t max_hotspots = 3;
inline constexpr int max_table_picture_side = 1024; ///< texels

inline constexpr std::size_t max_extremes = 100000;
inline constexpr double min_scale = 0.05; ///< relative to the largest size inside the prop
inline constexpr double max_scale = 20.0;
inline constexpr std::size_t max_levels = 32;
inline constexpr std::size_t max_textures = 64;
inline constexpr std::uint32_t max_vertices = 1U << 24; ///< of one level
inline constexpr std::uint32_t max_indices = 3U << 24;  ///< of one level
inline constexpr std::uint32_t max_clusters = 1U << 22; ///< of one level
inline constexpr float max_error_box = 10.0F;           ///< the box is 1 long: a larger error is not a
                                                        ///< measurement
inline constexpr float max_colour_rmse = 255.0F;
inline constexpr std::size_t max_reliefs = 8;            ///< of the section relief_blocks
inline constexpr std::uint32_t max_relief_texels = 4096; ///< along the box's longest edge
inline constexpr std::uint32_t max_relief_blocks = 1U << 19;
inline constexpr std::size_t max_charts = 65535;    ///< their numbers are 16 bits
inline constexpr int max_side_texels = 16384;       ///< of a texture or the relief; the limit of OpenGL ES
                                                    ///< drivers
inline constexpr std::int64_t max_texels = 1 << 26; ///< of one picture
inline constexpr std::int64_t max_texels_together = 1 << 28;

} // namespace frustumscreen::pack

/// The fields of a pack's manifest, in their order, with each name and limit defined once. The reader (JsonReader)
/// and the writer (JsonWriter) walk the same description. FORMAT.md gives the meaning of the fields.
///
/// Threads  pure; any.
#pragma once

#include "app/pack/container/limits.h"
#include "app/pack/manifest.h"
#include "app/pack/pack_file.h"

#include <glm/gtc/type_ptr.hpp>

#include <array>
#include <limits>
#include <span>
#include <string_view>

namespace frustumscreen::pack {

inline constexpr std::string_view format_name = "FrustumScreen pack";
inline constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();
inline constexpr std::size_t max_parts =
    max_textures + max_levels + 2 + max_section_parts; ///< the two are the relief's
/// In the order of LevelTechnique.
inline constexpr std::array<std::string_view, 2> technique_names{"relief", "mesh"};

void caption_fields(auto& fields, auto& caption) {
    fields.text("language", caption.language);
    fields.text("title", caption.title);
    fields.text("text", caption.text);
}

void provenance_fields(auto& fields, auto& provenance) {
    fields.text("source_name", provenance.source_name);
    fields.text("source_sha256", provenance.source_sha256);
    fields.text("licence", provenance.licence);
    fields.whole("source_triangles", provenance.source_triangles, no_limit);
}

void placement_fields(auto& fields, auto& pack) {
    fields.numbers("box_size", std::span(glm::value_ptr(pack.box_size), 3));
    fields.numbers("box_from_file", std::span(glm::value_ptr(pack.box_from_file), 16)); // column by column
    fields.triples("extremes", pack.extremes, max_extremes);
    fields.number_or("scale", pack.scale, 1.0);
}

void relief_fields(auto& fields, auto& relief) {
    fields.number("texel_box", relief.texel_box);
    fields.text("atlas", relief.atlas);
    fields.text("charts", relief.charts);
}

void error_fields(auto& fields, auto& error) {
    fields.number("mean_box", error.mean_box);
    fields.number("p95_box", error.p95_box);
    fields.number("max_box", error.max_box);
    fields.number("colour_rmse", error.colour_rmse);
}

void level_fields(auto& fields, auto& level, const std::vector<std::string>& textures) {
    fields.choice("technique", level.technique, technique_names);
    fields.object("error", [&](auto& error) { error_fields(error, level.error); });
    fields.whole("triangles", level.triangles, max_indices / 3);
    fields.whole("vertices", level.vertices, max_vertices);
    fields.name_in("texture", level.texture, textures, "not one of the textures");
    fields.text("mesh", level.mesh);
}

void part_fields(auto& fields, auto& part) {
    fields.text("name", part.name);
    fields.whole("bytes", part.bytes, max_part_bytes);
    fields.text("sha256", part.sha256);
}

void section_fields(auto& fields, auto& section) {
    fields.texts("parts", section.parts, max_section_parts);
    fields.free_object("data", section.data);
}

void manifest_fields(auto& fields, auto& manifest, auto&& sections) {
    auto& pack = manifest.description;
    fields.fixed("format", format_name);
    fields.fixed("version", pack_format_version);
    fields.text("title", pack.title);
    fields.texts("languages", pack.languages, max_languages);
    fields.objects("captions", pack.captions, max_languages,
                   [](auto& item, auto& caption) { caption_fields(item, caption); });
    fields.object("provenance", [&](auto& provenance) { provenance_fields(provenance, pack.provenance); });
    fields.text("prop_kind", pack.prop_kind);
    fields.flag("unlit", pack.unlit);
    fields.whole("samples", pack.samples, 8);
    fields.whole("relief_size", pack.relief_size, max_side_texels);
    fields.object("placement", [&](auto& placement) { placement_fields(placement, pack); });
    fields.texts("textures", manifest.textures, max_textures);
    fields.object_or_null("relief", manifest.relief,
                          [](auto& item, auto& relief) { relief_fields(item, relief); });
    fields.objects("levels", manifest.levels, max_levels,
                   [&](auto& item, auto& level) { level_fields(item, level, manifest.textures); });
    fields.whole("default_level", pack.default_level, max_levels - 1);
    fields.members_or_none("sections", sections, max_sections,
                           [](auto& item, auto& section) { section_fields(item, section); });
    fields.objects("parts", manifest.parts, max_parts,
                   [](auto& item, auto& part) { part_fields(item, part); });
}

} // namespace frustumscreen::pack

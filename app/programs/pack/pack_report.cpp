#include "app/programs/pack/pack_report.h"

#include "app/pack/attribution.h"
#include "app/pack/pack_relief.h"
#include "app/pack/pack_texts.h"
#include "app/pack/signed_pack.h"
#include "app/programs/pack/state_report.h"
#include "app/programs/pack/torch_report.h"
#include "app/programs/pack/world_report.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

constexpr double mm_per_m = 1000.0;

std::string_view name_of(pack::LevelTechnique technique) {
    return technique == pack::LevelTechnique::Relief ? "relief" : "mesh";
}

std::string in_units(std::uint64_t bytes) {
    const auto value = static_cast<double>(bytes);
    return bytes < 1000      ? fmt::format("{} B", bytes)
           : bytes < 1000000 ? fmt::format("{:.1f} kB", value / 1e3)
                             : fmt::format("{:.1f} MB", value / 1e6);
}

/// The caption's further fields; empty ones are left out.
std::vector<std::pair<std::string, std::string>> details_of(const pack::PackCaption& caption) {
    std::vector<std::pair<std::string, std::string>> details{{"period", caption.period},
                                                             {"place", caption.place},
                                                             {"maker", caption.maker},
                                                             {"credit", caption.credit},
                                                             {"description", caption.description}};
    std::erase_if(details, [](const auto& detail) { return detail.second.empty(); });
    return details;
}

/// Keys of the texts that are spoken in a language.
std::vector<std::string> spoken_keys(const pack::Pack& pack, const std::string& language) {
    std::vector<std::string> keys;
    for (pack::SpokenText& spoken : pack::list_sounds(pack).value_or(std::vector<pack::SpokenText>())) {
        if (spoken.language == language) {
            keys.push_back(std::move(spoken.key));
        }
    }
    return keys;
}

double mm_per_box(const pack::Pack& pack, const settings::PropSettings& prop) {
    return pack::place(pack, settings::make_prop(prop)).metres_per_box * mm_per_m;
}

Json levels_json(const pack::Pack& pack, double mm) {
    Json levels = Json::array();
    for (const pack::PackLevel& level : pack.levels) {
        levels.push_back({{"technique", name_of(level.technique)},
                          {"triangles", level.indices.size() / 3},
                          {"vertices", level.vertices.size()},
                          {"clusters", level.clusters.size()},
                          {"texture", level.texture},
                          {"error",
                           {{"mean_mm", level.error.mean_box * mm},
                            {"p95_mm", level.error.p95_box * mm},
                            {"max_mm", level.error.max_box * mm},
                            {"colour_rmse", level.error.colour_rmse}}}});
    }
    return levels;
}

/// The pack's reliefs; empty if their section is damaged (`verify` reports the reason).
std::vector<pack::ReliefOutline> known_reliefs(const pack::Pack& pack) {
    return pack::reliefs_of(pack).value_or(std::vector<pack::ReliefOutline>());
}

Json reliefs_json(const pack::Pack& pack, double mm) {
    Json reliefs = Json::array();
    for (const pack::ReliefOutline& relief : known_reliefs(pack)) {
        reliefs.push_back({{"texels", relief.texels},
                           {"blocks", relief.blocks},
                           {"bytes", relief.bytes},
                           {"error",
                            {{"mean_mm", relief.error.mean_box * mm},
                             {"p95_mm", relief.error.p95_box * mm},
                             {"max_mm", relief.error.max_box * mm},
                             {"colour_rmse", relief.error.colour_rmse}}}});
    }
    return reliefs;
}

Json parts_json(const std::vector<pack::PackPart>& parts) {
    Json result = Json::array();
    for (const pack::PackPart& part : parts) {
        result.push_back({{"name", part.name},
                          {"bytes", part.bytes},
                          {"stored_bytes", part.stored_bytes},
                          {"sha256", part.sha256.empty() ? Json(nullptr) : Json(part.sha256)}});
    }
    return result;
}

Json captions_json(const pack::Pack& pack) {
    Json captions = Json::array();
    for (const pack::PackCaption& caption : pack.captions) {
        Json made{{"language", caption.language}, {"title", caption.title}, {"text", caption.text}};
        for (const auto& [name, text] : details_of(caption)) {
            made[name] = text;
        }
        made["spoken"] = spoken_keys(pack, caption.language);
        captions.push_back(std::move(made));
    }
    return captions;
}

Json hotspots_json(const pack::Pack& pack) {
    Json hotspots = Json::array();
    for (const pack::PackHotspot& hotspot : pack.hotspots) {
        Json labels = Json::array();
        for (const pack::PackLabel& label : hotspot.labels) {
            labels.push_back({{"language", label.language}, {"text", label.text}});
        }
        hotspots.push_back({{"point_box", {hotspot.point.x, hotspot.point.y, hotspot.point.z}},
                            {"normal", {hotspot.normal.x, hotspot.normal.y, hotspot.normal.z}},
                            {"labels", labels}});
    }
    return hotspots;
}

/// Sections that this program copies without reading them.
Json sections_json(const pack::Pack& pack) {
    Json sections = Json::array();
    for (const pack::PackSection& section : pack.sections) {
        sections.push_back(
            {{"name", section.name}, {"parts", section.parts}, {"data", Json::parse(section.data)}});
    }
    return sections;
}

void add_description(Json& json, const pack::Pack& pack) {
    json["format_version"] = pack::pack_format_version;
    json["captions"] = captions_json(pack);
    json["hotspots"] = hotspots_json(pack);
    json["table_picture"] = nullptr;
    if (!pack.table_picture.texels.empty()) {
        json["table_picture"] = {{"width", pack.table_picture.width}, {"height", pack.table_picture.height}};
    }
    json["sections"] = sections_json(pack);
    const pack::ScanRights rights = pack::scan_rights(pack).value_or(pack::ScanRights());
    json["provenance"] = {{"source_name", pack.provenance.source_name},
                          {"source_sha256", pack.provenance.source_sha256},
                          {"licence", pack.provenance.licence},
                          {"author", rights.author},
                          {"source", rights.source},
                          {"source_triangles", pack.provenance.source_triangles}};
    json["prop_kind"] = pack.prop_kind;
    json["unlit"] = pack.unlit;
    json["samples"] = pack.samples;
    json["relief_size"] = pack.relief_size;
    json["box_size"] = {pack.box_size.x, pack.box_size.y, pack.box_size.z};
    json["textures"] = Json::array();
    for (const image::Image8& texture : pack.textures) {
        json["textures"].push_back({{"width", texture.width}, {"height", texture.height}});
    }
    json["relief"] = nullptr;
    if (!pack.relief.charts.empty()) {
        json["relief"] = {{"width", pack.relief.relief.width},
                          {"height", pack.relief.relief.height},
                          {"charts", pack.relief.charts.size()},
                          {"texel_box", pack.relief.texel_box}};
    }
}

void add_placement(Json& json, const pack::Pack& pack, const settings::PropSettings& prop) {
    const pack::Placement placement = pack::place(pack, settings::make_prop(prop));
    const glm::dvec3 size = pack.box_size * placement.metres_per_box;
    json["prop"] = {{"kind", frustumscreen::settings::name_of(prop.kind)},
                    {"base_m", prop.base_m},
                    {"top_m", prop.top_m},
                    {"height_m", prop.height_m}};
    json["metres_per_box"] = placement.metres_per_box;
    json["artifact_size_m"] = {size.x, size.y, size.z};
    json["prop_from_artifact"] = Json::array();
    for (int k = 0; k < 16; ++k) {
        json["prop_from_artifact"].push_back(placement.prop_from_artifact[k / 4][k % 4]);
    }
}

std::string levels_text(const pack::Pack& pack, double mm) {
    std::string text = fmt::format("  {:<7}{:<10}{:>10}{:>10}{:>9}{:>9}{:>9}{:>9}\n", "level", "technique",
                                   "triangles", "texture", "mean mm", "p95 mm", "max mm", "colour");
    for (std::size_t k = 0; k < pack.levels.size(); ++k) {
        const pack::PackLevel& level = pack.levels[k];
        const image::Image8& texture = pack.textures[level.texture];
        text += fmt::format("  {:<7}{:<10}{:>10}{:>10}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.1f}\n",
                            fmt::format("{}{}", k, k == pack.default_level ? " *" : ""),
                            name_of(level.technique), level.indices.size() / 3,
                            fmt::format("{}x{}", texture.width, texture.height), level.error.mean_box * mm,
                            level.error.p95_box * mm, level.error.max_box * mm, level.error.colour_rmse);
    }
    return text;
}

std::string reliefs_text(const pack::Pack& pack, double mm) {
    const std::vector<pack::ReliefOutline> reliefs = known_reliefs(pack);
    std::string text = reliefs.empty()
                           ? ""
                           : fmt::format("  {:<17}{:>10}{:>10}{:>9}{:>9}{:>9}{:>9}\n", "relief texels",
                                         "blocks", "bytes", "mean mm", "p95 mm", "max mm", "colour");
    for (const pack::ReliefOutline& relief : reliefs) {
        text += fmt::format("  {:<17}{:>10}{:>10}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.1f}\n", relief.texels,
                            relief.blocks, in_units(relief.bytes), relief.error.mean_box * mm,
                            relief.error.p95_box * mm, relief.error.max_box * mm, relief.error.colour_rmse);
    }
    return text;
}

std::string matrix_text(const glm::dmat4& matrix) {
    std::string text;
    for (int row = 0; row < 4; ++row) {
        text += fmt::format("    {:>14.8g} {:>14.8g} {:>14.8g} {:>14.8g}\n", matrix[0][row], matrix[1][row],
                            matrix[2][row], matrix[3][row]);
    }
    return text;
}

std::string title_line(const OpenedPack& opened) {
    const pack::Pack& pack = *opened.pack;
    const std::string signature = opened.claim ? fmt::format("signed with the key {}, serial {}, not checked",
                                                             opened.claim->key_id, opened.claim->serial)
                                               : "unsigned";
    return fmt::format("{}: \"{}\" ({}), {}, {}, {}\n", opened.file.string(), pack.title,
                       fmt::join(pack.languages, ", "), pack.id.empty() ? "no id" : "id " + pack.id,
                       in_units(opened.file_bytes), signature);
}

bool is_ignored(const pack::PackSection& section) {
    constexpr std::array<std::string_view, 10> known{"attribution", "texts",        "sounds", "relief_blocks",
                                                     "seen_errors", "seen_reliefs", "cells",  "behaviours",
                                                     "torches",     "states"};
    return std::find(known.begin(), known.end(), section.name) == known.end();
}

std::string sections_text(const pack::Pack& pack) {
    std::string text;
    for (const pack::PackSection& section : pack.sections) {
        if (!is_ignored(section)) {
            continue;
        }
        text += fmt::format("  section {}: unknown to this version and ignored, {} parts\n", section.name,
                            section.parts.size());
    }
    return text;
}

std::string hotspots_text(const pack::Pack& pack, double mm) {
    std::string text;
    for (const pack::PackHotspot& hotspot : pack.hotspots) {
        const glm::dvec3 at = hotspot.point * mm;
        std::vector<std::string> labels;
        for (const pack::PackLabel& label : hotspot.labels) {
            labels.push_back(label.language + ": " + label.text);
        }
        text += fmt::format("  hotspot {:.1f} mm to the right, {:.1f} back, {:.1f} up; {}\n", at.x, at.y,
                            at.z, fmt::join(labels, "; "));
    }
    return text;
}

/// Describes a caption's speech; empty if there is no text to speak.
std::string speech_text(const pack::Pack& pack, const pack::PackCaption& caption) {
    const std::vector<std::string> keys = spoken_keys(pack, caption.language);
    if (!keys.empty()) {
        return fmt::format("          spoken: {}\n", fmt::join(keys, ", "));
    }
    return caption.description.empty()
               ? ""
               : "          silent: the description is shown, but no voice speaks it\n";
}

std::string on_one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

std::string description_text(const OpenedPack& opened, double mm) {
    const pack::Pack& pack = *opened.pack;
    std::string text;
    for (const pack::PackCaption& caption : pack.captions) {
        text += fmt::format("  caption {}: {}{}{}\n", caption.language, caption.title,
                            caption.text.empty() ? "" : " - ", caption.text);
        for (const auto& [name, detail] : details_of(caption)) {
            text += fmt::format("          {}: {}\n", name, printable(on_one_line(detail), 200));
        }
        text += speech_text(pack, caption);
    }
    text +=
        hotspots_text(pack, mm) + world_text(pack, mm) + torches_text(pack, opened.parts) + states_text(pack);
    if (!pack.table_picture.texels.empty()) {
        text += fmt::format("  picture for the table: {} x {} texels\n", pack.table_picture.width,
                            pack.table_picture.height);
    }
    const pack::PackProvenance& source = pack.provenance;
    text += fmt::format("  source: {}, {} triangles, licence {}\n          sha256 {}\n", source.source_name,
                        source.source_triangles, source.licence.empty() ? "not stated" : source.licence,
                        source.source_sha256.empty() ? "not stated" : source.source_sha256);
    const pack::ScanRights rights = pack::scan_rights(pack).value_or(pack::ScanRights());
    if (!rights.author.empty() || !rights.source.empty()) {
        text += fmt::format("          by {}, from {}\n",
                            rights.author.empty() ? "no name stated" : printable(rights.author, 200),
                            rights.source.empty() ? "a place not stated" : printable(rights.source, 200));
    }
    text += fmt::format("  baked for a {}, {}, {} texels along the longest edge of a face\n", pack.prop_kind,
                        pack.unlit ? "unlit" : "in museum light", pack.relief_size);
    if (!pack.relief.charts.empty()) {
        text += fmt::format("  relief: {} x {} texels, {} charts\n", pack.relief.relief.width,
                            pack.relief.relief.height, pack.relief.charts.size());
    }
    return text;
}

} // namespace

Result<OpenedPack> open_pack(const std::filesystem::path& file) {
    TRY(const Bytes bytes, read_file(file));
    TRY(pack::VerifiedPack pack, at(file.string(), pack::verify_pack(bytes)));
    TRY(std::vector<pack::PackPart> parts, at(file.string(), pack::list_pack_parts(bytes)));
    TRY(std::optional<pack::SignatureClaim> claim,
        at(file.string(), pack::PackReader::open(bytes).and_then(
                              [](pack::PackReader&& reader) { return pack::claim_of(reader); })));
    return OpenedPack{.file = file,
                      .file_bytes = bytes.size(),
                      .pack = std::move(pack),
                      .parts = std::move(parts),
                      .claim = std::move(claim)};
}

Json list_json(const OpenedPack& opened, const settings::PropSettings& prop) {
    const pack::Pack& pack = *opened.pack;
    return {{"file", opened.file.string()},
            {"bytes", opened.file_bytes},
            {"signed", opened.claim.has_value()},
            {"serial", opened.claim ? Json(opened.claim->serial) : Json(nullptr)},
            {"id", pack.id.empty() ? Json(nullptr) : Json(pack.id)},
            {"title", pack.title},
            {"languages", pack.languages},
            {"levels", levels_json(pack, mm_per_box(pack, prop))},
            {"reliefs", reliefs_json(pack, mm_per_box(pack, prop))},
            {"default_level", pack.default_level},
            {"parts", parts_json(opened.parts)}};
}

Json explain_json(const OpenedPack& opened, const settings::PropSettings& prop) {
    Json json = list_json(opened, prop);
    add_description(json, *opened.pack);
    add_placement(json, *opened.pack, prop);
    json["cells"] = cells_json(*opened.pack, json["metres_per_box"]);
    json["behaviours"] = behaviours_json(*opened.pack);
    json["torches"] = torches_json(*opened.pack, opened.parts);
    json["states"] = states_json(*opened.pack);
    return json;
}

std::string list_text(const OpenedPack& opened, const settings::PropSettings& prop) {
    const pack::Pack& pack = *opened.pack;
    const double mm = mm_per_box(pack, prop);
    std::string text = title_line(opened) + levels_text(pack, mm) + reliefs_text(pack, mm);
    for (const pack::PackPart& part : opened.parts) {
        text += fmt::format("  {:<24}{:>12}{:>12} stored\n", part.name, in_units(part.bytes),
                            in_units(part.stored_bytes));
    }
    return text + sections_text(pack);
}

std::string explain_text(const OpenedPack& opened, const settings::PropSettings& prop) {
    const pack::Pack& pack = *opened.pack;
    const pack::Placement placement = pack::place(pack, settings::make_prop(prop));
    const glm::dvec3 size = pack.box_size * placement.metres_per_box * mm_per_m;
    return list_text(opened, prop) + description_text(opened, placement.metres_per_box * mm_per_m) +
           fmt::format("  in a {} of base {} m, height {} m the artifact is {:.1f} x {:.1f} x {:.1f} mm\n"
                       "  prop_from_artifact, from the file's coordinates to the prop's, metres:\n",
                       frustumscreen::settings::name_of(prop.kind), prop.base_m, prop.height_m, size.x,
                       size.y, size.z) +
           matrix_text(placement.prop_from_artifact);
}

} // namespace frustumscreen::programs

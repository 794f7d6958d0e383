#include "app/pack/json_fields.h"
#include "app/pack/limits.h"
#include "app/pack/manifest.h"
#include "app/pack/pack_file.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>

namespace frustumscreen::pack_format {

namespace {

constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();
constexpr std::size_t most_parts = most_textures + most_levels + 2; ///< and the relief's two

/// A later format may look different in everything but these two fields, so they are read first and alone.
void read_format(Refusal& refusal, const nlohmann::json& document) {
    JsonFields fields(refusal, &document, "");
    if (const std::string format = fields.text("format");
        !refusal.message && format != "FrustumScreen pack") {
        fields.refuse("format",
                      fmt::format("is '{}'; this is not a FrustumScreen pack", printable(format, 40)));
    }
    const std::uint64_t version = fields.whole("version", no_limit);
    if (!refusal.message && version > pack_format_version) {
        refusal.refuse("the pack",
                       fmt::format("has format version {}, this program knows up to {}; it needs a newer "
                                   "FrustumScreen",
                                   version, pack_format_version));
    }
    if (!refusal.message && version == 0) {
        fields.refuse("version", fmt::format("is 0; allowed is {}", pack_format_version));
    }
}

std::vector<PackCaption> read_captions(JsonFields& fields) {
    std::vector<PackCaption> captions;
    for (JsonFields& item : fields.objects("captions", most_languages)) {
        captions.push_back({item.text("language"), item.text("title"), item.text("text")});
        item.finish();
    }
    return captions;
}

PackProvenance read_provenance(JsonFields fields) {
    PackProvenance provenance{fields.text("source_name"), fields.text("source_sha256"),
                              fields.text("licence"), fields.whole("source_triangles", no_limit)};
    fields.finish();
    return provenance;
}

void read_placement(JsonFields fields, Pack& pack) {
    std::array<double, 3> size{};
    std::array<double, 16> matrix{};
    fields.numbers("box_size", size);
    fields.numbers("box_from_file", matrix);
    pack.box_size = {size[0], size[1], size[2]};
    for (int k = 0; k < 16; ++k) {
        pack.box_from_file[k / 4][k % 4] = matrix[static_cast<std::size_t>(k)];
    }
    for (const auto& [x, y, z] : fields.triples("extremes", most_extremes)) {
        pack.extremes.push_back({x, y, z});
    }
    fields.finish();
}

LevelError read_error(JsonFields fields) {
    LevelError error{
        static_cast<float>(fields.number("mean_box")), static_cast<float>(fields.number("p95_box")),
        static_cast<float>(fields.number("max_box")), static_cast<float>(fields.number("colour_rmse"))};
    fields.finish();
    return error;
}

LevelRecord read_level(JsonFields& fields, const std::vector<std::string>& textures) {
    LevelRecord level;
    const std::string technique = fields.text("technique");
    level.technique = technique == "relief" ? LevelTechnique::Relief : LevelTechnique::Mesh;
    if (technique != "relief" && technique != "mesh") {
        fields.refuse("technique",
                      fmt::format("is '{}'; allowed are relief and mesh", printable(technique, 40)));
    }
    level.error = read_error(fields.object("error"));
    level.triangles = fields.whole("triangles", most_indices / 3);
    level.vertices = fields.whole("vertices", most_vertices);
    const std::string texture = fields.text("texture");
    const auto known = std::find(textures.begin(), textures.end(), texture);
    if (known == textures.end()) {
        fields.refuse("texture", fmt::format("is '{}', not one of the textures", printable(texture, 40)));
    }
    level.texture = static_cast<std::uint32_t>(known - textures.begin());
    level.mesh = fields.text("mesh");
    fields.finish();
    return level;
}

ReliefRecord read_relief(JsonFields fields) {
    ReliefRecord relief{static_cast<float>(fields.number("texel_box")), fields.text("atlas"),
                        fields.text("charts")};
    fields.finish();
    return relief;
}

bool is_part_name(std::string_view name) {
    const auto allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.' ||
               c == '/';
    };
    return !name.empty() && name.size() <= most_name_bytes &&
           std::all_of(name.begin(), name.end(), allowed) && name.front() != '/' &&
           name.find("..") == std::string_view::npos && name != manifest_name && name != signature_name;
}

std::vector<PartRecord> read_parts(JsonFields& fields) {
    std::vector<PartRecord> parts;
    std::set<std::string> names;
    std::uint64_t together = 0;
    for (JsonFields& item : fields.objects("parts", most_parts)) {
        PartRecord part{item.text("name"), item.whole("bytes", most_part_bytes), item.text("sha256")};
        item.finish();
        if (!is_part_name(part.name)) {
            item.refuse("name", fmt::format("is '{}'; allowed are a-z 0-9 _ - . and / between them",
                                            printable(part.name, 40)));
        }
        if (!names.insert(part.name).second) {
            item.refuse("name", fmt::format("is {}, which stands there twice", part.name));
        }
        together += part.bytes;
        parts.push_back(std::move(part));
    }
    if (together > most_parts_bytes) {
        fields.refuse("parts",
                      fmt::format("have {} bytes together, allowed are {}", together, most_parts_bytes));
    }
    return parts;
}

Manifest read_fields(Refusal& refusal, const nlohmann::json& document) {
    Manifest manifest;
    Pack& pack = manifest.description;
    JsonFields fields(refusal, &document, "");
    static_cast<void>(fields.text("format"));
    static_cast<void>(fields.whole("version", no_limit));
    pack.title = fields.text("title");
    pack.languages = fields.texts("languages", most_languages);
    pack.captions = read_captions(fields);
    pack.provenance = read_provenance(fields.object("provenance"));
    pack.prop_kind = fields.text("prop_kind");
    pack.unlit = fields.flag("unlit");
    pack.samples = static_cast<int>(fields.whole("samples", 8));
    pack.relief_size = static_cast<int>(fields.whole("relief_size", most_side_texels));
    read_placement(fields.object("placement"), pack);
    manifest.textures = fields.texts("textures", most_textures);
    if (std::optional<JsonFields> relief = fields.object_or_null("relief")) {
        manifest.relief = read_relief(std::move(*relief));
    }
    for (JsonFields& level : fields.objects("levels", most_levels)) {
        manifest.levels.push_back(read_level(level, manifest.textures));
    }
    pack.default_level = static_cast<std::uint32_t>(fields.whole("default_level", most_levels - 1));
    manifest.parts = read_parts(fields);
    fields.finish();
    return manifest;
}

} // namespace

Result<Manifest> parse_manifest(std::string_view text) {
    Refusal refusal;
    const nlohmann::json document = parse_json(refusal, text);
    if (!refusal.message) {
        read_format(refusal, document);
    }
    Manifest manifest;
    if (!refusal.message) {
        manifest = read_fields(refusal, document);
    }
    if (refusal.message) {
        return bad_input(*refusal.message);
    }
    return manifest;
}

} // namespace frustumscreen::pack_format

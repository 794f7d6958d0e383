#include "app/pack/manifest.h"

#include "app/pack/json/json_reader.h"
#include "app/pack/json/json_writer.h"
#include "app/pack/manifest_fields.h"
#include "app/pack/manifest_sections.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace frustumscreen::pack {

namespace {

/// Reads these two fields first and alone: everything else may differ in a later format.
void read_format(Refusal& refusal, const nlohmann::json& document) {
    JsonReader fields(refusal, &document, "");
    std::string format;
    fields.text("format", format);
    if (!refusal.error && format != format_name) {
        fields.refuse("manifest.not_a_pack", "format",
                      fmt::format("is '{}'; this is not a FrustumScreen pack", printable(format, 40)));
    }
    std::uint64_t version = 0;
    fields.whole("version", version, no_limit);
    if (!refusal.error && version > pack_format_version) {
        refusal.refuse("manifest.newer_format", "the pack",
                       fmt::format("has format version {}, this program knows up to {}; it needs a newer "
                                   "FrustumScreen",
                                   version, pack_format_version));
    }
    if (!refusal.error && version == 0) {
        fields.refuse("manifest.version_zero", "version",
                      fmt::format("is 0; allowed are 1 to {}", pack_format_version));
    }
}

void check_parts(Refusal& refusal, const std::vector<PartRecord>& parts) {
    std::set<std::string> names;
    std::uint64_t together = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const PartRecord& part = parts[k];
        const std::string place = fmt::format("parts[{}].name", k);
        if (!is_part_name(part.name)) {
            refusal.refuse("manifest.part_name", place,
                           fmt::format("is '{}'; allowed are a-z 0-9 _ - . and / between them",
                                       printable(part.name, 40)));
        }
        if (!names.insert(part.name).second) {
            refusal.refuse("manifest.part_twice", place, fmt::format("is {}, which occurs twice", part.name));
        }
        if (part.bytes == 0) {
            refusal.refuse("manifest.part_empty", fmt::format("parts[{}].bytes", k),
                           "is 0; a part that holds nothing is not listed");
        }
        together += part.bytes;
    }
    if (together > max_parts_bytes) {
        refusal.refuse("manifest.parts_together", "parts",
                       fmt::format("have {} bytes in all, allowed are {}", together, max_parts_bytes));
    }
}

Manifest read_fields(Refusal& refusal, const nlohmann::json& document) {
    Manifest manifest;
    std::vector<SectionRecord> sections;
    JsonReader fields(refusal, &document, "");
    manifest_fields(fields, manifest, sections);
    check_parts(refusal, manifest.parts);
    fields.finish();
    take_sections(refusal, std::move(sections), manifest);
    return manifest;
}

} // namespace

bool is_part_name(std::string_view name) {
    const auto allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.' ||
               c == '/';
    };
    return !name.empty() && name.size() <= max_name_bytes && std::all_of(name.begin(), name.end(), allowed) &&
           name.front() != '/' && name.find("..") == std::string_view::npos && name != manifest_name &&
           name != signature_name;
}

Result<Manifest> parse_manifest(std::string_view text) {
    Refusal refusal;
    const nlohmann::json document = parse_json(refusal, text);
    if (!refusal.error) {
        read_format(refusal, document);
    }
    Manifest manifest;
    if (!refusal.error) {
        manifest = read_fields(refusal, document);
    }
    if (refusal.error) {
        return tl::unexpected<Error>(*std::move(refusal.error));
    }
    return manifest;
}

std::string write_manifest(const Manifest& manifest) {
    JsonWriter fields;
    manifest_fields(fields, manifest, make_sections(manifest));
    return fields.document().dump(2) + "\n";
}

} // namespace frustumscreen::pack

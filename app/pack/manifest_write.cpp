#include "app/pack/manifest.h"
#include "app/pack/pack_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdlib>

namespace frustumscreen::pack_format {

namespace {

using Json = nlohmann::ordered_json;

/// The fewest digits that read back as the same 32-bit number.
double in_few_digits(float value) {
    const double few = std::strtod(fmt::format("{}", value).c_str(), nullptr);
    return static_cast<float>(few) == value ? few : static_cast<double>(value);
}

Json list_of(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json placement_json(const Pack& pack) {
    Json matrix = Json::array();
    for (int k = 0; k < 16; ++k) {
        matrix.push_back(pack.box_from_file[k / 4][k % 4]);
    }
    Json extremes = Json::array();
    for (const glm::dvec3& extreme : pack.extremes) {
        extremes.push_back(list_of(extreme));
    }
    return {{"box_size", list_of(pack.box_size)}, {"box_from_file", matrix}, {"extremes", extremes}};
}

Json captions_json(const Pack& pack) {
    Json captions = Json::array();
    for (const PackCaption& caption : pack.captions) {
        captions.push_back(
            {{"language", caption.language}, {"title", caption.title}, {"text", caption.text}});
    }
    return captions;
}

Json levels_json(const Manifest& manifest) {
    Json levels = Json::array();
    for (const LevelRecord& level : manifest.levels) {
        const LevelError& error = level.error;
        levels.push_back({{"technique", level.technique == LevelTechnique::Relief ? "relief" : "mesh"},
                          {"error",
                           {{"mean_box", in_few_digits(error.mean_box)},
                            {"p95_box", in_few_digits(error.p95_box)},
                            {"max_box", in_few_digits(error.max_box)},
                            {"colour_rmse", in_few_digits(error.colour_rmse)}}},
                          {"triangles", level.triangles},
                          {"vertices", level.vertices},
                          {"texture", manifest.textures[level.texture]},
                          {"mesh", level.mesh}});
    }
    return levels;
}

Json relief_json(const std::optional<ReliefRecord>& relief) {
    if (!relief) {
        return nullptr;
    }
    return {{"texel_box", in_few_digits(relief->texel_box)},
            {"atlas", relief->atlas},
            {"charts", relief->charts}};
}

Json parts_json(const Manifest& manifest) {
    Json parts = Json::array();
    for (const PartRecord& part : manifest.parts) {
        parts.push_back({{"name", part.name}, {"bytes", part.bytes}, {"sha256", part.sha256}});
    }
    return parts;
}

} // namespace

std::string write_manifest(const Manifest& manifest) {
    const Pack& pack = manifest.description;
    const PackProvenance& provenance = pack.provenance;
    const Json document{{"format", "FrustumScreen pack"},
                        {"version", pack_format_version},
                        {"title", pack.title},
                        {"languages", pack.languages},
                        {"captions", captions_json(pack)},
                        {"provenance",
                         {{"source_name", provenance.source_name},
                          {"source_sha256", provenance.source_sha256},
                          {"licence", provenance.licence},
                          {"source_triangles", provenance.source_triangles}}},
                        {"prop_kind", pack.prop_kind},
                        {"unlit", pack.unlit},
                        {"samples", pack.samples},
                        {"relief_size", pack.relief_size},
                        {"placement", placement_json(pack)},
                        {"textures", manifest.textures},
                        {"relief", relief_json(manifest.relief)},
                        {"levels", levels_json(manifest)},
                        {"default_level", pack.default_level},
                        {"parts", parts_json(manifest)}};
    return document.dump(2) + "\n";
}

} // namespace frustumscreen::pack_format

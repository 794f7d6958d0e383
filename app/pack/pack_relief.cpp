#include "app/pack/pack_relief.h"

#include "app/pack/block_part.h"
#include "app/pack/json/json_reader.h"
#include "app/pack/json/json_writer.h"
#include "app/pack/manifest_fields.h"
#include "app/pack/pack_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace frustumscreen::pack {

namespace {

constexpr std::string_view section_name = "relief_blocks";

void rasterize_relief_fields(auto& fields, auto& relief) {
    fields.whole("texels", relief.texels, max_relief_texels);
    fields.whole("blocks", relief.blocks, max_relief_blocks);
    fields.whole("bytes", relief.bytes, max_part_bytes);
    fields.object("error", [&](auto& error) { error_fields(error, relief.error); });
    fields.text("part", relief.part);
}

void reliefs_fields(auto& fields, auto& reliefs) {
    fields.objects("reliefs", reliefs, max_reliefs,
                   [](auto& item, auto& relief) { rasterize_relief_fields(item, relief); });
}

std::optional<std::string> fault_of(const std::vector<ReliefOutline>& reliefs,
                                    const std::vector<std::string>& parts) {
    std::uint32_t last = 0;
    for (std::size_t k = 0; k < reliefs.size(); ++k) {
        const LevelError& error = reliefs[k].error;
        const auto measured = [](float value, float most) { return value >= 0.0F && value <= most; };
        if (reliefs[k].texels <= last || !measured(error.mean_box, max_error_box) ||
            !measured(error.p95_box, max_error_box) || !measured(error.max_box, max_error_box) ||
            !measured(error.colour_rmse, max_colour_rmse)) {
            return fmt::format("has a relief of {} texels that is not finer than the one before, or whose "
                               "error is not a measured one; bake the pack again",
                               reliefs[k].texels);
        }
        last = reliefs[k].texels;
    }
    const bool same = std::equal(reliefs.begin(), reliefs.end(), parts.begin(), parts.end(),
                                 [](const ReliefOutline& a, const std::string& b) { return a.part == b; });
    return same ? std::nullopt
                : std::optional<std::string>("does not name exactly its own parts; bake the pack again");
}

/// Decodes a relief and checks it against the manifest.
Result<relief::BlockRelief> decode(const ReliefOutline& outline, const Bytes& bytes) {
    TRY(relief::BlockRelief relief, at(outline.part, decode_blocks(bytes)));
    if (bytes.size() != outline.bytes || relief.blocks.size() != outline.blocks ||
        std::lround(1.0F / relief.texel_box) != std::lround(outline.texels)) {
        return bad_input("pack.other_relief",
                         "{} holds another relief than the manifest says; the pack is altered", outline.part);
    }
    return relief;
}

} // namespace

Result<std::vector<ReliefOutline>> reliefs_of(const PackDescription& pack) {
    std::vector<ReliefOutline> reliefs;
    const auto section = std::find_if(pack.sections.begin(), pack.sections.end(),
                                      [](const PackSection& one) { return one.name == section_name; });
    if (section == pack.sections.end()) {
        return reliefs;
    }
    Refusal refusal;
    const nlohmann::json data = parse_json(refusal, section->data);
    if (!refusal.error) {
        JsonReader fields(refusal, &data, fmt::format("sections.{}.data", section_name));
        reliefs_fields(fields, reliefs);
        fields.finish();
    }
    if (refusal.error) {
        return tl::unexpected<Error>(*std::move(refusal.error));
    }
    if (const std::optional<std::string> fault = fault_of(reliefs, section->parts)) {
        return bad_input("pack.relief_section", "the section {} {}", section_name, *fault);
    }
    return reliefs;
}

void put_reliefs(Pack& pack, std::span<const MeasuredRelief> reliefs) {
    if (reliefs.empty()) {
        return;
    }
    PackSection section{std::string(section_name), {}, {}};
    std::vector<ReliefOutline> outlines;
    for (const MeasuredRelief& measured : reliefs) {
        const auto texels = static_cast<std::uint32_t>(std::lround(1.0F / measured.relief.texel_box));
        const std::string part = fmt::format("{}/{}.bin", section_name, texels);
        Bytes bytes = encode_blocks(measured.relief);
        outlines.push_back({.texels = texels,
                            .blocks = static_cast<std::uint32_t>(measured.relief.blocks.size()),
                            .bytes = bytes.size(),
                            .error = measured.error,
                            .part = part});
        section.parts.push_back(part);
        pack.section_parts[part] = std::move(bytes);
    }
    JsonWriter fields;
    reliefs_fields(fields, outlines);
    section.data = nlohmann::json(fields.document()).dump(); // keys in order
    pack.sections.push_back(std::move(section));
}

Result<relief::BlockRelief> load_relief(const std::filesystem::path& file, const ReliefOutline& relief) {
    const Result<std::map<std::string, Bytes>> parts =
        load_section_parts(file, [&](const PackDescription& pack) -> Result<std::vector<std::string>> {
            TRY(const std::vector<ReliefOutline> there, reliefs_of(pack));
            if (std::find(there.begin(), there.end(), relief) == there.end()) {
                return bad_input("pack.relief_gone", "it no longer has this relief of {} texels",
                                 relief.texels);
            }
            return std::vector{relief.part};
        });
    TRY_VOID(parts);
    return at(file.string(), decode(relief, parts->at(relief.part)));
}

Result<relief::BlockRelief> relief_of(const Pack& pack, const ReliefOutline& relief) {
    return decode(relief, pack.section_parts.at(relief.part));
}

Result<void> check_reliefs(const Pack& pack) {
    TRY(const std::vector<ReliefOutline> reliefs, reliefs_of(pack));
    for (const ReliefOutline& relief : reliefs) {
        TRY_VOID(without_value(relief_of(pack, relief)));
    }
    return {};
}

} // namespace frustumscreen::pack

#include "app/pack/manifest_sections.h"

#include "app/pack/container/limits.h"
#include "app/pack/json/json_writer.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <set>

namespace frustumscreen::pack {

namespace {

constexpr std::string_view identity = "identity";
constexpr std::string_view details = "details";
constexpr std::string_view hotspots = "hotspots";
constexpr std::string_view table_picture = "table_picture";

void detail_fields(auto& fields, auto& caption) {
    fields.text("language", caption.language);
    fields.text("period", caption.period);
    fields.text("place", caption.place);
    fields.text("maker", caption.maker);
    fields.text("credit", caption.credit);
    fields.text("description", caption.description);
}

void label_fields(auto& fields, auto& label) {
    fields.text("language", label.language);
    fields.text("text", label.text);
}

void hotspot_fields(auto& fields, auto& hotspot) {
    fields.numbers("point", std::span(glm::value_ptr(hotspot.point), 3));
    fields.numbers("normal", std::span(glm::value_ptr(hotspot.normal), 3));
    fields.objects("labels", hotspot.labels, max_languages,
                   [](auto& item, auto& label) { label_fields(item, label); });
}

void identity_fields(auto& fields, auto& pack) {
    fields.text("id", pack.id);
}

void details_fields(auto& fields, auto& captions) {
    fields.objects("captions", captions, max_languages,
                   [](auto& item, auto& caption) { detail_fields(item, caption); });
}

void hotspots_fields(auto& fields, auto& pack) {
    fields.objects("hotspots", pack.hotspots, max_hotspots,
                   [](auto& item, auto& hotspot) { hotspot_fields(item, hotspot); });
}

bool says_more_than_a_caption(const PackCaption& caption) {
    return !(caption.period.empty() && caption.place.empty() && caption.maker.empty() &&
             caption.credit.empty() && caption.description.empty());
}

/// Adds the details in a language to the caption of that language.
void add_details(Refusal& refusal, std::vector<PackCaption> read, std::vector<PackCaption>& captions) {
    std::set<std::string> seen;
    for (PackCaption& from : read) {
        const auto same = [&](const PackCaption& caption) { return caption.language == from.language; };
        const auto to = std::find_if(captions.begin(), captions.end(), same);
        if (!seen.insert(from.language).second ||
            std::count_if(captions.begin(), captions.end(), same) != 1) {
            refusal.refuse(
                "manifest.caption_language", "sections.details.data.captions",
                fmt::format("has the language '{}'; allowed are languages with one caption, each once",
                            printable(from.language, 40)));
            return;
        }
        from.title = std::move(to->title);
        from.text = std::move(to->text);
        *to = std::move(from);
    }
}

void take_known(Refusal& refusal, SectionRecord& record, Manifest& manifest) {
    const std::string place = "sections." + record.name;
    const std::size_t parts = record.name == table_picture ? 1 : 0;
    if (record.parts.size() != parts) {
        refusal.refuse("manifest.section_parts", place + ".parts",
                       fmt::format("has {}; allowed is {}", record.parts.size(), parts));
        return;
    }
    const nlohmann::json data = nlohmann::json::parse(record.data);
    JsonReader fields(refusal, &data, place + ".data");
    if (record.name == identity) {
        identity_fields(fields, manifest.description);
    } else if (record.name == details) {
        std::vector<PackCaption> read;
        details_fields(fields, read);
        add_details(refusal, std::move(read), manifest.description.captions);
    } else if (record.name == hotspots) {
        hotspots_fields(fields, manifest.description);
    } else {
        manifest.table_picture = std::move(record.parts.front());
    }
    fields.finish();
}

void add_record(std::vector<SectionRecord>& records, std::string_view name, const auto& describe) {
    JsonWriter fields;
    describe(fields);
    records.push_back({std::string(name), {}, fields.document().dump()});
}

} // namespace

bool is_known_section(std::string_view name) {
    static constexpr std::array<std::string_view, 4> known{identity, details, hotspots, table_picture};
    return std::find(known.begin(), known.end(), name) != known.end();
}

void take_sections(Refusal& refusal, std::vector<SectionRecord> records, Manifest& manifest) {
    std::size_t parts = 0;
    std::size_t data_bytes = 0;
    for (SectionRecord& record : records) {
        parts += record.parts.size();
        data_bytes += record.data.size();
        if (data_bytes > max_section_data_bytes) {
            refusal.refuse("manifest.sections_too_large", "sections",
                           fmt::format("have more than {} bytes of data in all; allowed are fewer",
                                       max_section_data_bytes));
        }
        if (refusal.error) {
            return;
        }
        if (is_known_section(record.name)) {
            take_known(refusal, record, manifest);
        } else {
            manifest.description.sections.push_back(
                {std::move(record.name), std::move(record.data), std::move(record.parts)});
        }
    }
    if (parts > max_section_parts) {
        refusal.refuse("manifest.section_part_count", "sections",
                       fmt::format("have {} parts in all, allowed are {}", parts, max_section_parts));
    }
}

std::vector<SectionRecord> make_sections(const Manifest& manifest) {
    const PackDescription& pack = manifest.description;
    std::vector<SectionRecord> records;
    if (!pack.id.empty()) {
        add_record(records, identity, [&](JsonWriter& fields) { identity_fields(fields, pack); });
    }
    std::vector<PackCaption> detailed;
    std::copy_if(pack.captions.begin(), pack.captions.end(), std::back_inserter(detailed),
                 says_more_than_a_caption);
    if (!detailed.empty()) {
        add_record(records, details, [&](JsonWriter& fields) { details_fields(fields, detailed); });
    }
    if (!pack.hotspots.empty()) {
        add_record(records, hotspots, [&](JsonWriter& fields) { hotspots_fields(fields, pack); });
    }
    if (!manifest.table_picture.empty()) {
        records.push_back({std::string(table_picture), {manifest.table_picture}, "{}"});
    }
    for (const PackSection& section : pack.sections) {
        records.push_back({section.name, section.parts, section.data});
    }
    std::sort(records.begin(), records.end(),
              [](const SectionRecord& a, const SectionRecord& b) { return a.name < b.name; });
    return records;
}

} // namespace frustumscreen::pack

#include "app/pack/attribution.h"

#include "app/pack/json/json_reader.h"
#include "app/pack/json/json_writer.h"
#include "app/pack/pack_text.h"
#include "firmware_host/base/trimmed.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>

namespace frustumscreen::pack {

namespace {

constexpr std::string_view section_name = "attribution";
constexpr std::string_view between = " \u00B7 ";

/// Joins the parts that are not empty.
std::string joined(std::initializer_list<std::string_view> parts, std::string_view separator) {
    std::string all;
    for (const std::string_view part : parts) {
        if (!part.empty()) {
            all += all.empty() ? "" : separator;
            all += part;
        }
    }
    return all;
}

/// The licence's name alone, from "CC-BY-4.0 (http://creativecommons.org/licenses/by/4.0/)" as Sketchfab writes it.
std::string_view without_address_behind(std::string_view licence) {
    const std::size_t bracket = licence.find(" (http");
    return bracket != 0 && licence.ends_with(')') ? trimmed(licence.substr(0, bracket)) : licence;
}

std::string scan_line(const PackCaption& caption, const ScanRights& rights) {
    const std::string licence = with_short_addresses(without_address_behind(rights.licence));
    const std::string author = with_short_addresses(rights.author);
    const bool is_said = !licence.empty() && (caption.credit.find(licence) != std::string::npos ||
                                              author.find(licence) != std::string::npos);
    const std::string line = joined({author, is_said ? "" : licence}, between);
    return line.empty() ? line : "3D: " + line;
}

/// True for a Creative Commons licence that requires the author's name: all but CC0.
bool asks_for_author(std::string_view licence) {
    std::string letters;
    for (const char c : licence.substr(0, 5)) {
        letters += c == ' ' || c == '_' ? '-' : c >= 'a' && c <= 'z' ? static_cast<char>(c - ('a' - 'A')) : c;
    }
    return letters == "CC-BY";
}

void section_fields(auto& fields, auto& rights) {
    fields.text("author", rights.author);
    fields.text("source", rights.source);
}

Result<void> check_line(std::string_view what, const std::string& text) {
    const std::optional<std::string> fault = fault_of_text(text, TextShape::Line);
    return fault ? bad_input("pack.attribution", "the scan's {} {}", what, *fault) : Result<void>();
}

} // namespace

void put_scan_rights(Pack& pack, const ScanRights& rights) {
    pack.provenance.licence = rights.licence;
    if (rights.author.empty() && rights.source.empty()) {
        return;
    }
    JsonWriter fields;
    section_fields(fields, rights);
    pack.sections.push_back(
        {std::string(section_name), nlohmann::json(fields.document()).dump(), {}}); // keys in order
}

Result<ScanRights> scan_rights(const PackDescription& pack) {
    ScanRights rights{pack.provenance.licence, {}, {}};
    const auto section = std::find_if(pack.sections.begin(), pack.sections.end(),
                                      [](const PackSection& each) { return each.name == section_name; });
    if (section == pack.sections.end()) {
        return rights;
    }
    if (!section->parts.empty()) {
        return bad_input("pack.attribution_parts", "the section {} has {} parts; allowed are none",
                         section_name, section->parts.size());
    }
    Refusal refusal;
    const nlohmann::json data = parse_json(refusal, section->data);
    if (!refusal.error) {
        JsonReader fields(refusal, &data, "sections.attribution.data");
        section_fields(fields, rights);
        fields.finish();
    }
    if (refusal.error) {
        return tl::unexpected<Error>(*std::move(refusal.error));
    }
    TRY_VOID(check_line("author", rights.author));
    TRY_VOID(check_line("source", rights.source));
    return rights;
}

std::string attribution_of(const PackCaption& caption, const ScanRights& rights) {
    const std::string artifact = joined({caption.maker, caption.place, caption.period}, between);
    return joined({artifact, caption.credit, scan_line(caption, rights)}, "\n");
}

std::string with_short_addresses(std::string_view text) {
    constexpr std::array<std::string_view, 2> schemes{"https://", "http://"};
    std::string made;
    while (!text.empty()) {
        const auto scheme = std::find_if(schemes.begin(), schemes.end(),
                                         [&](std::string_view each) { return text.starts_with(each); });
        if (scheme == schemes.end()) {
            made += text.front();
            text.remove_prefix(1);
            continue;
        }
        text.remove_prefix(scheme->size());
        const std::size_t end = std::min(text.find_first_of(" \t\n)]>\"'"), text.size());
        const std::string_view host = text.substr(0, std::min(text.substr(0, end).find_first_of("/?#"), end));
        made += host.starts_with("www.") ? host.substr(4) : host;
        text.remove_prefix(end);
    }
    return made;
}

std::vector<std::string> missing_in(const PackDescription& pack, const ScanRights& rights) {
    std::vector<std::string> missing;
    const bool has_credit =
        !pack.captions.empty() && std::none_of(pack.captions.begin(), pack.captions.end(),
                                               [](const PackCaption& each) { return each.credit.empty(); });
    if (rights.licence.empty()) {
        missing.emplace_back("the licence: none is stated; bake it with --licence, or with licence = \"...\" "
                             "in artifact.toml, even if it is \"all rights reserved\"");
    } else if (asks_for_author(rights.licence) && rights.author.empty() && !has_credit) {
        missing.push_back("the author: the licence " + rights.licence +
                          " asks for the name, and none is stated; bake it with --author, or with author = "
                          "\"...\" in artifact.toml");
    }
    if (pack.id.empty()) {
        missing.emplace_back(
            "the id: a later pack of this artifact does not replace this one on a kiosk; bake it "
            "again, with id = \"...\" in artifact.toml or without");
    }
    return missing;
}

} // namespace frustumscreen::pack

#include "app/pack/check_pack.h"
#include "app/pack/container/limits.h"
#include "app/pack/manifest_sections.h"
#include "app/pack/relief_texel.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace frustumscreen::pack {

namespace {

constexpr double normal_tolerance = 1e-3;
constexpr std::size_t depth_of_data = 3; // the manifest, its sections, the section
constexpr double box_tolerance = 1e-3;   // as the placement's extremes

bool is_section_name(std::string_view name) {
    const auto allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
    return !name.empty() && name.size() <= max_section_name_bytes &&
           std::all_of(name.begin(), name.end(), allowed);
}

/// True if the text is a JSON object that the manifest can hold.
bool is_object(const std::string& text) {
    Refusal refusal;
    const nlohmann::json data = parse_json(refusal, text, max_manifest_depth - depth_of_data);
    return !refusal.error && data.is_object();
}

Result<void> check_hotspot(const std::string& place, const PackHotspot& hotspot, const glm::dvec3& box_size) {
    const glm::dvec3 inside = hotspot.point - box_low(box_size);
    const glm::dvec3 beyond = glm::max(-inside, inside - box_size);
    if (!(std::max({beyond.x, beyond.y, beyond.z}) <= box_tolerance)) {
        return bad_input("hotspot.outside_box", "{} lies at ({}, {}, {}), outside the artifact's box", place,
                         hotspot.point.x, hotspot.point.y, hotspot.point.z);
    }
    if (!(std::abs(glm::length(hotspot.normal) - 1.0) <= normal_tolerance)) {
        return bad_input("hotspot.normal", "{} has the normal ({}, {}, {}); allowed is one of length 1",
                         place, hotspot.normal.x, hotspot.normal.y, hotspot.normal.z);
    }
    return check_labels(place, hotspot.labels);
}

} // namespace

Result<void> check_sections(const PackDescription& pack) {
    std::size_t parts = 0;
    std::size_t data_bytes = 0;
    std::set<std::string_view> names;
    for (const PackSection& section : pack.sections) {
        parts += section.parts.size();
        data_bytes += section.data.size();
        if (data_bytes > max_section_data_bytes) {
            return bad_input("sections.too_large",
                             "the sections have more than {} bytes of data in all; put what is large "
                             "into parts",
                             max_section_data_bytes);
        }
        if (!is_section_name(section.name) || is_known_section(section.name) ||
            !names.insert(section.name).second) {
            return bad_input("sections.name",
                             "a section is called '{}'; allowed are a-z 0-9 and _, each name once",
                             printable(section.name, 40));
        }
        if (!is_object(section.data)) {
            return bad_input("sections.data", "the data of the section {} are not a JSON object",
                             section.name);
        }
    }
    if (names.size() > max_sections || parts > max_section_parts) {
        return bad_input("sections.counts", "the pack has {} sections with {} parts, allowed are {} and {}",
                         names.size(), parts, max_sections, max_section_parts);
    }
    return {};
}

Result<void> check_hotspots(const PackDescription& pack) {
    if (pack.hotspots.size() > max_hotspots) {
        return bad_input("hotspot.count", "the pack has {} hotspots, allowed are {}", pack.hotspots.size(),
                         max_hotspots);
    }
    for (std::size_t k = 0; k < pack.hotspots.size(); ++k) {
        const auto place = fmt::format("hotspot {}", k);
        TRY_VOID(check_hotspot(place, pack.hotspots[k], pack.box_size));
    }
    return {};
}

Result<void> check_description(const PackDescription& pack) {
    return check_texts(pack)
        .and_then([&] { return check_placement(pack); })
        .and_then([&] { return check_hotspots(pack); })
        .and_then([&] { return check_sections(pack); });
}

} // namespace frustumscreen::pack

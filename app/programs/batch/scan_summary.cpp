#include "app/programs/batch/scan_summary.h"

#include "app/programs/preview/html_parts.h"
#include "firmware_host/base/json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace frustumscreen::programs {

namespace {

std::string yes_or_no(bool is) {
    return is ? "yes" : "no";
}

std::string picture_words(const ScanSummary& scan) {
    std::vector<std::string> words;
    for (const auto& [width, height] : scan.pictures) {
        words.push_back(fmt::format("{}x{}", width, height));
    }
    return fmt::format("{}", fmt::join(words, " "));
}

/// Pictures of one size together: "2 of 4096x4096, 512x512".
std::string pictures_for_people(const ScanSummary& scan) {
    std::vector<std::string> groups;
    std::size_t begin = 0;
    for (std::size_t k = 1; k <= scan.pictures.size(); ++k) {
        if (k < scan.pictures.size() && scan.pictures[k] == scan.pictures[begin]) {
            continue;
        }
        const auto& [width, height] = scan.pictures[begin];
        groups.push_back(k - begin > 1 ? fmt::format("{} of {}x{}", k - begin, width, height)
                                       : fmt::format("{}x{}", width, height));
        begin = k;
    }
    return groups.empty() ? "none" : fmt::format("{}", fmt::join(groups, ", "));
}

std::string number(std::uint64_t value) {
    return fmt::format("{}", value);
}

std::string extents(const ScanSummary& scan, std::string_view between) {
    return fmt::format("{:.4g}{}{:.4g}{}{:.4g}", scan.extents[0], between, scan.extents[1], between,
                       scan.extents[2]);
}

using Scan = const ScanSummary&;

constexpr std::array columns{
    ScanColumn{.key = "format",
               .heading = "format",
               .is_text = true,
               .plain = [](Scan s) { return s.format; },
               .shown = [](Scan s) { return s.format; }},
    ScanColumn{.key = "triangles",
               .heading = "triangles",
               .is_text = false,
               .plain = [](Scan s) { return number(s.triangles); },
               .shown = [](Scan s) { return number(s.triangles); }},
    ScanColumn{.key = "vertices",
               .heading = "vertices",
               .is_text = false,
               .plain = [](Scan s) { return number(s.vertices); },
               .shown = [](Scan s) { return number(s.vertices); }},
    ScanColumn{.key = "pictures",
               .heading = "pictures",
               .is_text = true,
               .plain = picture_words,
               .shown = pictures_for_people},
    ScanColumn{.key = "materials",
               .heading = "materials",
               .is_text = false,
               .plain = [](Scan s) { return number(s.materials); },
               .shown = [](Scan s) { return number(s.materials); }},
    ScanColumn{.key = "colours",
               .heading = "vertex colours",
               .is_text = true,
               .plain = [](Scan s) { return yes_or_no(s.has_colours); },
               .shown = [](Scan s) { return yes_or_no(s.has_colours); }},
    ScanColumn{.key = "normals",
               .heading = "normals",
               .is_text = true,
               .plain = [](Scan s) { return yes_or_no(s.has_normals); },
               .shown = [](Scan s) { return yes_or_no(s.has_normals); }},
    ScanColumn{.key = "extents",
               .heading = "extents",
               .is_text = true,
               .plain = [](Scan s) { return extents(s, " "); },
               .shown = [](Scan s) { return extents(s, " x "); }},
    ScanColumn{.key = "unit",
               .heading = "unit, guessed",
               .is_text = true,
               .plain = [](Scan s) { return s.unit; },
               .shown = [](Scan s) { return s.unit.empty() ? std::string("?") : s.unit; }},
    ScanColumn{.key = "estimated_bytes",
               .heading = "pack, about",
               .is_text = false,
               .plain = [](Scan s) { return number(s.estimated_bytes); },
               .shown = [](Scan s) { return bytes_in_words(s.estimated_bytes); }},
    ScanColumn{.key = "estimated_triangles",
               .heading = "shown, about",
               .is_text = false,
               .plain = [](Scan s) { return number(s.estimated_triangles); },
               .shown = [](Scan s) { return number(s.estimated_triangles); }},
    ScanColumn{.key = "lost",
               .heading = "lost",
               .is_text = false,
               .plain = [](Scan s) { return number(s.lost); },
               .shown = [](Scan s) { return number(s.lost); }},
};

} // namespace

std::span<const ScanColumn> scan_columns() {
    return columns;
}

nlohmann::ordered_json json_of(const ScanSummary& scan) {
    return {{"format", scan.format},
            {"triangles", scan.triangles},
            {"vertices", scan.vertices},
            {"pictures", scan.pictures},
            {"materials", scan.materials},
            {"colours", scan.has_colours},
            {"normals", scan.has_normals},
            {"extents", scan.extents},
            {"unit", scan.unit},
            {"estimated_bytes", scan.estimated_bytes},
            {"estimated_triangles", scan.estimated_triangles}};
}

ScanSummary summary_from(const nlohmann::ordered_json& json) {
    ScanSummary scan;
    json.at("format").get_to(scan.format);
    json.at("triangles").get_to(scan.triangles);
    json.at("vertices").get_to(scan.vertices);
    json.at("pictures").get_to(scan.pictures);
    json.at("materials").get_to(scan.materials);
    json.at("colours").get_to(scan.has_colours);
    json.at("normals").get_to(scan.has_normals);
    json.at("extents").get_to(scan.extents);
    json.at("unit").get_to(scan.unit);
    json.at("estimated_bytes").get_to(scan.estimated_bytes);
    json.at("estimated_triangles").get_to(scan.estimated_triangles);
    return scan;
}

} // namespace frustumscreen::programs

#include "app/pack/pack_site.h"

#include "app/pack/json/json_reader.h"
#include "app/pack/json/json_writer.h"
#include "app/pack/world_sections.h"

#include <cassert>
#include <limits>
#include <string>
#include <utility>

namespace frustumscreen::pack {

namespace {

constexpr std::string_view section_name = "site";

void site_fields(auto& fields, auto& site) {
    fields.whole("max_triangles", site.max_triangles, std::numeric_limits<std::uint32_t>::max());
    fields.triples("places", site.places, world::max_cells);
}

} // namespace

void put_site(const PackSite& site, PackDescription& pack) {
    assert(find_section(pack, section_name) == nullptr);
    JsonWriter fields;
    site_fields(fields, site);
    pack.sections.push_back({std::string(section_name), nlohmann::json(fields.document()).dump(), {}});
}

Result<std::optional<PackSite>> site_of(const PackDescription& pack) {
    const PackSection* const section = find_section(pack, section_name);
    if (section == nullptr) {
        return std::nullopt;
    }
    PackSite site;
    Refusal refusal;
    const nlohmann::json data = parse_json(refusal, section->data);
    if (!refusal.error) {
        JsonReader fields(refusal, &data, "sections.site.data");
        site_fields(fields, site);
        fields.finish();
    }
    if (refusal.error) {
        return tl::unexpected<Error>(*std::move(refusal.error));
    }
    if (site.max_triangles == 0) {
        return bad_input("site.max_triangles",
                         "sections.site.data.max_triangles is 0; allowed is 1 or more: bake the pack again");
    }
    return site;
}

Result<std::vector<SiteRegion>> site_regions_of(const PackDescription& pack) {
    TRY(const std::optional<PackSite> site, site_of(pack));
    std::vector<SiteRegion> regions;
    if (!site) {
        return regions;
    }
    TRY(const PackWorld world, world_outline_of(pack));
    for (const PackCell& cell : world.cells) {
        if (cell.cell.has_geometry) {
            regions.push_back({cell.low, cell.high});
        }
    }
    constexpr double rounding = 1e-6;
    for (std::size_t k = 0; k < regions.size() && k < site->places.size(); ++k) {
        const glm::dvec3& place = site->places[k];
        if (!glm::all(glm::greaterThanEqual(place, regions[k].low - rounding)) ||
            !glm::all(glm::lessThanEqual(place, regions[k].high + rounding))) {
            return bad_input("site.place",
                             "sections.site.data.places[{}] is not in its region; bake the pack again", k);
        }
        regions[k].low.z = place.z;
    }
    if (site->places.size() != regions.size()) {
        return bad_input(
            "site.places",
            "sections.site.data has {} places for {} regions; allowed is one for each: bake the pack again",
            site->places.size(), regions.size());
    }
    if (regions.empty() || !world.behaviours.empty()) {
        return bad_input(
            "site.cells",
            "sections.site is there, but {}; a site has cells, and nothing of it moves: bake the pack again",
            regions.empty() ? "no cell has geometry" : "the pack has behaviours");
    }
    return regions;
}

} // namespace frustumscreen::pack

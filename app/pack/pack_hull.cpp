#include "app/pack/pack_hull.h"

#include "app/geometry/convex_hull.h"
#include "app/pack/container/limits.h"
#include "app/pack/json/json_reader.h"
#include "app/pack/json/json_writer.h"
#include "app/pack/pack_file.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace frustumscreen::pack {

namespace {

constexpr std::string_view section_name = "hull";
/// The hull may be a little larger than the box if it has fewer corners than the artifact.
constexpr double farthest_box = 2.0;

void hull_fields(auto& fields, auto& corners) {
    fields.triples("corners", corners, max_hull_corners);
}

const PackSection* find_section(const PackDescription& pack) {
    const auto found = std::find_if(pack.sections.begin(), pack.sections.end(),
                                    [](const PackSection& section) { return section.name == section_name; });
    return found != pack.sections.end() ? &*found : nullptr;
}

bool is_near_box(const glm::dvec3& corner) {
    return glm::length(corner) <= farthest_box; // false for NaN
}

} // namespace

std::vector<glm::dvec3> corners_of_box(const PackDescription& pack) {
    std::vector<glm::dvec3> corners;
    for (unsigned k = 0; k < 8; ++k) {
        corners.push_back(
            glm::dvec3((k & 1U) != 0 ? 0.5 : -0.5, (k & 2U) != 0 ? 0.5 : -0.5, (k & 4U) != 0 ? 1.0 : 0.0) *
            pack.box_size);
    }
    return corners;
}

void put_hull(const std::vector<glm::dvec3>& corners, PackDescription& pack) {
    assert(find_section(pack) == nullptr);
    JsonWriter fields;
    hull_fields(fields, corners);
    pack.sections.push_back({std::string(section_name), nlohmann::json(fields.document()).dump(), {}});
}

Result<std::vector<glm::dvec3>> hull_of(const PackDescription& pack) {
    const PackSection* const section = find_section(pack);
    if (section == nullptr) {
        return corners_of_box(pack);
    }
    std::vector<glm::dvec3> corners;
    Refusal refusal;
    const nlohmann::json data = parse_json(refusal, section->data);
    if (!refusal.error) {
        JsonReader fields(refusal, &data, "sections.hull.data");
        hull_fields(fields, corners);
        fields.finish();
    }
    if (refusal.error) {
        return tl::unexpected<Error>(*std::move(refusal.error));
    }
    if (corners.empty() || !std::all_of(corners.begin(), corners.end(), is_near_box)) {
        return bad_input("hull.corners",
                         "sections.hull.data.corners has no corner, or one that is farther than {} from the "
                         "box's foot; bake the pack again",
                         farthest_box);
    }
    return corners;
}

Result<std::vector<glm::dvec3>> hull_in(const PackDescription& pack, const geometry::PropShape& prop,
                                        std::size_t most) {
    TRY(std::vector<glm::dvec3> corners, hull_of(pack));
    const double scale = place(pack, prop).metres_per_box;
    for (glm::dvec3& corner : corners) {
        corner *= scale;
    }
    return corners.size() > most ? geometry::enclosing_corners(corners, most) : corners;
}

} // namespace frustumscreen::pack

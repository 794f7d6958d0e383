#include "app/scene/other_prop.h"

#include "app/scene/scene_plan.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::scene {

namespace {

/// A prop file has six decimals of a millimetre.
constexpr double same_direction = 1e-6;

bool has_all_sides(const pack::PackDescription& pack) {
    return pack.prop_kind == settings::name_of(settings::PropKind::Cube);
}

bool looks_straight_up(const geometry::PropFace& face) {
    return glm::distance(face.plane.normal, glm::dvec3(0.0, 0.0, 1.0)) < same_direction;
}

/// The error of the best quality level.
const pack::LevelError& shown_error(const pack::PackOutline& pack, const ScenePlan& plan) {
    const QualityLevel& best = plan.quality_levels.front();
    if (best.relief) {
        const auto relief =
            std::find_if(plan.reliefs.begin(), plan.reliefs.end(),
                         [&](const pack::ReliefOutline& each) { return each.texels == best.level; });
        if (relief != plan.reliefs.end()) {
            return relief->error;
        }
    }
    return pack.levels.at(best.relief ? plan.exposure_level : best.level).error;
}

} // namespace

Result<void> check_sides(const settings::PropSettings& prop, const geometry::PropShape& shape,
                         const pack::PackDescription& pack) {
    if (has_all_sides(pack) || prop.zone != settings::PropZone::Hand) {
        return {};
    }
    const auto face = std::find_if_not(shape.faces.begin(), shape.faces.end(), looks_straight_up);
    if (face == shape.faces.end()) {
        return {};
    }
    return bad_input(
        "scene.pack_lacks_sides",
        "the pack was baked for a {}, without the sides that are seen from below; the prop's face "
        "{} would show them in the hand; bake it with --prop {}",
        pack.prop_kind, face->name, settings::baked_kind(prop));
}

std::optional<std::string> note_other_prop(const std::string& file, const settings::PropSettings& prop,
                                           const pack::PackOutline& pack, const ScenePlan& plan) {
    const std::string_view wanted = settings::baked_kind(prop);
    const std::string& kind = pack.description.prop_kind;
    if (wanted.empty() || kind == wanted || has_all_sides(pack.description)) {
        return std::nullopt;
    }
    const double mean_mm = 1e3 * plan.metres_per_box * shown_error(pack, plan).mean_box;
    return fmt::format(
        "{}: it was baked for a {}, and the prop of the settings is a {}; it is shown with a mean "
        "error of {:.2f} mm; bake it with --prop {}",
        file, kind, settings::name_of(prop.kind), mean_mm, wanted);
}

} // namespace frustumscreen::scene

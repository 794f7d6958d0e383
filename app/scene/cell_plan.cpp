#include "app/scene/cell_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace frustumscreen::scene {

double metres_per_box_of(const world::CellPose& at_rest, double artifact_metres_per_box) {
    double longest = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        longest = std::fmax(longest, glm::length(glm::dvec3(at_rest.box_from_geometry[axis])));
    }
    return artifact_metres_per_box * longest;
}

void set_pose(PlacedLevel& level, const world::CellPose& pose, double artifact_metres_per_box) {
    level.prop_from_placed = pose.box_from_geometry;
    for (int axis = 0; axis < 3; ++axis) {
        level.prop_from_placed[axis] *= artifact_metres_per_box / level.metres_per_box;
    }
    level.prop_from_placed[3] =
        glm::dvec4(artifact_metres_per_box * glm::dvec3(level.prop_from_placed[3]), 1.0);
    level.light = pose.light;
}

std::string cell_technique(std::string_view technique, const pack::PackOutline& cell) {
    constexpr std::string_view level = "level";
    constexpr std::string_view relief = "relief";
    const auto number_in = [](std::string_view digits) {
        std::uint32_t number = 0;
        std::from_chars(digits.data(), digits.data() + digits.size(), number);
        return number;
    };
    if (technique.starts_with(level)) {
        const auto finest = static_cast<std::uint32_t>(cell.levels.size() - 1);
        return fmt::format("{}{}", level, std::min(number_in(technique.substr(level.size())), finest));
    }
    if (!technique.starts_with(relief)) {
        return std::string(technique);
    }
    const Result<std::vector<pack::ReliefOutline>> reliefs = pack::reliefs_of(cell.description);
    if (!reliefs || reliefs->empty()) {
        return "auto"; // plan_scene says what is wrong with the section
    }
    const std::uint32_t wanted = number_in(technique.substr(relief.size()));
    const bool has = wanted == 0 || std::any_of(reliefs->begin(), reliefs->end(),
                                                [&](const auto& each) { return each.texels == wanted; });
    return has ? std::string(technique)
               : fmt::format("{}{}{}", relief, reliefs->back().texels,
                             technique.ends_with(on_gpu_suffix) ? on_gpu_suffix : "");
}

Result<ScenePlan> plan_cell(const settings::Settings& settings, const pack::PackOutline& cell,
                            const ScenePlan& whole, const world::CellPose& at_rest, SceneRequest request) {
    request.technique = cell_technique(request.technique, cell);
    request.metres_per_box = metres_per_box_of(at_rest, whole.metres_per_box);
    request.cull_kinds &= ~static_cast<unsigned>(UnseenTriangles | UnusedDetail);
    request.captions.clear();
    TRY(ScenePlan plan, plan_scene(settings, cell, request));
    plan.light = whole.light;
    return plan;
}

double pixels_of(const PlacedLevel& level, const PlanView& view) {
    const glm::dmat4 prop_from_box = level.prop_from_box();
    const glm::dvec3 x = level.box_size.x * glm::dvec3(prop_from_box[0]);
    const glm::dvec3 y = level.box_size.y * glm::dvec3(prop_from_box[1]);
    const glm::dvec3 z = level.box_size.z * glm::dvec3(prop_from_box[2]);
    const double silhouette_m2 =
        0.5 * (glm::length(glm::cross(x, y)) + glm::length(glm::cross(y, z)) + glm::length(glm::cross(z, x)));
    const glm::dvec3 middle(prop_from_box * glm::dvec4(0.0, 0.0, 0.5 * level.box_size.z, 1.0));
    const double away_m =
        glm::distance(view.table_from_prop.point(middle), view.table_from_projector.translation);
    const double pixels_per_m = away_m > 0.0 ? view.projector.fx / away_m : 0.0;
    return silhouette_m2 * pixels_per_m * pixels_per_m;
}

} // namespace frustumscreen::scene

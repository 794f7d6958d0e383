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

namespace {

/// The techniques for each of a cell's levels, the finest first, and for each of its reliefs.
Result<std::vector<std::string>> every_technique(const pack::PackOutline& cell) {
    std::vector<std::string> names;
    for (std::size_t level = cell.levels.size(); level-- > 0;) {
        names.push_back(fmt::format("level{}", level));
    }
    TRY(const std::vector<pack::ReliefOutline> reliefs, pack::reliefs_of(cell.description));
    for (const pack::ReliefOutline& relief : reliefs) {
        names.push_back(fmt::format("relief{}", relief.texels));
    }
    return names;
}

/// Adds what `way` draws, if the plan does not draw it yet.
void add_way(const ScenePlan& way, ScenePlan& plan) {
    const QualityLevel& added = way.quality_levels.front();
    if (std::any_of(plan.quality_levels.begin(), plan.quality_levels.end(),
                    [&](const QualityLevel& known) { return known.shows_as(added); })) {
        return;
    }
    plan.quality_levels.push_back(added);
    plan.needs = united(plan.needs, way.needs);
    if (!added.relief) {
        plan.levels.push_back(added.level);
    } else if (std::find(plan.reliefs.begin(), plan.reliefs.end(), way.reliefs.front()) ==
               plan.reliefs.end()) {
        plan.reliefs.push_back(way.reliefs.front());
        plan.seen_reliefs.push_back(way.seen_reliefs.front());
    }
}

/// The governor's ladder ends at what is good enough. Which level of a cell is worth its time depends on the other cells,
/// so a cell has all of them.
Result<void> add_every_way(const settings::Settings& settings, const pack::PackOutline& cell,
                           SceneRequest request, ScenePlan& plan) {
    TRY(const std::vector<std::string> names, every_technique(cell));
    request.live = false;
    for (const std::string& name : names) {
        request.technique = name;
        TRY(const ScenePlan way, plan_scene(settings, cell, request));
        add_way(way, plan);
    }
    std::erase_if(plan.left_out, [](const LeftOut& each) { return each.cull_kind == UnusedLevels; });
    return {};
}

} // namespace

Result<ScenePlan> plan_cell(const settings::Settings& settings, const pack::PackOutline& cell,
                            const ScenePlan& whole, const world::CellPose& at_rest, SceneRequest request) {
    request.technique = cell_technique(request.technique, cell);
    request.metres_per_box = metres_per_box_of(at_rest, whole.metres_per_box);
    request.cull_kinds &= ~static_cast<unsigned>(UnseenTriangles | UnusedDetail);
    request.captions.clear();
    TRY(ScenePlan plan, plan_scene(settings, cell, request));
    if (request.live && request.technique == "auto") {
        TRY_VOID(add_every_way(settings, cell, request, plan));
    }
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

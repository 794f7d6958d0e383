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

double pixels_around(const FramePlan& plan, MeshId mesh) {
    double pixels = 0.0;
    for (const Draw& draw : plan.draws) {
        if (draw.face != Draw::on_table && draw.drawable.mesh == mesh) {
            pixels += static_cast<double>(draw.bounds.width) * static_cast<double>(draw.bounds.height);
        }
    }
    return pixels;
}

} // namespace frustumscreen::scene

// Plans of torches in extreme poses: their 32-bit matrices are compared with exact places, and their bounds with the pixels that the beam
// meets.

#include "app/bench/stability/exact.h"
#include "app/bench/stability/picture.h"
#include "app/bench/stability/themes.h"
#include "app/scene/torch_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::bench {

namespace {

using exact::Real;
using exact::Vector;

constexpr double radians_of_deg = std::numbers::pi / 180.0;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

geometry::RigidTransform looking(const glm::dvec3& from, const glm::dvec3& towards) {
    const glm::dvec3 z = glm::normalize(towards);
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0.3, 0.9, 0.1), z));
    return {glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z)), from};
}

scene::PlacedTorch torch_at(const geometry::RigidTransform& pose, double opening_deg) {
    torch::Beam beam;
    beam.opening_rad = opening_deg * radians_of_deg;
    beam.shape = torch::Shape::Rectangle;
    return scene::placed(torch::white(), beam, pose, 0.0);
}

struct TorchFigures {
    double error_mm = 0.0; ///< largest, of a place in the torch's frame, by the 32-bit matrix
    double lacking = 0.0;  ///< lit corners outside of the torch's draws
    double in_beam = 0.0;  ///< corners in the beam
    double torches = 0.0;
    double not_finite = 0.0;
};

void count_not_finite(const scene::FramePlan& plan, TorchFigures& figures) {
    const auto add = [&](double number) { figures.not_finite += std::isfinite(number) ? 0.0 : 1.0; };
    for (std::size_t k = 0; k < plan.torches.size(); ++k) {
        const scene::TorchLight& light = plan.torches[k];
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                add(light.torch_from_prop[column][row]);
                add(double{light.torch_from_projector[column][row]});
            }
        }
        add(double{light.per_half_extent.x + light.per_half_extent.y + light.reach_m});
        add(double{light.inverse_z_of_depth.x + light.inverse_z_of_depth.y});
        for (const scene::Draw& draw : plan.torch_views[k].draws) {
            for (int column = 0; column < 4; ++column) {
                const glm::vec4 c = draw.clip_from_unit[column];
                add(double{c.x + c.y + c.z + c.w});
            }
        }
    }
}

/// Whether the torch's part of `draw` holds the pixel.
bool is_lit_at(const scene::FramePlan& plan, std::size_t draw, const exact::Seen& seen) {
    return std::any_of(plan.torch_draws.begin(), plan.torch_draws.end(), [&](const scene::TorchDraw& lit) {
        return lit.draw == draw && seen.u >= lit.bounds.x && seen.v >= lit.bounds.y &&
               seen.u <= lit.bounds.x + lit.bounds.width && seen.v <= lit.bounds.y + lit.bounds.height;
    });
}

/// False: the torch is behind the triangle's plane or on it, so the triangle lies in its own shadow.
bool faces_torch(const SeenArtifact& artifact, std::span<const std::uint32_t> triangle,
                 const Vector& torch_prop) {
    const Vector a = artifact.corner(triangle[0]);
    const Vector normal = exact::cross(artifact.corner(triangle[1]) - a, artifact.corner(triangle[2]) - a);
    return exact::dot(normal, torch_prop - a) > 0;
}

TorchFigures figures_of(const scene::PlacedTorch& torch) {
    const exact::SetUp set_up = usual_set_up();
    const SeenArtifact artifact = seen_artifact(set_up, 1000);
    scene::FramePlan plan = scene::make_plan(set_up.prop, artifact.placed);
    scene::make_torch_space(plan, set_up.prop.faces.size(), artifact.level.indices.size(), 1);
    scene::plan_frame(set_up.prop, artifact.placed,
                      {.projector = set_up.projector,
                       .table_from_projector = set_up.table_from_projector,
                       .table_from_prop = set_up.table_from_prop,
                       .eyes_m = {&set_up.eye_m, 1},
                       .torches = {&torch, 1}},
                      plan);
    TorchFigures figures;
    figures.torches = static_cast<double>(plan.torches.size());
    count_not_finite(plan, figures);
    const exact::Rigid table_from_torch(torch.table_from_torch);
    const Vector torch_prop =
        exact::Rigid(set_up.table_from_prop).inverse_point(table_from_torch.point({0, 0, 0}));
    const Real half = std::tan(Real(0.5) * Real(torch.beam.opening_rad));
    for (std::size_t number = 0; number < plan.draws.size() && !plan.torches.empty(); ++number) {
        const scene::Draw& draw = plan.draws[number];
        const glm::mat4 torch_from_unit(plan.torches.front().torch_from_prop *
                                        glm::dmat4(draw.prop_from_unit));
        const auto face = static_cast<std::size_t>(plan.faces[static_cast<std::size_t>(draw.face)].face);
        for (std::size_t k = draw.range.first; k < std::size_t{draw.range.first} + draw.range.count; ++k) {
            const std::uint32_t index = plan.indices[k];
            const Vector corner = artifact.corner(index);
            const Vector at =
                table_from_torch.inverse_point(exact::Rigid(set_up.table_from_prop).point(corner));
            const pack::PackVertex& stored = artifact.level.vertices[index];
            const glm::vec4 unit(static_cast<float>(stored.position[0]) / 65535.0F,
                                 static_cast<float>(stored.position[1]) / 65535.0F,
                                 static_cast<float>(stored.position[2]) / 65535.0F, 1.0F);
            const glm::dvec3 got(torch_from_unit * unit);
            figures.error_mm =
                std::fmax(figures.error_mm, 1e3 * static_cast<double>(exact::length(exact::of(got) - at)));
            const std::optional<exact::Seen> seen = set_up.see(set_up.prop.faces[face], corner);
            const bool in_beam = at.z > 0 && std::fmax(std::fabs(at.x), std::fabs(at.y)) < at.z * half &&
                                 exact::length(at) < Real(torch::reach_m(torch.beam));
            if (in_beam && seen && seen->on_face && seen->in_picture) {
                const std::size_t first = k - (k - draw.range.first) % 3;
                const bool lit = faces_torch(artifact, std::span(plan.indices).subspan(first, 3), torch_prop);
                figures.in_beam += 1.0;
                figures.lacking += lit && !is_lit_at(plan, number, *seen) ? 1.0 : 0.0;
            }
        }
    }
    return figures;
}

/// A corner's place: coordinates of the torch and of the artifact, added in 32 bits: four roundings of the larger.
double bound_mm(double torch_away_m) {
    return 1e3 * 4.0 * 0x1p-24 * std::fmax(torch_away_m, 0.25);
}

StabilityResult odd_places(const StabilityOptions&) {
    const exact::SetUp set_up = usual_set_up();
    const SeenArtifact artifact = seen_artifact(set_up, 1000);
    const Vector corner = artifact.corner(artifact.level.indices.front());
    const glm::dvec3 surface(double(corner.x), double(corner.y), double(corner.z));
    const glm::dvec3 middle(0.0, 0.0, 0.05);
    const glm::dvec3 beside(0.1, -0.3, 0.2);
    struct Place {
        std::string name;
        scene::PlacedTorch torch;
        double min_in_beam; ///< corners
    };
    const std::vector<Place> places{
        {"at 0 mm from the surface", torch_at(looking(surface, middle - surface), 30.0), 1.0},
        {"in the artifact", torch_at(looking(middle, {0.0, 0.3, 1.0}), 30.0), 1.0},
        {"in it, 179 deg", torch_at(looking(middle, {0.0, 0.3, 1.0}), 179.0), 100.0},
        {"beside it, 179 deg", torch_at(looking(beside, middle - beside), 179.0), 100.0},
        {"beside it, 0.01 deg", torch_at(looking(beside, surface - beside), 0.01), 1.0},
        {"behind it", torch_at(looking({0.0, 0.4, 0.1}, {0.0, -1.0, -0.1}), 30.0), 100.0},
        {"at the eye", torch_at(looking(set_up.eye_m, middle - set_up.eye_m), 30.0), 100.0},
        {"at the projector",
         torch_at(looking(set_up.table_from_projector.translation, {0.0, 0.0, -1.0}), 30.0), 100.0},
        {"2.9 m away", torch_at(looking({0.0, -2.5, 1.5}, {0.0, 2.5, -1.45}), 5.0), 100.0}};
    StabilityResult result;
    for (const Place& place : places) {
        const TorchFigures figures = figures_of(place.torch);
        result.rows.push_back({place.name + ": a place off, mm",
                               bound_mm(glm::length(place.torch.table_from_torch.translation)),
                               figures.error_mm});
        result.rows.push_back({place.name + ": lit corners that it lacks", 0.0, figures.lacking});
        result.rows.push_back({place.name + ": numbers that are not finite", 0.0, figures.not_finite});
        result.rows.push_back({place.name + ": corners in the beam, short of what is meant", 0.0,
                               std::fmax(0.0, place.min_in_beam - figures.in_beam)});
    }
    return result;
}

StabilityResult none_of_it(const StabilityOptions&) {
    const glm::dvec3 beside(0.1, -0.3, 0.2);
    const glm::dvec3 away(0.1, -0.3, 0.1);
    const geometry::RigidTransform good = looking(beside, -beside);
    StabilityResult result;
    double planned = 0.0;
    double not_finite = 0.0;
    for (const scene::PlacedTorch& torch :
         {torch_at(looking(beside, away), 30.0),
          torch_at(looking({0.0, 0.0, 1000.0}, {0.0, 0.0, -1.0}), 30.0),
          torch_at({glm::dquat(0.0, 0.0, 0.0, 0.0), beside}, 30.0),
          torch_at({glm::dquat(nan, 0.0, 0.0, 1.0), beside}, 30.0),
          torch_at({good.rotation, glm::dvec3(nan, 0.0, 0.0)}, 30.0),
          torch_at({good.rotation, glm::dvec3(0.0, 1e300, 0.0)}, 30.0),
          torch_at({good.rotation, glm::dvec3(0.0, 0.0, std::numeric_limits<double>::infinity())}, 30.0)}) {
        const TorchFigures figures = figures_of(torch);
        planned += figures.torches;
        not_finite += figures.not_finite;
    }
    return {{{"torches planned", 0.0, planned}, {"numbers that are not finite", 0.0, not_finite}}};
}

} // namespace

std::vector<StabilityCase> torch_plan_cases() {
    const std::string theme = "torch";
    return {{theme, "on the artifact, in it and around it", FloatingPoint::Strict, odd_places},
            {theme, "turned away, far away, of no pose: the plan", FloatingPoint::Free, none_of_it}};
}

} // namespace frustumscreen::bench

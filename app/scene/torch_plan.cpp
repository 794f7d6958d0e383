#include "app/scene/torch_plan.h"

#include "app/scene/beyond_prop.h"
#include "app/scene/torch_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

namespace frustumscreen::scene {

namespace {

/// Appends the triangles of `range` that may meet the beam: not all corners are outside of one of its planes
/// (Cohen-Sutherland; Francken 2007, 2).
IndexRange lit_triangles(const LevelTriangles& level, const IndexRange& range, const BeamPlanes& planes,
                         std::vector<std::uint32_t>& indices) {
    std::array<glm::vec4, BeamPlanes::max_count> near{};
    const std::size_t count = planes.planes().size();
    std::transform(planes.planes().begin(), planes.planes().end(), near.begin(), [](const glm::dvec4& plane) {
        return glm::vec4(plane + glm::dvec4(0.0, 0.0, 0.0, 1e-6 * glm::length(glm::dvec3(plane))));
    });
    const auto outcode = [&](std::uint32_t index) {
        const glm::vec3& at = level.positions[index];
        unsigned code = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const glm::vec4& plane = near[k];
            code |= static_cast<unsigned>(plane.x * at.x + plane.y * at.y + plane.z * at.z + plane.w < 0.0F)
                    << k;
        }
        return code;
    };
    const auto first = static_cast<std::uint32_t>(indices.size());
    for (std::size_t k = range.first; k < std::size_t{range.first} + range.count; k += 3) {
        const std::array<std::uint32_t, 3> triangle{indices[k], indices[k + 1], indices[k + 2]};
        if ((outcode(triangle[0]) & outcode(triangle[1]) & outcode(triangle[2])) == 0) {
            indices.insert(indices.end(), triangle.begin(), triangle.end());
        }
    }
    return {first, static_cast<std::uint32_t>(indices.size()) - first};
}

/// Sets the map from a pixel's depth to the place. Clip coordinates are linear in the place, and places on one ray differ only in
/// depth. The inverse map's last row has no x and no y, unless the world is cut off at the face (collineation_behind).
void find_places(const glm::dmat4& torch_from_placed, const Draw& draw, bool is_cut_off,
                 const geometry::Pinhole& pinhole, TorchFace& face) {
    const glm::dmat4 torch_from_clip = torch_from_placed * glm::inverse(draw.clip_from_placed);
    const double per_depth = torch_from_clip[2].w;
    const glm::dvec3 eye = glm::dvec3(torch_from_clip[2]) / per_depth; // infinitely deep
    const glm::dvec2 ends = is_cut_off ? -glm::dvec2(torch_from_clip[0].w, torch_from_clip[1].w) / per_depth
                                       : glm::dvec2(0.0); // of x and y
    const double end = -torch_from_clip[3].w / per_depth;
    const glm::dvec2 half = 0.5 * glm::dvec2(pinhole.width, pinhole.height);
    const glm::dvec2 focal(pinhole.fx, pinhole.fy);
    const glm::dvec2 scale = focal / half; // from a ray to normalised device coordinates
    const glm::dvec2 offset = glm::dvec2(pinhole.cx, pinhole.cy) / half - 1.0;
    const glm::dvec3 x = glm::dvec3(torch_from_clip[0]) / per_depth + ends.x * eye;
    const glm::dvec3 y = glm::dvec3(torch_from_clip[1]) / per_depth + ends.y * eye;
    const glm::dvec3 rest = glm::dvec3(torch_from_clip[3]) / per_depth + end * eye;
    face.from_ray = glm::mat3(glm::dmat3(scale.x * x, scale.y * y, offset.x * x + offset.y * y + rest));
    face.eye = glm::vec3(eye);
    face.end_of_depth = glm::vec3(glm::dvec3(scale * ends, glm::dot(offset, ends) + end));
}

/// The eye that looks through a face, prop frame.
glm::dvec3 eye_of(const PlanView& view, const FacePlan& face) {
    const auto own =
        view.eyes_m.size() == 1 ? 0 : std::min(static_cast<std::size_t>(face.face), view.eyes_m.size() - 1);
    return view.table_from_prop.inverse().point(view.eyes_m[own]);
}

/// The torch's entry for a face, which is the last torch.
TorchFace& face_of(FramePlan& plan, std::size_t torch, int face) {
    const auto found =
        std::find_if(plan.torch_faces.begin(), plan.torch_faces.end(),
                     [&](const TorchFace& each) { return each.torch == torch && each.face == face; });
    if (found != plan.torch_faces.end()) {
        return *found;
    }
    TorchFace& added = plan.torch_faces.emplace_back();
    added.torch = torch;
    added.face = face;
    added.lit.begin(plan.projector.width, plan.projector.height);
    return added;
}

constexpr std::array<glm::dvec2, 4> square{glm::dvec2(-1, 1), glm::dvec2(1, 1), glm::dvec2(1, -1),
                                           glm::dvec2(-1, -1)};

geometry::PropShape square_shape() {
    geometry::PropShape shape;
    geometry::PropFace& face = shape.faces.emplace_back();
    for (const glm::dvec2& corner : square) {
        face.corners.push_back({corner, 0.0});
    }
    shape.bounds.resize(1);
    shape.corners.resize(square.size());
    return shape;
}

/// Puts a square close before the torch, so that all of its light meets it, prop frame. `surface`: of square_shape.
void place_before(const geometry::RigidTransform& prop_from_torch, const torch::Beam& beam, double distance,
                  geometry::PropShape& surface) {
    geometry::PropFace& face = surface.faces.front();
    const glm::dvec3 normal = prop_from_torch.direction({0.0, 0.0, -1.0});
    surface.middle = prop_from_torch.point({0.0, 0.0, distance});
    face.plane = {normal, glm::dot(normal, surface.middle)};
    surface.bounds.front() = face.plane;
    const glm::dvec2 half = 1.01 * distance * torch::half_extent(beam);
    for (std::size_t k = 0; k < square.size(); ++k) {
        face.corners[k] = surface.corners[k] = prop_from_torch.point({square[k] * half, distance});
    }
}

geometry::Pinhole pinhole_of(const torch::Beam& beam) {
    const glm::dvec2 extent = torch::half_extent(beam);
    constexpr double half = 0.5 * torch_picture_px;
    return {.width = torch_picture_px,
            .height = torch_picture_px,
            .fx = half / extent.x,
            .fy = half / extent.y,
            .cx = half,
            .cy = half};
}

/// In a fade, the level that shows more casts the shadow.
bool casts(const Part& part) {
    return !part.dither || (part.dither->complement ? 1.0F - part.dither->share : part.dither->share) >= 0.5F;
}

/// Plans what the torch sees; returns its nearness of z: 1 / z = x depth + y, for depth 0..1 and for a relief's nearness.
std::pair<glm::vec2, glm::vec2> plan_torch_view(std::span<const Part> parts, const PlanView& view,
                                                const PlacedTorch& torch, const geometry::Box& box,
                                                FramePlan& plan) {
    const geometry::RigidTransform prop_from_torch = view.table_from_prop.inverse() * torch.table_from_torch;
    const glm::dvec3 middle = 0.5 * (box.low + box.high);
    const double distance =
        0.01 * (glm::distance(prop_from_torch.translation, middle) + glm::distance(box.low, box.high));
    const glm::dvec3 eye_m = torch.table_from_torch.translation;
    PlanView seen{.projector = pinhole_of(torch.beam),
                  .table_from_projector = torch.table_from_torch,
                  .table_from_prop = view.table_from_prop,
                  .eyes_m = std::span(&eye_m, 1)};
    seen.picture.channels =
        glm::bvec3(std::any_of(torch.stages.begin(), torch.stages.end(), [](const torch::Stage& stage) {
            return stage.source == torch::Source::Lens;
        }));
    plan.casters.clear();
    for (const Part& part : parts) {
        if (casts(part)) {
            plan.casters.push_back({part.level, std::nullopt});
            plan.casters.back().level.light = glm::vec3(1.0F); // the lit surface has its light
            plan.casters.back().level.beyond = false;          // the torch's picture has no face to cut at
        }
    }
    place_before(prop_from_torch, torch.beam, distance, plan.surface);
    plan_frame(plan.surface, plan.casters, seen, plan);
    plan.samples = 1;
    for (ReliefDraw& relief_draw : plan.relief_draws) {
        relief_draw.samples = 1;
    }
    const double from_nearness = 1.0 / distance;
    if (plan.faces.empty()) {
        return {glm::vec2(0.0F), glm::vec2(from_nearness, 0.0)};
    }
    // depth = (x nearness + w + 1) / 2 along the torch's axis.
    const glm::dvec4 depth(plan.faces[0].depth_from_nearness);
    const double per_depth = 2.0 * from_nearness / depth.z;
    return {glm::vec2(per_depth, -0.5 * (depth.w + 1.0) * per_depth), glm::vec2(from_nearness, 0.0)};
}

/// True if a part's box is not wholly in the half space, torch's frame.
bool reach_out_of(const glm::dvec4& half_space, std::span<const Part> parts,
                  const geometry::RigidTransform& torch_from_prop) {
    return std::any_of(parts.begin(), parts.end(), [&](const Part& part) {
        const geometry::Box box = part.level.placed_box();
        const glm::dvec4 placed = half_space * torch_from_prop.matrix() * part.level.prop_from_placed;
        // The box's corner that is farthest out.
        const glm::dvec3 out =
            glm::mix(box.high, box.low, glm::greaterThan(glm::dvec3(placed), glm::dvec3(0.0)));
        return glm::dot(placed, glm::dvec4(out, 1.0)) < 0.0;
    });
}

/// The half space behind the face that is farthest from the torch, torch's frame; zero: it is behind all faces, or nothing reaches out
/// of it.
glm::dvec4 casting_before(const geometry::PropShape& prop, std::span<const Part> parts,
                          const geometry::RigidTransform& torch_from_prop) {
    const geometry::RigidTransform prop_from_torch = torch_from_prop.inverse();
    glm::dvec4 casting(0.0);
    double farthest = 0.0;
    for (const geometry::PropFace& face : prop.faces) {
        const double away = face.plane.distance(prop_from_torch.translation);
        if (away > farthest) {
            farthest = away;
            casting = half_space_behind(face, prop_from_torch.matrix());
        }
    }
    return reach_out_of(casting, parts, torch_from_prop) ? casting : glm::dvec4(0.0);
}

/// The torch's frame as the shader takes it.
TorchLight light_of(const PlacedTorch& torch, const PlanView& view) {
    const geometry::RigidTransform torch_from_table = torch.table_from_torch.inverse();
    TorchLight light;
    light.torch_from_prop = (torch_from_table * view.table_from_prop).matrix();
    light.torch_from_projector = glm::mat4((torch_from_table * view.table_from_projector).matrix());
    light.eye = glm::vec3(torch_from_table.point(view.eyes_m.front()));
    light.per_half_extent = glm::vec2(1.0 / torch::half_extent(torch.beam));
    light.reach_m = static_cast<float>(std::min(torch::reach_m(torch.beam), 1e6));
    light.torch = torch;
    return light;
}

} // namespace

void make_torch_space(FramePlan& plan, std::size_t faces, std::size_t indices, std::size_t parts) {
    plan.torches.reserve(torch::max_torches);
    plan.torch_draws.reserve(torch::max_torches * parts * faces);
    plan.torch_faces.reserve(torch::max_torches * faces);
    plan.indices.reserve((1 + torch::max_torches) * faces * indices);
    plan.torch_views.clear();
    const geometry::PropShape surface = square_shape();
    for (std::size_t k = 0; k < torch::max_torches; ++k) {
        FramePlan& view = plan.torch_views.emplace_back(make_plan(surface, indices, parts));
        view.surface = surface;
        view.front.keep_backs(FrontTriangles::Backs::FromWithin);
        view.casters.reserve(parts);
    }
}

bool is_found_on_processor(const FramePlan& view) {
    return std::none_of(view.draws.begin(), view.draws.end(), [](const Draw& draw) {
        return draw.shader.pass == ShaderKey::Pass::Surface && (draw.shader.cut_out || draw.shader.blocks);
    });
}

void plan_torches(const geometry::PropShape& prop, std::span<const Part> parts, const PlanView& view,
                  const geometry::Box& box, FramePlan& plan) {
    plan.torches.clear();
    plan.torch_draws.clear();
    plan.torch_faces.clear();
    if (plan.faces.empty()) {
        return;
    }
    const bool is_beyond =
        std::any_of(parts.begin(), parts.end(), [](const Part& part) { return part.level.beyond; });
    const double radius = 0.5 * glm::distance(box.low, box.high);
    for (const PlacedTorch& torch : view.torches) {
        if (!(torch.brightness > 0.0F) || torch.stage_count == 0 ||
            plan.torches.size() == plan.torch_views.size() ||
            (is_beyond && (parts_of(torch) & torch::LayerPart) != 0)) {
            continue;
        }
        const geometry::RigidTransform torch_from_prop =
            torch.table_from_torch.inverse() * view.table_from_prop;
        const BeamPlanes planes(torch.beam, torch_from_prop.matrix());
        if (!planes.may_light(0.5 * (box.low + box.high), radius)) {
            continue;
        }
        const std::size_t number = plan.torches.size();
        const std::size_t draws = plan.draws.size();
        for (std::size_t k = 0; k < draws; ++k) {
            const Draw& draw = plan.draws[k];
            if (draw.face == Draw::on_table) {
                continue;
            }
            const PlacedLevel& level = parts[draw.part].level;
            TorchFace& face = face_of(plan, number, draw.face);
            TorchDraw lit{.draw = k, .torch = number, .bounds = {}, .range = {}};
            lit.bounds =
                light_tiles({.level = level,
                             .draw = draw,
                             .beam = torch.beam,
                             .torch_from_prop = torch_from_prop.matrix(),
                             .eye_in_prop = eye_of(view, plan.faces[static_cast<std::size_t>(draw.face)]),
                             .pinhole = plan.projector},
                            face.lit);
            if (lit.bounds.empty()) {
                continue;
            }
            face.draw = k;
            find_places(torch_from_prop.matrix() * level.prop_from_placed, draw, is_beyond, plan.projector,
                        face);
            if (level.triangles && (parts_of(torch) & torch::LayerPart) != 0) {
                lit.range = lit_triangles(
                    *level.triangles, draw.range,
                    BeamPlanes(torch.beam, torch_from_prop.matrix() * level.prop_from_box()), plan.indices);
            }
            plan.torch_draws.push_back(lit);
        }
        for (TorchFace& face : plan.torch_faces) {
            if (face.torch == number) {
                face.lit.finish();
            }
        }
        TorchLight light = light_of(torch, view);
        light.casting = is_beyond ? casting_before(prop, parts, torch_from_prop) : glm::dvec4(0.0);
        if (torch.casts_shadows) {
            plan.torch_views[number].front.keep_backs(light.casting != glm::dvec4(0.0)
                                                          ? FrontTriangles::Backs::Always
                                                          : FrontTriangles::Backs::FromWithin);
            std::tie(light.inverse_z_of_depth, light.inverse_z_of_nearness) =
                plan_torch_view(parts, view, torch, box, plan.torch_views[number]);
        }
        plan.torches.push_back(light);
    }
}

} // namespace frustumscreen::scene

#include "app/scene/torch_plan.h"

#include "app/scene/face_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

namespace frustumscreen::scene {

namespace {

/// The half spaces a.X + d >= 0 of a beam, in a frame given by torch_from_frame: before the torch, the four sides of its
/// rectangle and the plane across the axis at its reach. `a` is a unit vector in the torch's frame.
using BeamPlanes = std::array<glm::dvec4, 6>;

BeamPlanes planes_of(const torch::Beam& beam, const glm::dmat4& torch_from_frame) {
    const glm::dvec2 extent = torch::half_extent(beam);
    const double reach = std::min(torch::reach_m(beam), 1e6);
    const auto side = [](double x, double y, double z) {
        return glm::dvec4(x, y, z, 0.0) / std::sqrt(x * x + y * y + z * z);
    };
    BeamPlanes planes{glm::dvec4(0.0, 0.0, 1.0, 0.0), side(1.0, 0.0, extent.x),
                      side(-1.0, 0.0, extent.x),      side(0.0, 1.0, extent.y),
                      side(0.0, -1.0, extent.y),      glm::dvec4(0.0, 0.0, -1.0, reach)};
    const glm::dmat4 transposed = glm::transpose(torch_from_frame);
    for (glm::dvec4& plane : planes) {
        plane = transposed * plane;
    }
    return planes;
}

/// False only if no point of the sphere is lit; `torch_from_frame` is rigid.
bool may_light(const BeamPlanes& planes, const glm::dvec3& centre, double radius) {
    return std::all_of(planes.begin(), planes.end(), [&](const glm::dvec4& plane) {
        return glm::dot(plane, glm::dvec4(centre, 1.0)) >= -radius;
    });
}

/// Appends the triangles of `range` that may meet the beam: not all corners are outside of one of its planes
/// (Cohen-Sutherland; Francken 2007, 2).
IndexRange lit_triangles(const LevelTriangles& level, const IndexRange& range, const BeamPlanes& planes,
                         std::vector<std::uint32_t>& indices) {
    std::array<glm::vec4, std::tuple_size_v<BeamPlanes>> near{};
    std::transform(planes.begin(), planes.end(), near.begin(), [](const glm::dvec4& plane) {
        return glm::vec4(plane + glm::dvec4(0.0, 0.0, 0.0, 1e-6 * glm::length(glm::dvec3(plane))));
    });
    const auto outcode = [&](std::uint32_t index) {
        const glm::vec3& at = level.positions[index];
        unsigned code = 0;
        for (std::size_t k = 0; k < near.size(); ++k) {
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

/// The number of parts along an edge of a level's box; each is about a centimetre long.
glm::ivec3 parts_of_box(const glm::dvec3& size_m) {
    constexpr double part_m = 0.01;
    constexpr double max_parts = 12.0;
    return glm::ivec3(glm::clamp(glm::ceil(size_m / part_m), glm::dvec3(1.0), glm::dvec3(max_parts)));
}

/// Finds the pixels of a level that a beam may light, within `draw`: those around the small parts of the level's box that meet the
/// beam. Adds them to `tiles`, and returns the rectangle around them.
PixelRectangle light_pixels(const PlacedLevel& level, const Draw& draw, const BeamPlanes& planes,
                            const geometry::Pinhole& pinhole, LitTiles& tiles) {
    const geometry::Box box = level.placed_box();
    double scale = 0.0; // of the pose
    for (int axis = 0; axis < 3; ++axis) {
        scale = std::max(scale, glm::length(glm::dvec3(level.prop_from_placed[axis])));
    }
    const glm::ivec3 parts = parts_of_box(scale * (box.high - box.low));
    const glm::dvec3 size = (box.high - box.low) / glm::dvec3(parts);
    const double radius = 0.5 * scale * glm::length(size);
    PixelRectangle lit;
    for (int k = 0; k < parts.x * parts.y * parts.z; ++k) {
        const glm::ivec3 place(k % parts.x, k / parts.x % parts.y, k / parts.x / parts.y);
        const glm::dvec3 low = box.low + size * glm::dvec3(place);
        const glm::dvec3 middle(level.prop_from_placed * glm::dvec4(low + 0.5 * size, 1.0));
        if (!may_light(planes, middle, radius)) {
            continue;
        }
        std::array<glm::dvec4, 8> corners{};
        for (unsigned corner = 0; corner < corners.size(); ++corner) {
            const glm::dvec3 share(corner & 1U, corner >> 1U & 1U, corner >> 2U & 1U);
            corners[corner] = draw.clip_from_placed * glm::dvec4(low + size * share, 1.0);
        }
        const PixelRectangle part = intersected(draw.bounds, pixels_around(corners, pinhole));
        tiles.light(part);
        lit = united(lit, part);
    }
    return lit;
}

/// Sets the map from a pixel's depth to the place. Clip coordinates are linear in the place, and places on one ray differ only in
/// depth: the inverse map's last row has no x and no y.
void find_places(const glm::dmat4& torch_from_placed, const Draw& draw, const geometry::Pinhole& pinhole,
                 TorchFace& face) {
    const glm::dmat4 torch_from_clip = torch_from_placed * glm::inverse(draw.clip_from_placed);
    const double per_depth = torch_from_clip[2].w;
    const glm::dvec3 eye = glm::dvec3(torch_from_clip[2]) / per_depth; // infinitely deep
    const double end = -torch_from_clip[3].w / per_depth;
    const glm::dvec2 half = 0.5 * glm::dvec2(pinhole.width, pinhole.height);
    const glm::dvec2 focal(pinhole.fx, pinhole.fy);
    const glm::dvec2 scale = focal / half; // from a ray to normalised device coordinates
    const glm::dvec2 offset = glm::dvec2(pinhole.cx, pinhole.cy) / half - 1.0;
    const glm::dvec3 x = glm::dvec3(torch_from_clip[0]) / per_depth;
    const glm::dvec3 y = glm::dvec3(torch_from_clip[1]) / per_depth;
    const glm::dvec3 rest = glm::dvec3(torch_from_clip[3]) / per_depth + end * eye;
    face.from_ray = glm::mat3(glm::dmat3(scale.x * x, scale.y * y, offset.x * x + offset.y * y + rest));
    face.eye = glm::vec3(eye);
    face.end_of_depth = static_cast<float>(end);
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

/// Of a fade the level that shows more casts the shadow.
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
        view.casters.reserve(parts);
    }
}

bool is_found_on_processor(const FramePlan& view) {
    return !glm::any(view.picture.channels) &&
           std::none_of(view.draws.begin(), view.draws.end(), [](const Draw& draw) {
               return draw.shader.pass == ShaderKey::Pass::Surface &&
                      (draw.shader.cut_out || draw.shader.blocks);
           });
}

void plan_torches(std::span<const Part> parts, const PlanView& view, const geometry::Box& box,
                  FramePlan& plan) {
    plan.torches.clear();
    plan.torch_draws.clear();
    plan.torch_faces.clear();
    if (plan.faces.empty()) {
        return;
    }
    const double radius = 0.5 * glm::distance(box.low, box.high);
    for (const PlacedTorch& torch : view.torches) {
        if (!(torch.brightness > 0.0F) || torch.stage_count == 0 ||
            plan.torches.size() == plan.torch_views.size()) {
            continue;
        }
        const geometry::RigidTransform torch_from_prop =
            torch.table_from_torch.inverse() * view.table_from_prop;
        const BeamPlanes planes = planes_of(torch.beam, torch_from_prop.matrix());
        if (!may_light(planes, 0.5 * (box.low + box.high), radius)) {
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
            lit.bounds = light_pixels(level, draw, planes, plan.projector, face.lit);
            if (lit.bounds.empty()) {
                continue;
            }
            face.draw = k;
            find_places(torch_from_prop.matrix() * level.prop_from_placed, draw, plan.projector, face);
            if (level.triangles && (parts_of(torch) & torch::LayerPart) != 0) {
                lit.range = lit_triangles(
                    *level.triangles, draw.range,
                    planes_of(torch.beam, torch_from_prop.matrix() * level.prop_from_box()), plan.indices);
            }
            plan.torch_draws.push_back(lit);
        }
        for (TorchFace& face : plan.torch_faces) {
            if (face.torch == number) {
                face.lit.finish();
            }
        }
        TorchLight light = light_of(torch, view);
        if (torch.casts_shadows) {
            std::tie(light.inverse_z_of_depth, light.inverse_z_of_nearness) =
                plan_torch_view(parts, view, torch, box, plan.torch_views[number]);
        }
        plan.torches.push_back(light);
    }
}

} // namespace frustumscreen::scene

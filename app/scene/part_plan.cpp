#include "app/scene/part_plan.h"

#include "app/geometry/collineation.h"
#include "app/geometry/inner_point.h"
#include "app/scene/beyond_prop.h"
#include "app/scene/face_view.h"

#include <glm/gtc/matrix_inverse.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace frustumscreen::scene {

namespace {

/// Around the level in the prop frame.
geometry::Box box_of(const PlacedLevel& level) {
    const geometry::Box placed = level.placed_box();
    if (level.prop_from_placed == glm::dmat4(1.0)) {
        return placed;
    }
    geometry::Box box{glm::dvec3(std::numeric_limits<double>::infinity()),
                      glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (unsigned k = 0; k < 8; ++k) {
        const glm::dvec3 corner((k & 1U) != 0 ? placed.high.x : placed.low.x,
                                (k & 2U) != 0 ? placed.high.y : placed.low.y,
                                (k & 4U) != 0 ? placed.high.z : placed.low.z);
        const glm::dvec3 at(level.prop_from_placed * glm::dvec4(corner, 1.0));
        box = {glm::min(box.low, at), glm::max(box.high, at)};
    }
    return box;
}

/// nullopt if no eye looks through the face, or no light meets it.
std::optional<FaceView> look_through(std::size_t index, const SharedByParts& shared) {
    const geometry::PropFace& face = shared.prop.faces[index];
    if (!(face.plane.distance(shared.projector_in_prop) >
          geometry::min_sine * glm::distance(shared.projector_in_prop, geometry::inner_point(face)))) {
        return std::nullopt;
    }
    const glm::dvec3 eye = shared.eye(index);
    const std::optional<glm::dmat4> clip =
        shared.beyond ? geometry::collineation_behind(face.plane, eye, shared.clip_from_prop,
                                                      std::span(face.corners.data(), face.corners.size()))
                      : geometry::collineation(face.plane, eye, shared.clip_from_prop, shared.box);
    if (!clip) {
        return std::nullopt;
    }
    const PixelRectangle bounds =
        face_bounds(face, shared.box, shared.clip_from_prop, *clip, shared.view.projector);
    return bounds.empty() ? std::nullopt : std::optional(FaceView{eye, *clip, bounds});
}

/// Adds what a face shows of a level to the plan's indices; returns the pixels around it.
PixelRectangle show_triangles(const LevelTriangles& level, const FaceVolume& volume,
                              const glm::mat4& clip_from_box, const PixelRectangle& face, FramePlan& plan,
                              IndexRange& range) {
    range.first = static_cast<std::uint32_t>(plan.indices.size());
    PixelRectangle bounds;
    for (std::size_t k = 0; k < level.clusters.size(); ++k) {
        const std::size_t first = plan.indices.size();
        if (append_visible(volume, level, plan.front, k, plan.indices) > 0) {
            bounds = united(bounds, light_tiles(level, k, std::span(plan.indices).subspan(first),
                                                clip_from_box, face, plan.projector, plan.lit));
        }
    }
    range.count = static_cast<std::uint32_t>(plan.indices.size()) - range.first;
    return bounds;
}

/// Takes 0..1 over a box to where `frame` takes the box.
glm::dmat4 from_unit(const glm::dmat4& frame, const geometry::Box& box) {
    glm::dmat4 from_unit = frame;
    for (int axis = 0; axis < 3; ++axis) {
        from_unit[axis] *= (box.high - box.low)[axis];
    }
    from_unit[3] = frame * glm::dvec4(box.low, 1.0);
    return from_unit;
}

/// The fields common to a mesh and a relief.
Draw draw_level(const Part& part, const glm::dmat4& clip_from_placed, const glm::dmat4& clip_from_box,
                const SharedByParts& shared) {
    const PlacedLevel& level = part.level;
    const geometry::Box box = level.placed_box();
    Draw draw;
    draw.shader.dithered = part.dither.has_value();
    draw.shader.even_light = shared.view.light.has_value();
    draw.shader.coloured = level.light != glm::vec3(1.0F);
    draw.drawable = level.drawable;
    draw.clip_from_unit = glm::mat4(from_unit(clip_from_placed, box));
    draw.prop_from_unit = glm::mat4(from_unit(level.prop_from_placed, box));
    draw.pixels_per_box =
        pixels_per_unit(clip_from_box, {0.0, 0.0, 0.5 * level.box_size.z}, shared.view.projector);
    draw.brightness = static_cast<float>(shared.view.brightness);
    draw.light = level.light;
    draw.dither = part.dither.value_or(Dither{});
    return draw;
}

/// The pixels of a relief on a face. If it is the only part, these are all pixels that show the box.
PixelRectangle bounds_of_relief(const relief::RasterView& view, std::size_t face, const FaceView& through,
                                const SharedByParts& shared) {
    if (shared.one_part) {
        return through.bounds;
    }
    const auto seen =
        std::find_if(view.faces.begin(), view.faces.end(),
                     [face](const relief::RasterFace& each) { return each.face == static_cast<int>(face); });
    return seen != view.faces.end() ? intersected(through.bounds, seen->lit) : PixelRectangle{};
}

/// The draw of a part on a face; nullopt if the face shows nothing of it.
std::optional<Draw> draw_part(const Part& part, std::size_t index, const FaceView& through,
                              const SharedByParts& shared, FramePlan& plan) {
    const geometry::PropFace& face = shared.prop.faces[index];
    const PlacedLevel& level = part.level;
    const double scale = level.metres_per_box;
    const glm::dmat4 clip_from_placed = through.clip_from_prop * level.prop_from_placed;
    glm::dmat4 clip_from_box = clip_from_placed;
    for (int axis = 0; axis < 3; ++axis) {
        clip_from_box[axis] *= scale;
    }
    Draw draw = draw_level(part, clip_from_placed, clip_from_box, shared);
    draw.clip_from_placed = clip_from_placed;
    if (takes_relief_draw(level)) {
        if (level.on_gpu) {
            draw.shader.blocks = true;
            draw.clip_from_box = clip_from_box;
        } else {
            draw.shader = raster_shader();
        }
        draw.relief_draw = plan.relief_draw_count - 1;
        draw.bounds = bounds_of_relief(plan.relief_draws[draw.relief_draw].view, index, through, shared);
        plan.lit.light(draw.bounds);
        return draw.bounds.empty() ? std::nullopt : std::optional(draw);
    }
    draw.shader.cut_out = level.drawable.material.cut_out;
    const glm::dmat4 placed_from_prop = glm::affineInverse(level.prop_from_placed);
    plan.front.update(*level.triangles,
                      glm::dvec3(placed_from_prop * glm::dvec4(through.eye_in_prop, 1.0)) / scale);
    FaceVolume volume =
        volume_of(face, through.eye_in_prop, placed_from_prop, scale, clip_from_box, shared.view.projector);
    if (shared.beyond) {
        volume.add(half_space_behind(face, level.prop_from_box()));
        draw.pixels_per_box = pixels_per_unit(
            clip_from_box, nearest_in_box(level, placed_from_prop, geometry::inner_point(face)),
            shared.view.projector);
    }
    draw.bounds =
        show_triangles(*level.triangles, volume, glm::mat4(clip_from_box), through.bounds, plan, draw.range);
    const bool shows =
        draw.range.count > 0 && !draw.bounds.empty(); // triangles may show beside the face alone
    return shows ? std::optional(draw) : std::nullopt;
}

/// Leaves the faces, as bits, on which the level may show.
void keep_faces(std::uint32_t faces, relief::RasterView& view) {
    std::erase_if(view.faces, [&](const relief::RasterFace& seen) {
        return (faces >> static_cast<unsigned>(seen.face) & 1U) == 0;
    });
    view.lit = {};
    for (const relief::RasterFace& seen : view.faces) {
        view.lit = united(view.lit, seen.lit);
    }
}

/// Returns false if the plan has no space for it.
bool plan_relief_draw(const Part& part, const SharedByParts& shared, FramePlan& plan) {
    const PlacedLevel& level = part.level;
    if (plan.relief_draw_count == plan.relief_draws.size()) {
        return false;
    }
    ReliefDraw& relief_draw = plan.relief_draws[plan.relief_draw_count++];
    relief_draw.relief = level.drawable.mesh;
    relief_draw.points = level.points;
    relief_draw.on_gpu = level.on_gpu;
    relief_draw.prop_from_box = level.prop_from_box();
    relief_draw.light = level.light;
    relief_draw.dither = part.dither;
    relief_draw.samples = level.samples;
    relief_draw.even_light = shared.view.light.has_value();
    relief::RasterScene scene;
    scene.prop_from_box = relief_draw.prop_from_box;
    scene.box_size = level.box_size;
    scene.projector = shared.view.projector;
    scene.prop_from_projector =
        (shared.view.table_from_projector.inverse() * shared.view.table_from_prop).inverse();
    scene.eye_m = shared.eye(0);
    relief::set_up(relief_draw.view, shared.prop, scene);
    keep_faces(level.faces, relief_draw.view);
    return true;
}

} // namespace

bool takes_relief_draw(const PlacedLevel& level) {
    return level.relief != nullptr || level.points != nullptr;
}

SharedByParts shared_by_all(const geometry::PropShape& prop, std::span<const Part> parts,
                            const PlanView& view) {
    const geometry::RigidTransform projector_from_prop =
        view.table_from_projector.inverse() * view.table_from_prop;
    SharedByParts shared{prop, view};
    shared.projector_from_prop = projector_from_prop.matrix();
    shared.clip_from_prop = view.projector.clip_from_point() * shared.projector_from_prop;
    shared.projector_in_prop = projector_from_prop.inverse().translation;
    shared.prop_from_table = view.table_from_prop.inverse();
    shared.one_part = parts.size() == 1;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const geometry::Box box = box_of(parts[k].level);
        shared.box =
            k == 0 ? box
                   : geometry::Box{glm::min(shared.box.low, box.low), glm::max(shared.box.high, box.high)};
        shared.beyond = shared.beyond || parts[k].level.beyond;
    }
    shared.parts_box = shared.box;
    if (shared.beyond) {
        shared.box = box_around(prop);
    }
    return shared;
}

std::uint32_t plan_parts(std::span<const Part> parts, const SharedByParts& shared, FramePlan& plan) {
    const std::size_t faces = std::min(shared.prop.faces.size(), geometry::max_faces);
    std::array<std::optional<FaceView>, geometry::max_faces> through{};
    std::array<std::optional<std::size_t>, geometry::max_faces> planned{}; // index into plan.faces
    for (std::size_t face = 0; face < faces; ++face) {
        through[face] = look_through(face, shared);
    }
    std::uint32_t open = 0;
    for (const Part& part : parts) {
        if (part.level.is_empty() ||
            (takes_relief_draw(part.level) && !plan_relief_draw(part, shared, plan))) {
            continue;
        }
        for (std::size_t face = 0; face < faces; ++face) {
            if (!through[face] || ((part.level.faces >> face) & 1U) == 0) {
                continue;
            }
            open |= std::uint32_t{1} << face;
            std::optional<Draw> draw = draw_part(part, face, *through[face], shared, plan);
            if (!draw) {
                continue;
            }
            if (!planned[face]) {
                planned[face] = plan.faces.size();
                FacePlan& added = plan.faces.emplace_back();
                added.face = static_cast<int>(face);
                for (const glm::dvec3& corner : shared.prop.faces[face].corners) {
                    added.corners_clip.push_back(corner_in_clip(corner, shared.clip_from_prop));
                }
                added.pixels_per_m = draw->pixels_per_box / part.level.metres_per_box;
                added.light.inverse_depth =
                    inverse_depth_of(shared.prop.faces[face], shared.projector_from_prop);
                added.depth_from_nearness = depth_from_nearness(
                    shared.prop.faces[face], through[face]->clip_from_prop, shared.projector_from_prop);
            }
            FacePlan& on = plan.faces[*planned[face]];
            on.bounds = united(on.bounds, draw->bounds);
            draw->face = static_cast<int>(*planned[face]);
            draw->part = static_cast<std::size_t>(&part - parts.data());
            plan.draws.push_back(*draw);
        }
    }
    return open;
}

} // namespace frustumscreen::scene

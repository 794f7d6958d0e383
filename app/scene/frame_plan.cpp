#include "app/scene/frame_plan.h"

#include "app/geometry/collineation.h"
#include "app/geometry/corner_fan.h"
#include "app/geometry/inner_point.h"
#include "app/scene/beyond_prop.h"
#include "app/scene/face_view.h"
#include "app/scene/pixel_density.h"
#include "app/scene/plan_hash.h"
#include "app/scene/prop_outline.h"
#include "app/scene/table_plan.h"
#include "app/scene/torch_plan.h"
#include "app/scene/window_plan.h"

#include <glm/gtc/matrix_inverse.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace frustumscreen::scene {

namespace {

/// Values of one frame that faces and parts share.
struct Shared {
    const geometry::PropShape& prop;
    const PlanView& view;
    glm::dmat4 projector_from_prop{1.0};
    glm::dmat4 clip_from_prop{1.0};
    glm::dvec3 projector_in_prop{0.0};
    geometry::RigidTransform prop_from_table = {};
    geometry::Box box = {}; ///< around all parts, prop frame; of parts that reach out of the prop, the prop's
    bool one_part = true;
    bool beyond = false; ///< PlacedLevel::beyond, of a part

    [[nodiscard]] glm::dvec3 eye(std::size_t face) const {
        const std::size_t which = view.eyes_m.size() == 1 ? 0 : std::min(face, view.eyes_m.size() - 1);
        return prop_from_table.point(view.eyes_m[which]);
    }
};

/// Points are planned as a relief that the processor draws.
bool takes_relief_draw(const PlacedLevel& level) {
    return level.relief != nullptr || level.points != nullptr;
}

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

Shared shared_by_all(const geometry::PropShape& prop, std::span<const Part> parts, const PlanView& view) {
    const geometry::RigidTransform projector_from_prop =
        view.table_from_projector.inverse() * view.table_from_prop;
    Shared shared{prop, view};
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
    if (shared.beyond) {
        shared.box = box_around(prop);
    }
    return shared;
}

/// nullopt if no eye looks through the face, or no light meets it.
std::optional<FaceView> look_through(std::size_t index, const Shared& shared) {
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
                const Shared& shared) {
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

/// The pixels of a relief on a face. One that is alone takes all that shows the box: its own.
PixelRectangle bounds_of_relief(const relief::RasterView& view, std::size_t face, const FaceView& through,
                                const Shared& shared) {
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
                              const Shared& shared, FramePlan& plan) {
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
bool plan_relief_draw(const Part& part, const Shared& shared, FramePlan& plan) {
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

/// Part by part, because the triangles that face the eye are found once for all faces that share the eye. Returns the
/// faces, as bits, through which an eye looks at a part, whether or not they show some of it.
std::uint32_t plan_parts(std::span<const Part> parts, const Shared& shared, FramePlan& plan) {
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

double pixel_density(const Shared& shared, const FramePlan& plan) {
    PixelDensity density;
    for (const FacePlan& face : plan.faces) {
        density.add(face.bounds, face.pixels_per_m);
    }
    const glm::dvec3 middle = 0.5 * (shared.box.low + shared.box.high);
    return density.share(glm::distance(middle, shared.projector_in_prop), shared.view.projector);
}

/// Samples of the first part that the GPU draws; 1 if every part is rasterized on the processor.
int samples_on_gpu(std::span<const Part> parts) {
    const auto drawn = std::find_if(parts.begin(), parts.end(), [](const Part& part) {
        return !takes_relief_draw(part.level) || part.level.on_gpu;
    });
    return drawn != parts.end() ? drawn->level.samples : (parts.empty() ? 0 : 1);
}

/// The least of the references for each eye: with different ones the eyes would see different brightness.
double dimmed_light(const Shared& shared, const LightCompensation& compensation) {
    const std::size_t faces = std::min(shared.prop.faces.size(), geometry::max_faces);
    std::array<SeenFace, geometry::max_faces> seen{};
    const auto reference_for = [&](const auto& eye_of_face) {
        for (std::size_t face = 0; face < faces; ++face) {
            seen[face] = {&shared.prop.faces[face], eye_of_face(face)};
        }
        return reference_light(std::span(seen).first(faces), shared.projector_in_prop, compensation);
    };
    if (shared.view.dimming_eyes_m.empty()) {
        return reference_for([&](std::size_t face) { return shared.eye(face); });
    }
    double least = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& eye_m : shared.view.dimming_eyes_m) {
        const glm::dvec3 eye = shared.prop_from_table.point(eye_m);
        least = std::min(least, reference_for([&](std::size_t /*face*/) { return eye; }));
    }
    return least;
}

/// All of the prop's faces count: the first triangle that comes to show on a face must not make the brightness of
/// the others jump. `open`: as plan_parts.
void compensate(const Shared& shared, const LightCompensation& compensation, std::uint32_t open,
                FramePlan& plan) {
    if (plan.faces.empty()) {
        return; // the eye or the lens may be inside the prop
    }
    const double reference = dimmed_light(shared, compensation);
    std::array<std::optional<FaceLight>, geometry::max_faces> lights{};
    for (std::size_t face = 0; face < lights.size(); ++face) {
        if ((open >> face & 1U) != 0) {
            lights[face] = face_light(shared.prop.faces[face], shared.projector_from_prop, reference);
        }
    }
    for (FacePlan& face : plan.faces) {
        face.light = lights[static_cast<std::size_t>(face.face)].value_or(FaceLight{});
    }
    feather_edges(shared.prop, shared.projector_in_prop, lights, plan);
}

} // namespace

glm::dmat4 PlacedLevel::prop_from_box() const {
    glm::dmat4 prop_from_box = prop_from_placed;
    for (int axis = 0; axis < 3; ++axis) {
        prop_from_box[axis] *= metres_per_box;
    }
    return prop_from_box;
}

PlacedLevel placed(const pack::Pack& pack, std::shared_ptr<const relief::BlockRelief> relief,
                   double metres_per_box, const Drawable& drawable) {
    PlacedLevel level{.triangles = nullptr,
                      .box_size = pack.box_size,
                      .metres_per_box = metres_per_box,
                      .drawable = drawable,
                      .samples = pack.samples};
    level.relief = std::move(relief);
    return level;
}

PlacedLevel placed(const pack::Pack& pack, std::uint32_t level, double metres_per_box,
                   const Drawable& drawable) {
    return {.triangles = std::make_shared<LevelTriangles>(triangles_of(pack.levels[level], pack.box_size)),
            .box_size = pack.box_size,
            .metres_per_box = metres_per_box,
            .drawable = drawable,
            .samples = pack.samples};
}

std::array<Part, 2> fade(const PlacedLevel& from, const PlacedLevel& to, double share) {
    const auto arrived = static_cast<float>(share);
    return {Part{from, Dither{arrived, true}}, Part{to, Dither{arrived, false}}};
}

FramePlan make_plan(const geometry::PropShape& prop, const PlacedLevel& artifact) {
    return make_plan(prop, artifact.triangles ? artifact.triangles->indices.size() : 0, 1);
}

FramePlan make_plan(const geometry::PropShape& prop, std::size_t indices, std::size_t parts) {
    FramePlan plan;
    const std::size_t faces = prop.faces.size();
    std::size_t edges = 0; // of all faces
    std::size_t quads = 0;
    for (const geometry::PropFace& face : prop.faces) {
        edges += face.corners.size();
        quads += geometry::fan_quads(face.corners.size());
    }
    plan.faces.reserve(faces);
    plan.draws.reserve(parts * faces + max_on_table + 1 + quads);
    plan.feathers.reserve(edges);
    // A triangle may show on every face. Reserved memory costs nothing until it is written.
    plan.indices.reserve(faces * indices);
    plan.front.reserve(indices);
    plan.relief_draws.resize(parts);
    for (ReliefDraw& relief_draw : plan.relief_draws) {
        relief_draw.view.faces.reserve(faces);
    }
    return plan;
}

void plan_frame(const geometry::PropShape& prop, std::span<const Part> parts, const PlanView& view,
                FramePlan& plan) {
    const Shared shared = shared_by_all(prop, parts, view);
    plan.projector = view.projector;
    plan.picture = view.picture;
    plan.faces.clear();
    plan.draws.clear();
    plan.feathers.clear();
    plan.indices.clear();
    plan.front.forget();
    plan.relief_draw_count = 0;
    plan.lit.begin(view.projector.width, view.projector.height);
    plan.prop_bounds = prop_bounds(prop, view.projector, shared.clip_from_prop);
    plan_table(prop, view, plan);
    std::uint32_t open = 0;
    if (!view.eyes_m.empty() && view.brightness > 0.0) {
        open = plan_parts(parts, shared, plan);
    }
    plan.lit.finish();
    const double density = pixel_density(shared, plan);
    plan.samples = samples_at(density, samples_on_gpu(parts));
    for (std::size_t k = 0; k < plan.relief_draw_count; ++k) {
        plan.relief_draws[k].samples = samples_at(density, std::max(plan.relief_draws[k].samples, 1));
    }
    if (view.light) {
        compensate(shared, *view.light, open, plan);
    }
    PlanView lit = view;
    lit.torches = shared.beyond ? std::span<const PlacedTorch>() : view.torches;
    plan_torches(parts, lit, shared.box, plan);
    plan_windows(prop, view, plan);
    plan.prop_hash = hash_of_prop(plan);
    plan.hash = hash_of(plan);
}

void plan_frame(const geometry::PropShape& prop, const PlacedLevel& artifact, const PlanView& view,
                FramePlan& plan) {
    const Part whole{artifact, std::nullopt};
    plan_frame(prop, std::span(&whole, 1), view, plan);
}

PixelRectangle lit_bounds(const FramePlan& plan) {
    PixelRectangle bounds = plan.lit.bounds();
    for (const Draw& draw : plan.draws) {
        bounds = united(bounds, draw.bounds);
    }
    for (std::size_t k = 0; k < plan.window_count; ++k) {
        bounds = united(bounds, bounds_in_prop(plan.windows[k]));
    }
    return bounds;
}

PixelRectangle bounds_in_prop(const FramePlan& plan) {
    PixelRectangle bounds = plan.lit.bounds();
    for (const Draw& draw : plan.draws) {
        bounds = draw.face != Draw::on_table ? united(bounds, draw.bounds) : bounds;
    }
    return bounds;
}

} // namespace frustumscreen::scene

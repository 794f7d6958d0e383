#include "app/scene/frame_plan.h"

#include "app/geometry/corner_fan.h"
#include "app/geometry/inner_point.h"
#include "app/scene/part_plan.h"
#include "app/scene/pixel_density.h"
#include "app/scene/plan_hash.h"
#include "app/scene/prop_outline.h"
#include "app/scene/table_plan.h"
#include "app/scene/torch_plan.h"
#include "app/scene/window_plan.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace frustumscreen::scene {

namespace {

double pixel_density(const SharedByParts& shared, const FramePlan& plan) {
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

/// The least reference of all eyes: with different references the eyes would see different brightness.
double dimmed_light(const SharedByParts& shared, const LightCompensation& compensation) {
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
void compensate(const SharedByParts& shared, const LightCompensation& compensation, std::uint32_t open,
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
    const SharedByParts shared = shared_by_all(prop, parts, view);
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
    plan_torches(prop, parts, view, shared.parts_box, plan);
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

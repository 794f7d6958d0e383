/// From pixels of a rasterized relief and their nearness to places in a torch's frame, eight at a time.
///
/// Frames   pixels and nearness: relief/nearness_row.h; torch: torch.h, metres. Torch's own picture: shares -1..1 from its middle.
/// Threads  values; any.
/// SIMD     as relief/rasterize_blocks.h; for code that is inlined into one that runs with an instruction set.
#pragma once

#include "app/relief/lens_lanes.h"
#include "app/scene/frame_plan.h"

#include <cstddef>

namespace frustumscreen::render {

/// Linear in a pixel's place.
struct Plane {
    float x, y, rest;
    FRUSTUMSCREEN_INLINE relief::Floats at(const relief::PixelLanes& pixels) const {
        return x * pixels.x + (y * pixels.y + rest);
    }
};

struct PlaceLanes {
    relief::PixelLanes ideal; ///< pixels
    relief::Floats depth;     ///< 1 over the depth of the prop's face
    relief::Floats x, y, z;   ///< torch's frame
    relief::Floats s, t;      ///< torch's own picture
};

/// The place of what a pixel shows is eye + (X, Y, Z) / (depth nearness), in the torch's frame.
struct PlaceMap {
    relief::PixelLens lens;
    Plane x, y, z, depth;
    glm::vec3 eye;
    glm::vec2 per_half_extent;

    PlaceMap(const scene::FramePlan& plan, const scene::TorchFace& face) : lens(plan.projector) {
        const scene::TorchLight& light = plan.torches[face.torch];
        const glm::dvec3 inverse_depth(plan.faces[static_cast<std::size_t>(face.face)].light.inverse_depth);
        const glm::dmat4 from_projector(light.torch_from_projector);
        const glm::dvec3 from_eye = glm::dvec3(from_projector[3]) - glm::dvec3(light.eye);
        const glm::dmat3 from_ray = glm::dmat3(from_projector) + glm::outerProduct(from_eye, inverse_depth);
        const auto plane = [&](const glm::dvec3& of_ray) {
            const geometry::Pinhole& pinhole = plan.projector;
            const glm::dvec2 per_pixel = glm::dvec2(of_ray) / glm::dvec2(pinhole.fx, pinhole.fy);
            return Plane{static_cast<float>(per_pixel.x), static_cast<float>(per_pixel.y),
                         static_cast<float>(of_ray.z - per_pixel.x * pinhole.cx - per_pixel.y * pinhole.cy)};
        };
        const glm::dmat3 rows = glm::transpose(from_ray);
        x = plane(rows[0]);
        y = plane(rows[1]);
        z = plane(rows[2]);
        depth = plane(inverse_depth);
        eye = light.eye;
        per_half_extent = light.per_half_extent;
    }
    FRUSTUMSCREEN_INLINE PlaceLanes at(const relief::PixelLanes& pixels, relief::Floats nearness) const {
        PlaceLanes place;
        place.ideal = lens.bends ? unbent(lens, pixels) : pixels;
        place.depth = depth.at(place.ideal);
        const relief::Floats scale = 1.0F / (place.depth * nearness);
        place.x = eye.x + x.at(place.ideal) * scale;
        place.y = eye.y + y.at(place.ideal) * scale;
        place.z = eye.z + z.at(place.ideal) * scale;
        const relief::Floats per_z = 1.0F / place.z;
        place.s = place.x * per_z * per_half_extent.x;
        place.t = place.y * per_z * per_half_extent.y;
        return place;
    }
};

} // namespace frustumscreen::render

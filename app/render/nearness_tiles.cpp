#include "app/render/nearness_tiles.h"

#include "app/relief/lens_lanes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace frustumscreen::render {

namespace {

using relief::all;
using relief::Floats;
using relief::Ints;

constexpr int group_px = relief::lanes;
constexpr int torch_px = scene::torch_picture_px;
static_assert(torch_px == relief::TileMask::max_px);

/// Linear in a pixel's place.
struct Plane {
    float x, y, rest;
    FRUSTUMSCREEN_INLINE Floats at(const relief::PixelLanes& pixels) const {
        return x * pixels.x + (y * pixels.y + rest);
    }
};

/// The place of what a pixel shows is eye + (X, Y, Z) / (depth nearness), in the torch's frame.
struct PlaceMap {
    relief::PixelLens lens;
    Plane x, y, z, depth;
    glm::vec3 eye;
    glm::vec2 per_half_extent;
    float max_square; ///< of the way
    bool round;

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
        constexpr float rounding = 1.001F;
        max_square = rounding * light.reach_m * light.reach_m;
        round = light.torch.beam.shape == torch::Shape::Round;
    }
};

struct InBeam {
    Ints lit;
    Floats x, y; ///< in the torch's own picture, pixels
};

FRUSTUMSCREEN_INLINE InBeam in_beam(const PlaceMap& map, const relief::PixelLanes& pixels, Floats nearness) {
    const relief::PixelLanes at = map.lens.bends ? unbent(map.lens, pixels) : pixels;
    const Floats scale = 1.0F / (map.depth.at(at) * nearness);
    const Floats x = map.eye.x + map.x.at(at) * scale;
    const Floats y = map.eye.y + map.y.at(at) * scale;
    const Floats z = map.eye.z + map.z.at(at) * scale;
    const Floats per_z = 1.0F / z;
    const Floats s = x * per_z * map.per_half_extent.x;
    const Floats t = y * per_z * map.per_half_extent.y;
    const Floats out = map.round ? s * s + t * t : relief::most(s * s, t * t);
    constexpr float just_outside = 1.001F;
    constexpr float half = 0.5F * torch_px;
    return {(nearness > 0.0F) & (z > 0.0F) & (out <= just_outside) &
                (x * x + y * y + z * z <= map.max_square),
            half * s + half, half * t + half};
}

/// Around some pixels' places in the torch's own picture.
struct Around {
    Floats left = all(1e9F), right = all(-1e9F), top = all(1e9F), bottom = all(-1e9F);

    FRUSTUMSCREEN_INLINE void add(const InBeam& at) {
        left = at.lit & (at.x < left) ? at.x : left;
        right = at.lit & (at.x > right) ? at.x : right;
        top = at.lit & (at.y < top) ? at.y : top;
        bottom = at.lit & (at.y > bottom) ? at.y : bottom;
    }
    /// With the four pixels around each place.
    FRUSTUMSCREEN_INLINE PixelRectangle pixels() const {
        constexpr float beside = 2.0F;
        const auto whole = [](float at) {
            return static_cast<int>(std::clamp(at, 0.0F, static_cast<float>(torch_px)));
        };
        const int first_x = whole(relief::min_of(left) - beside);
        const int first_y = whole(relief::min_of(top) - beside);
        return {.x = first_x,
                .y = first_y,
                .width = whole(relief::max_of(right) + beside + 1.0F) - first_x,
                .height = whole(relief::max_of(bottom) + beside + 1.0F) - first_y};
    }
};

/// Joins a group to the one on its left, or a run of groups to an equal one above it. `first`: of the part's rectangles.
void add_group(std::vector<PixelRectangle>& rectangles, std::size_t first, const PixelRectangle& group) {
    if (rectangles.size() > first) {
        PixelRectangle& last = rectangles.back();
        if (last.y == group.y && last.x + last.width == group.x) {
            last.width += group.width;
            return;
        }
    }
    rectangles.push_back(group);
}

FRUSTUMSCREEN_INLINE bool find_group(const PlaceMap& map, const PixelRectangle& group,
                                     const relief::PictureSpan<const float>& nearness,
                                     relief::TileMask& asked) {
    constexpr int rows_of_half = group_px / 2; // a rectangle around fewer rows holds less beside them
    bool any_lit = false;
    const int first = std::min(group.x, nearness.width - relief::lanes); // eight pixels of the same row
    const Ints inside =
        (relief::lane_numbers >= group.x - first) & (relief::lane_numbers < group.x + group.width - first);
    const Floats x = __builtin_convertvector(relief::lane_numbers + first, Floats) + 0.5F;
    for (int top = group.y; top < group.y + group.height; top += rows_of_half) {
        Around around;
        Ints lit{};
        for (int y = top; y < std::min(top + rows_of_half, group.y + group.height); ++y) {
            const Floats met = inside ? relief::load(&nearness.at(first, y)) : Floats{};
            if (!relief::any(met > 0.0F)) {
                continue;
            }
            const InBeam at = in_beam(map, {x, all(static_cast<float>(y) + 0.5F)}, met);
            around.add(at);
            lit |= at.lit;
        }
        if (relief::any(lit)) {
            any_lit = true;
            asked.ask(around.pixels());
        }
    }
    return any_lit;
}

FRUSTUMSCREEN_INLINE void find_groups(const PlaceMap& map, const PixelRectangle& part,
                                      const relief::PictureSpan<const float>& nearness, LitParts& lit) {
    const std::size_t before = lit.rectangles.size();
    const int right = part.x + part.width;
    const int bottom = part.y + part.height;
    for (int top = part.y / group_px * group_px; top < bottom; top += group_px) {
        for (int left = part.x / group_px * group_px; left < right; left += group_px) {
            const PixelRectangle group =
                intersected(part, {.x = left, .y = top, .width = group_px, .height = group_px});
            if (find_group(map, group, nearness, lit.asked)) {
                add_group(lit.rectangles, before, group);
            }
        }
    }
}

} // namespace

void add_lit(const scene::FramePlan& plan, const scene::TorchFace& face, const PixelRectangle& part,
             const relief::PictureSpan<const float>& nearness, LitParts& lit,
             relief::Instructions instructions) {
    const PlaceMap map(plan, face);
    relief::run_with<find_groups>(instructions, map, part, nearness, lit);
}

} // namespace frustumscreen::render

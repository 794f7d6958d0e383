#include "app/render/nearness_tiles.h"

#include "app/render/place_map.h"

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

struct InBeam {
    Ints lit;
    Floats x, y; ///< in the torch's own picture, pixels
};

/// A beam, widened for rounding.
struct Beam {
    float max_square; ///< of the distance from the torch
    bool round;

    explicit Beam(const scene::TorchLight& light) : round(light.torch.beam.shape == torch::Shape::Round) {
        constexpr float rounding = 1.001F;
        max_square = rounding * light.reach_m * light.reach_m;
    }
};

struct TorchView {
    PlaceMap map;
    Beam beam;
};

FRUSTUMSCREEN_INLINE InBeam in_beam(const TorchView& torch, const relief::PixelLanes& pixels,
                                    Floats nearness) {
    const PlaceLanes at = torch.map.at(pixels, nearness);
    const Floats out = torch.beam.round ? at.s * at.s + at.t * at.t : relief::most(at.s * at.s, at.t * at.t);
    constexpr float just_outside = 1.001F;
    constexpr float half = 0.5F * torch_px;
    return {(nearness > 0.0F) & (at.z > 0.0F) & (out <= just_outside) &
                (at.x * at.x + at.y * at.y + at.z * at.z <= torch.beam.max_square),
            half * at.s + half, half * at.t + half};
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

FRUSTUMSCREEN_INLINE bool find_group(const TorchView& torch, const PixelRectangle& group,
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
            const InBeam at = in_beam(torch, {x, all(static_cast<float>(y) + 0.5F)}, met);
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

FRUSTUMSCREEN_INLINE void find_groups(const TorchView& torch, const PixelRectangle& part,
                                      const relief::PictureSpan<const float>& nearness, LitParts& lit) {
    const std::size_t before = lit.rectangles.size();
    const int right = part.x + part.width;
    const int bottom = part.y + part.height;
    for (int top = part.y / group_px * group_px; top < bottom; top += group_px) {
        for (int left = part.x / group_px * group_px; left < right; left += group_px) {
            const PixelRectangle group =
                intersected(part, {.x = left, .y = top, .width = group_px, .height = group_px});
            if (find_group(torch, group, nearness, lit.asked)) {
                add_group(lit.rectangles, before, group);
            }
        }
    }
}

} // namespace

void add_lit(const scene::FramePlan& plan, const scene::TorchFace& face, const PixelRectangle& part,
             const relief::PictureSpan<const float>& nearness, LitParts& lit,
             relief::Instructions instructions) {
    const TorchView torch{PlaceMap(plan, face), Beam(plan.torches[face.torch])};
    relief::run_with<find_groups>(instructions, torch, part, nearness, lit);
}

} // namespace frustumscreen::render

#include "app/ldi/point_patch.h"

#include "app/relief/lanes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <span>

namespace frustumscreen::ldi {

namespace {

using relief::all;
using relief::Floats;
using relief::Ints;
using relief::lanes;
using relief::load;

constexpr float per_step = 8192.0F; ///< codes of a slope
/// More than rounding may leave between splats that touch.
constexpr float overlap_px = 1.0F / 256.0F;

/// The warp from an image's place and nearness to the picture, homogeneous.
struct Warp {
    std::array<float, 3> origin{}, per_column{}, per_row{}, per_nearness{};
    float slope_per_code = 0.0F; ///< for a nearness of 1
};
std::array<float, 3> rounded(const glm::dvec3& vector) {
    return {static_cast<float>(vector.x), static_cast<float>(vector.y), static_cast<float>(vector.z)};
}
Warp warp_between(const PictureMap& from, const PictureMap& to) {
    return {.origin = rounded(to.homogeneous_from_eye(from.ray(0.5, 0.5))),
            .per_column = rounded(to.homogeneous_from_eye(from.per_column())),
            .per_row = rounded(to.homogeneous_from_eye(from.per_row())),
            .per_nearness = rounded(to.homogeneous(from.eye())),
            .slope_per_code = static_cast<float>(from.step_share()) / per_step};
}

/// `to`: a collineation of the world.
Warp warp_through(const PictureMap& from, const glm::mat<4, 3, double>& to) {
    const auto vector = [&to](const glm::dvec3& along) { return rounded(to * glm::dvec4(along, 0.0)); };
    return {.origin = vector(from.ray(0.5, 0.5)),
            .per_column = vector(from.per_column()),
            .per_row = vector(from.per_row()),
            .per_nearness = rounded(to * glm::dvec4(from.eye(), 1.0)),
            .slope_per_code = static_cast<float>(from.step_share()) / per_step};
}

struct Target {
    std::span<std::uint64_t> nearest;
    int width = 0, height = 0;
    CellMask cells = all_cells; ///< of the eye
};

/// The point that a collineation does not map; NaN where there is none.
glm::dvec3 eye_of(const glm::mat<4, 3, double>& pixel_from_window) {
    return -(glm::inverse(glm::dmat3(pixel_from_window)) * pixel_from_window[3]);
}

FRUSTUMSCREEN_INLINE Ints load_ints(const std::uint32_t* from) {
    Ints value;
    std::memcpy(&value, from, sizeof value);
    return value;
}
FRUSTUMSCREEN_INLINE Floats floats(Ints values) {
    return __builtin_convertvector(values, Floats);
}
FRUSTUMSCREEN_INLINE Floats absolute(Floats values) {
    return values < 0.0F ? -values : values;
}
/// First of the pixels 0 to `count` whose middle is beyond `places`.
FRUSTUMSCREEN_INLINE Ints first_pixels(Floats places, float count) {
    return __builtin_convertvector(relief::least(relief::most(places + 0.5F, Floats{}), all(count)), Ints);
}

/// The pixels that eight points cover.
struct Boxes {
    Ints left, right, top, bottom; ///< pixels; right and bottom excluded
    Floats seen;                   ///< nearness for the eye
    Ints drawn;                    ///< mask: the lane has a box
};

/// Half the side of a splat, from the warp's Jacobian along the surface.
FRUSTUMSCREEN_INLINE Floats half_side(Floats scale, Floats across, Floats down) {
    return relief::least(0.5F * scale * (absolute(across) + absolute(down)) + overlap_px,
                         all(0.5F * static_cast<float>(max_splat_px)));
}

FRUSTUMSCREEN_INLINE Boxes boxes_at(const PointPatch& patch, std::size_t first, const Warp& warp,
                                    const Target& target) {
    const Ints place = load_ints(&patch.places[first]);
    const Floats column = floats(place & 0xFFFF);
    const Floats row = floats(place >> 16);
    const Floats nearness = load(&patch.nearness[first]);
    const Ints slopes = load_ints(&patch.slopes[first]);
    const Floats slope_unit = nearness * warp.slope_per_code;
    const Floats slope_right = floats((slopes << 16) >> 16) * slope_unit;
    const Floats slope_down = floats(slopes >> 16) * slope_unit;
    std::array<Floats, 3> at, across, down;
    for (std::size_t k = 0; k < 3; ++k) {
        at[k] = all(warp.origin[k]) + column * warp.per_column[k] + row * warp.per_row[k] +
                nearness * warp.per_nearness[k];
        across[k] = all(warp.per_column[k]) + slope_right * warp.per_nearness[k];
        down[k] = all(warp.per_row[k]) + slope_down * warp.per_nearness[k];
    }
    const Ints before = (at[2] > nearness * static_cast<float>(min_farness)) & (nearness > 0.0F);
    const Floats scale = 1.0F / (before ? at[2] : all(1.0F));
    const Floats u = at[0] * scale;
    const Floats v = at[1] * scale;
    const Floats half_width = half_side(scale, across[0] - u * across[2], down[0] - u * down[2]);
    const Floats half_height = half_side(scale, across[1] - v * across[2], down[1] - v * down[2]);
    const auto width = static_cast<float>(target.width);
    const auto height = static_cast<float>(target.height);
    Boxes boxes{.left = first_pixels(u - half_width, width),
                .right = first_pixels(u + half_width, width),
                .top = first_pixels(v - half_height, height),
                .bottom = first_pixels(v + half_height, height),
                .seen = nearness * scale,
                .drawn = {}};
    boxes.drawn = before & (boxes.left < boxes.right) & (boxes.top < boxes.bottom);
    return boxes;
}

FRUSTUMSCREEN_INLINE std::uint64_t nearer(std::uint64_t pixel, std::uint64_t point) {
    return pixel > point ? pixel : point;
}

/// Boxes as scalars.
struct Corners {
    alignas(32) std::array<std::uint64_t, lanes> points;
    alignas(32) std::array<std::int32_t, lanes> top_left, top_last, bottom_left,
        bottom_last;        ///< numbers of pixels
    unsigned pairs, others; ///< bit k for lane k; a pair has one pixel, or two beside or below each other
};

FRUSTUMSCREEN_INLINE void corners_of(const Boxes& boxes, Ints colours, std::int32_t width, Corners& corners) {
    Ints seen;
    std::memcpy(&seen, &boxes.seen, sizeof seen);
    const Ints low = __builtin_shufflevector(colours, seen, 0, 8, 1, 9, 2, 10, 3, 11);
    const Ints high = __builtin_shufflevector(colours, seen, 4, 12, 5, 13, 6, 14, 7, 15);
    std::memcpy(corners.points.data(), &low, sizeof low);
    std::memcpy(&corners.points[lanes / 2], &high, sizeof high);
    const Ints last = boxes.right - 1;
    const Ints top = boxes.top * width;
    const Ints bottom = (boxes.bottom - 1) * width;
    relief::store(corners.top_left.data(), top + boxes.left);
    relief::store(corners.top_last.data(), top + last);
    relief::store(corners.bottom_left.data(), bottom + boxes.left);
    relief::store(corners.bottom_last.data(), bottom + last);
    const Ints wide = last - boxes.left;
    const Ints high_px = boxes.bottom - 1 - boxes.top;
    const Ints is_pair = wide + high_px < 2;
    corners.pairs = relief::bits_of(boxes.drawn & is_pair);
    corners.others = relief::bits_of(boxes.drawn & ~is_pair);
}

/// Nine boxes in ten are pairs.
FRUSTUMSCREEN_INLINE void draw_pair(const Corners& corners, std::size_t lane, std::uint64_t* pixels) {
    const std::uint64_t point = corners.points[lane];
    std::uint64_t& one = pixels[corners.top_left[lane]];
    std::uint64_t& other = pixels[corners.bottom_last[lane]];
    // Both are read before one is written: where they are one pixel, no read waits for a write.
    const std::uint64_t nearest = nearer(one, point);
    const std::uint64_t nearest_other = nearer(other, point);
    one = nearest;
    other = nearest_other;
}

FRUSTUMSCREEN_INLINE void draw_box(const Corners& corners, std::size_t lane, const Target& target) {
    const std::uint64_t point = corners.points[lane];
    const std::int32_t wide = corners.top_last[lane] - corners.top_left[lane];
    for (std::int32_t row = corners.top_left[lane]; row <= corners.bottom_left[lane]; row += target.width) {
        for (std::int32_t pixel = row; pixel <= row + wide; ++pixel) {
            std::uint64_t& nearest = target.nearest[static_cast<std::size_t>(pixel)];
            nearest = nearer(nearest, point);
        }
    }
}

FRUSTUMSCREEN_INLINE void draw_points(const PointPatch& patch, const Warp& warp, const Target& target) {
    static_assert(block_points == lanes);
    const auto each = [](unsigned boxes, const auto& draw) FRUSTUMSCREEN_INLINED {
        for (; boxes != 0; boxes &= boxes - 1) {
            draw(static_cast<std::size_t>(std::countr_zero(boxes)));
        }
    };
    Corners corners;
    std::uint64_t* const pixels = target.nearest.data();
    for (std::size_t first = 0; first < patch.places.size(); first += lanes) {
        if (!patch.seen.empty() && (patch.seen[first / lanes] & target.cells) == 0) {
            continue;
        }
        corners_of(boxes_at(patch, first, warp, target), load_ints(&patch.colours[first]), target.width,
                   corners);
        each(corners.pairs,
             [&](std::size_t lane) FRUSTUMSCREEN_INLINED { draw_pair(corners, lane, pixels); });
        each(corners.others,
             [&](std::size_t lane) FRUSTUMSCREEN_INLINED { draw_box(corners, lane, target); });
    }
}

std::uint32_t code_of(float slope, double step) {
    const double code =
        std::clamp(static_cast<double>(slope) / step * static_cast<double>(per_step), -32768.0, 32767.0);
    return static_cast<std::uint32_t>(
        static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(code))));
}

} // namespace

PointPatch point_patch(const LayeredDepth& layers) {
    PointPatch patch;
    patch.camera = layers.camera;
    const PictureMap map(layers.camera);
    if (!map.usable() || layers.firsts.size() != layers.camera.pixel_count() + 1) {
        return patch;
    }
    for (int y = 0; y < layers.camera.height; ++y) {
        for (int x = 0; x < layers.camera.width; ++x) {
            for (const DepthPixel& pixel : layers.at(x, y)) {
                const double step = map.step_share() * static_cast<double>(pixel.nearness);
                patch.places.push_back(static_cast<std::uint32_t>(y) << 16U | static_cast<std::uint32_t>(x));
                patch.nearness.push_back(pixel.nearness);
                patch.slopes.push_back(code_of(pixel.slope.y, step) << 16U | code_of(pixel.slope.x, step));
                patch.colours.push_back(std::bit_cast<std::uint32_t>(
                    glm::u8vec4(pixel.colour.r, pixel.colour.g, pixel.colour.b, 255)));
            }
        }
    }
    const std::size_t padded = (patch.places.size() + lanes - 1) / lanes * lanes;
    for (std::vector<std::uint32_t>* values : {&patch.places, &patch.slopes, &patch.colours}) {
        values->resize(padded);
    }
    patch.nearness.resize(padded);
    return patch;
}

std::span<const std::uint64_t> PointSplatter::draw(const PointPatch& patch,
                                                   const glm::mat<4, 3, double>& pixel_from_window, int width,
                                                   int height, relief::Instructions instructions) {
    nearest_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    if (const PictureMap from(patch.camera); from.usable()) {
        const Warp warp = warp_through(from, pixel_from_window);
        const Target target{nearest_, width, height, patch.cells.cell_of(eye_of(pixel_from_window))};
        relief::run_with<draw_points>(instructions, patch, warp, target);
    }
    return nearest_;
}

std::span<const std::uint64_t> PointSplatter::draw(const PointPatch& patch, const PictureCamera& camera,
                                                   relief::Instructions instructions) {
    nearest_.assign(camera.pixel_count(), 0);
    const PictureMap from(patch.camera);
    const PictureMap to(camera);
    if (from.usable() && to.usable()) {
        const Warp warp = warp_between(from, to);
        const Target target{nearest_, camera.width, camera.height, patch.cells.cell_of(camera.eye)};
        relief::run_with<draw_points>(instructions, patch, warp, target);
    }
    return nearest_;
}

void PointSplatter::draw(const PointPatch& patch, DepthPicture& picture, relief::Instructions instructions) {
    const std::span<const std::uint64_t> words = draw(patch, picture.camera, instructions);
    for (std::size_t k = 0; k < words.size(); ++k) {
        picture.nearness[k] = std::bit_cast<float>(static_cast<std::uint32_t>(words[k] >> 32U));
        picture.colours[k] = std::bit_cast<glm::u8vec4>(static_cast<std::uint32_t>(words[k]));
    }
}

void colours_of(std::span<const std::uint64_t> words, std::span<glm::u8vec4> colours) {
    assert(words.size() == colours.size());
    for (std::size_t k = 0; k < words.size(); ++k) {
        const auto code = static_cast<std::uint32_t>(words[k]);
        std::memcpy(&colours[k], &code, sizeof code);
    }
}

} // namespace frustumscreen::ldi

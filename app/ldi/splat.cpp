#include "app/ldi/layered_depth.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::ldi {

namespace {

/// As much as rounding may leave between splats that touch.
constexpr double overlap_px = 1.0 / 1024.0;

/// McMillan and Bishop's warp from an image to a picture: homogeneous, linear in the image's place and nearness.
struct Warp {
    glm::dvec3 origin, per_column, per_row, per_nearness;
    Warp(const PictureMap& from, const PictureMap& to)
        : origin(to.homogeneous_from_eye(from.ray(0.0, 0.0))),
          per_column(to.homogeneous_from_eye(from.per_column())),
          per_row(to.homogeneous_from_eye(from.per_row())), per_nearness(to.homogeneous(from.eye())) {}
};

/// The first pixel of 0 to `count` whose middle is not before `place`.
int first_pixel(double place, int count) {
    const double from_middle = std::clamp(place - 0.5, -1.0, static_cast<double>(count));
    const int toward_zero = static_cast<int>(from_middle);
    return std::max(0, toward_zero + (from_middle > static_cast<double>(toward_zero) ? 1 : 0));
}

/// Draws the box that holds the image of a depth pixel. `base` is the warp of its place.
template <bool by_depth>
[[gnu::always_inline]] inline void draw(const DepthPixel& pixel, const glm::dvec3& base, const Warp& warp,
                                        DepthPicture& picture) {
    const auto nearness = static_cast<double>(pixel.nearness);
    const glm::dvec3 place = base + nearness * warp.per_nearness;
    if (!(place.z > min_farness * nearness)) { // too near to the eye, or behind it
        return;
    }
    const double scale = 1.0 / place.z;
    const double u = place.x * scale;
    const double v = place.y * scale;
    // The derivatives along the surface: the Jacobian of the warp.
    const glm::dvec3 across = warp.per_column + static_cast<double>(pixel.slope.x) * warp.per_nearness;
    const glm::dvec3 down = warp.per_row + static_cast<double>(pixel.slope.y) * warp.per_nearness;
    const double half_width = std::min(
        0.5 * max_splat_px,
        0.5 * scale * (std::fabs(across.x - u * across.z) + std::fabs(down.x - u * down.z)) + overlap_px);
    const double half_height = std::min(
        0.5 * max_splat_px,
        0.5 * scale * (std::fabs(across.y - v * across.z) + std::fabs(down.y - v * down.z)) + overlap_px);
    const int left = first_pixel(u - half_width, picture.camera.width);
    const int right = first_pixel(u + half_width, picture.camera.width);
    const int top = first_pixel(v - half_height, picture.camera.height);
    const int bottom = first_pixel(v + half_height, picture.camera.height);
    const auto seen = static_cast<float>(nearness * scale);
    const glm::u8vec4 colour(pixel.colour.r, pixel.colour.g, pixel.colour.b, 255);
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            const std::size_t at = picture.at(x, y);
            if (!by_depth || seen > picture.nearness[at]) {
                picture.nearness[at] = seen;
                picture.colours[at] = colour;
            }
        }
    }
}

/// Columns or rows on one side of the epipole, in the order in which they are drawn.
struct Sheet {
    int first = 0, end = 0, step = 1;
};

/// The two sheets along one axis: towards the epipole if the eye is before the image's camera, away from it if it is behind.
std::array<Sheet, 2> sheets(double place, double farness, int count) {
    int split = (place < 0.0) == std::signbit(farness)
                    ? count
                    : 0; // the epipole is far to one side, perhaps infinitely far
    if (std::fabs(place) < (count + 1.0) * std::fabs(farness)) {
        split = first_pixel(place / farness, count);
    }
    if (std::signbit(farness)) {
        return {{{split - 1, -1, -1}, {split, count, 1}}};
    }
    return {{{0, split, 1}, {count - 1, split - 1, -1}}};
}

template <bool by_depth> void splat_all(const LayeredDepth& layers, DepthPicture& picture) {
    const PictureMap from(layers.camera);
    const PictureMap to(picture.camera);
    if (!from.usable() || !to.usable() || layers.firsts.size() != layers.camera.pixel_count() + 1) {
        return;
    }
    const Warp warp(from, to);
    const glm::dvec3 epipole = from.homogeneous(to.eye());
    for (const Sheet& rows : sheets(epipole.y, epipole.z, layers.camera.height)) {
        for (const Sheet& columns : sheets(epipole.x, epipole.z, layers.camera.width)) {
            for (int y = rows.first; y != rows.end; y += rows.step) {
                const glm::dvec3 row = warp.origin + (y + 0.5) * warp.per_row;
                for (int x = columns.first; x != columns.end; x += columns.step) {
                    const glm::dvec3 base = row + (x + 0.5) * warp.per_column;
                    for (const DepthPixel& pixel : layers.at(x, y)) {
                        draw<by_depth>(pixel, base, warp, picture);
                    }
                }
            }
        }
    }
}

} // namespace

void splat(const LayeredDepth& layers, DepthPicture& picture) {
    splat_all<false>(layers, picture);
}

void splat_by_depth(const LayeredDepth& layers, DepthPicture& picture) {
    splat_all<true>(layers, picture);
}

} // namespace frustumscreen::ldi

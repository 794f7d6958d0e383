#include "app/torch/shadow_map.h"

#include "app/geometry/cut_polygon.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

namespace frustumscreen::torch {

namespace {

constexpr int parts_of_pixel = 256;
/// A corner farther out is cut: 64-bit products of differences of corners are exact by far.
constexpr double guard_px = 16384.0;
constexpr double min_z_m = 1e-4;
constexpr float dark_nearness = 1e30F;          ///< nearer than anything
constexpr std::uint16_t needs_cutting = 0xFFFF; ///< a column

/// The first pixel of 0 to `count` whose middle is not before `place`.
std::uint16_t first_pixel(std::int32_t place, int count) {
    constexpr std::int32_t half = parts_of_pixel / 2;
    const std::int32_t pixel = (place - half + parts_of_pixel - 1) >> 8; // floors
    return static_cast<std::uint16_t>(std::clamp(pixel, 0, count));
}
static_assert(parts_of_pixel == 1 << 8);

/// Positive on the inner side of an edge of a triangle that turns clockwise as the picture is seen.
struct Edge {
    std::int64_t per_x, per_y, at; ///< a step of a pixel; at the first pixel's middle

    Edge(std::int32_t from_x, std::int32_t from_y, std::int32_t to_x, std::int32_t to_y, std::int64_t x,
         std::int64_t y)
        : per_x(std::int64_t{from_y} - to_y), per_y(std::int64_t{to_x} - from_x),
          at(per_x * (x - from_x) + per_y * (y - from_y)) {
        per_x *= parts_of_pixel;
        per_y *= parts_of_pixel;
    }
};

/// Narrows the columns `first` to `last` to those inside the edge, whose value at column 0 is `at`. The quotient of integers
/// below 2^53 is rounded to an integer only if it is one.
void narrow(std::int64_t at, std::int64_t per_x, int& first, int& last) {
    if (per_x == 0) {
        last = at < 0 ? -1 : last;
        return;
    }
    const double zero = static_cast<double>(-at) / static_cast<double>(per_x);
    if (per_x > 0) {
        if (zero > static_cast<double>(first)) {
            first = zero > static_cast<double>(last) ? last + 1 : static_cast<int>(std::ceil(zero));
        }
    } else if (zero < static_cast<double>(last)) {
        last = zero < 0.0 ? -1 : static_cast<int>(zero);
    }
}

} // namespace

void ShadowMap::begin(int width, int height, const PixelRectangle& part) {
    width_ = width;
    height_ = height;
    part_ = part;
    has_backs_ = false;
    nearness_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = part.y; y < part.y + part.height; ++y) {
        std::fill_n(nearness_.begin() + static_cast<std::ptrdiff_t>(y) * width + part.x, part.width, 0.0F);
    }
    backs_.reserve(nearness_.size());
}

ShadowMap::Corner ShadowMap::corner_at(const glm::dvec3& place, double metres) const {
    const double guard = guard_px * place.z;
    if (!(place.z >= min_z_m) || !(std::fabs(place.x) < guard) || !(std::fabs(place.y) < guard)) {
        return {.column = needs_cutting};
    }
    const double per_z = 1.0 / place.z;
    Corner corner;
    constexpr double shift = 0x1p23; // so that the conversion, towards zero, rounds to the nearest
    constexpr auto whole_shift = static_cast<std::int32_t>(shift);
    const double scale = parts_of_pixel * per_z;
    corner.x = static_cast<std::int32_t>(place.x * scale + (shift + 0.5)) - whole_shift;
    corner.y = static_cast<std::int32_t>(place.y * scale + (shift + 0.5)) - whole_shift;
    corner.nearness = static_cast<float>(metres * per_z);
    corner.column = first_pixel(corner.x, width_);
    corner.row = first_pixel(corner.y, height_);
    return corner;
}

void ShadowMap::place_corners(const View& view, std::span<const glm::vec3> positions) {
    corners_.resize(positions.size());
    const bool is_cut = view.casting != glm::dvec4(0.0);
    for (std::size_t k = 0; k < positions.size(); ++k) {
        const glm::dvec3 place = view.picture_from_model * glm::dvec4(positions[k], 1.0);
        corners_[k] = is_cut && !(glm::dot(view.casting, glm::dvec4(place, 1.0)) >= 0.0)
                          ? Corner{.column = needs_cutting}
                          : corner_at(place, view.metres);
    }
}

void ShadowMap::draw(const View& view, std::span<const glm::vec3> positions,
                     std::span<const std::uint32_t> indices) {
    place_corners(view, positions);
    // A front turns anticlockwise, unless the view mirrors.
    const bool mirrored = glm::determinant(glm::dmat3(view.picture_from_model)) < 0.0;
    float* const turned_away = view.from_within ? backs().data() : nearness_.data();
    clockwise_ = mirrored ? nearness_.data() : turned_away;
    others_ = mirrored ? turned_away : nearness_.data();
    for (std::size_t k = 0; k + 2 < indices.size(); k += 3) {
        const Corner& a = corners_[indices[k]];
        const Corner& b = corners_[indices[k + 1]];
        const Corner& c = corners_[indices[k + 2]];
        if (a.column == needs_cutting || b.column == needs_cutting || c.column == needs_cutting) {
            const auto place = [&](std::size_t corner) {
                return view.picture_from_model * glm::dvec4(positions[indices[corner]], 1.0);
            };
            draw_cut(view, place(k), place(k + 1), place(k + 2));
        } else if (((a.column ^ b.column) | (a.column ^ c.column)) != 0 &&
                   ((a.row ^ b.row) | (a.row ^ c.row)) != 0) {
            draw_triangle(a, b, c);
        }
    }
}

std::span<float> ShadowMap::backs() {
    if (!has_backs_) {
        backs_.assign(nearness_.size(), 0.0F);
        has_backs_ = true;
    }
    return backs_;
}

void ShadowMap::end(double slack) {
    max_share_ = static_cast<float>(slack);
    const auto nearer = static_cast<float>(1.0 + slack);
    for (std::size_t k = 0; has_backs_ && k < nearness_.size(); ++k) {
        nearness_[k] = backs_[k] > nearer * nearness_[k] ? dark_nearness : nearness_[k];
    }
}

void ShadowMap::find_farthest() {
    farthest_.resize(nearness_.size());
    const float max_share = max_share_;
    for (int y = part_.y; y + 1 < part_.y + part_.height; ++y) {
        const float* const row = nearness_.data() + static_cast<std::ptrdiff_t>(y) * width_;
        const float* const below = row + width_;
        Farthest* const out = farthest_.data() + static_cast<std::ptrdiff_t>(y) * width_;
        for (int x = part_.x; x + 1 < part_.x + part_.width; ++x) {
            out[x] = farthest_of(row[x], row[x + 1], below[x], below[x + 1], max_share);
        }
    }
}

void ShadowMap::draw_triangle(const Corner& a, const Corner& b, const Corner& c, bool clockwise) {
    const std::int64_t ab_x = std::int64_t{b.x} - a.x;
    const std::int64_t ab_y = std::int64_t{b.y} - a.y;
    const std::int64_t ac_x = std::int64_t{c.x} - a.x;
    const std::int64_t ac_y = std::int64_t{c.y} - a.y;
    const std::int64_t area = ab_x * ac_y - ac_x * ab_y;
    if (area == 0) {
        return;
    }
    if (area < 0) {
        draw_triangle(a, c, b, false);
        return;
    }
    // A middle on the right or lower border of the corners' box belongs to a neighbour.
    const int left = std::min({a.column, b.column, c.column});
    const int right = std::max({a.column, b.column, c.column}) - 1;
    const int top = std::min({a.row, b.row, c.row});
    const int bottom = std::max({a.row, b.row, c.row}) - 1;
    const std::int64_t x0 = std::int64_t{left} * parts_of_pixel + parts_of_pixel / 2;
    const std::int64_t y0 = std::int64_t{top} * parts_of_pixel + parts_of_pixel / 2;
    Edge ab(a.x, a.y, b.x, b.y, x0, y0);
    Edge bc(b.x, b.y, c.x, c.y, x0, y0);
    Edge ca(c.x, c.y, a.x, a.y, x0, y0);
    // The plane through the corners; rounding must not take a steep triangle's pixel beyond them.
    const auto near_a = static_cast<double>(a.nearness);
    const double rise_b = static_cast<double>(b.nearness) - near_a;
    const double rise_c = static_cast<double>(c.nearness) - near_a;
    const auto low = static_cast<float>(near_a + std::min({0.0, rise_b, rise_c}));
    const auto high = static_cast<float>(near_a + std::max({0.0, rise_b, rise_c}));
    const double per_area = parts_of_pixel / static_cast<double>(area);
    const double per_x = per_area * (rise_b * static_cast<double>(ac_y) - rise_c * static_cast<double>(ab_y));
    const double per_y = per_area * (rise_c * static_cast<double>(ab_x) - rise_b * static_cast<double>(ac_x));
    double at = near_a + (per_x * static_cast<double>(x0 - a.x) + per_y * static_cast<double>(y0 - a.y)) /
                             parts_of_pixel;
    float* row = (clockwise ? clockwise_ : others_) + static_cast<std::ptrdiff_t>(top) * width_ + left;
    for (int y = top; y <= bottom; ++y, row += width_, at += per_y) {
        int first = 0;
        int last = right - left;
        narrow(ab.at, ab.per_x, first, last);
        narrow(bc.at, bc.per_x, first, last);
        narrow(ca.at, ca.per_x, first, last);
        ab.at += ab.per_y;
        bc.at += bc.per_y;
        ca.at += ca.per_y;
        const auto start = static_cast<float>(at);
        const auto step = static_cast<float>(per_x);
        for (int x = first; x <= last; ++x) {
            const float nearness = std::clamp(start + static_cast<float>(x) * step, low, high);
            row[x] = std::max(row[x], nearness);
        }
    }
}

void ShadowMap::draw_cut(const View& view, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    if (!std::isfinite(a.x + a.y + a.z + b.x + b.y + b.z + c.x + c.y + c.z)) {
        return;
    }
    constexpr std::size_t max_corners = 9;
    geometry::CutPolygon<max_corners> polygon({a, b, c});
    polygon.cut([&](const glm::dvec3& place) { return glm::dot(view.casting, glm::dvec4(place, 1.0)); });
    polygon.cut([](const glm::dvec3& place) { return place.z - min_z_m; });
    constexpr double guard = guard_px - 1.0;
    for (const glm::dvec3& plane : {glm::dvec3(1.0, 0.0, guard), glm::dvec3(-1.0, 0.0, guard),
                                    glm::dvec3(0.0, 1.0, guard), glm::dvec3(0.0, -1.0, guard)}) {
        polygon.cut([&](const glm::dvec3& place) { return glm::dot(plane, place); });
    }
    std::array<Corner, max_corners> corners{};
    const std::span<const glm::dvec3> places = polygon.corners();
    for (std::size_t k = 0; k < places.size(); ++k) {
        corners[k] = corner_at({places[k].x, places[k].y, std::max(places[k].z, min_z_m)}, view.metres);
        if (corners[k].column == needs_cutting) {
            return; // not reached: the planes lie within the guard
        }
    }
    for (std::size_t k = 2; k < places.size(); ++k) {
        draw_triangle(corners[0], corners[k - 1], corners[k]);
    }
}

} // namespace frustumscreen::torch

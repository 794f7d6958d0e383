#include "app/ldi/triangle_rasterizer.h"

#include "app/ldi/surface_colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace frustumscreen::ldi {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
/// With ten bits behind the point a corner has 23 bits, so differences of corners are exact in 32 bits.
constexpr double guard_px = 8191.0;
constexpr std::uint16_t needs_cutting =
    0x8000; ///< a column: the corner is beyond the guard, or behind the eye

/// Rounds to 1/1024, the last bit of doubles of the added size.
float rounded(double pixels) {
    constexpr double size = 0x1.8p42;
    return static_cast<float>(pixels + size - size);
}
/// The first pixel of 0 to `count` whose middle is not before `place`.
int first_pixel(float place, int count) {
    const float from_middle = std::clamp(place - 0.5F, -1.0F, static_cast<float>(count));
    const int toward_zero = static_cast<int>(from_middle);
    return std::max(0, toward_zero + (from_middle > static_cast<float>(toward_zero) ? 1 : 0));
}

/// Homogeneous places of a triangle that planes cut; each plane adds at most one corner.
struct Polygon {
    std::array<glm::dvec3, 8> places{};
    std::size_t count = 0;
};

/// The place where a plane cuts a line, by the signed distances of the line's ends.
glm::dvec3 between(const glm::dvec3& inside, const glm::dvec3& outside, double inside_by, double outside_by) {
    return inside + inside_by / (inside_by - outside_by) * (outside - inside);
}

/// The part whose product with `plane` is at least `least`. The common edge of two triangles is cut in the same places.
Polygon cut(const Polygon& polygon, const glm::dvec3& plane, double least) {
    Polygon kept;
    for (std::size_t k = 0; k < polygon.count; ++k) {
        const glm::dvec3& from = polygon.places[k];
        const glm::dvec3& to = polygon.places[(k + 1) % polygon.count];
        const double from_side = glm::dot(plane, from) - least;
        const double to_side = glm::dot(plane, to) - least;
        if (from_side >= 0.0) {
            kept.places[kept.count++] = from;
        }
        if (from_side >= 0.0 && to_side < 0.0) {
            kept.places[kept.count++] = between(from, to, from_side, to_side);
        } else if (from_side < 0.0 &&
                   to_side >= 0.0) { // from the inside too, as for the triangle on the other side of the edge
            kept.places[kept.count++] = between(to, from, to_side, from_side);
        }
    }
    return kept;
}

/// True if the triangle lies beyond one side of the picture, or behind the eye.
bool is_beside(const Polygon& triangle, const PictureCamera& camera) {
    bool left = true;
    bool right = true;
    bool above = true;
    bool below = true;
    bool behind = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3& place = triangle.places[k];
        left = left && place.x < 0.0;
        right = right && place.x > camera.width * place.z;
        above = above && place.y < 0.0;
        below = below && place.y > camera.height * place.z;
        behind = behind && place.z < min_farness;
    }
    return left || right || above || below || behind;
}

} // namespace

struct TriangleRasterizer::Target {
    const TriangleWorld& world;
    const PictureMap& map;
    DepthPicture& picture;
};

void TriangleRasterizer::place_corners(const TriangleWorld& world, const PictureMap& map,
                                       const PictureCamera& camera) {
    corners_.resize(world.positions.size());
    cells_.resize(world.positions.size());
    for (std::size_t k = 0; k < corners_.size(); ++k) {
        const glm::dvec3 place = map.homogeneous(glm::dvec3(world.positions[k]));
        const double guard = guard_px * place.z;
        if (place.z >= min_farness && std::fabs(place.x) < guard && std::fabs(place.y) < guard) {
            const double nearness = 1.0 / place.z;
            const double x = place.x * nearness;
            const double y = place.y * nearness;
            const Corner corner{rounded(x), rounded(y), static_cast<float>(nearness)};
            corners_[k] = corner;
            cells_[k] = {static_cast<std::uint16_t>(first_pixel(corner.x, camera.width)),
                         static_cast<std::uint16_t>(first_pixel(corner.y, camera.height))};
        } else {
            cells_[k] = {needs_cutting, 0};
        }
    }
}

void TriangleRasterizer::draw_triangle(const Target& target, const Corner& a, const Corner& b,
                                       const Corner& c, std::uint32_t triangle) {
    const PictureCamera& camera = target.picture.camera;
    // A middle on the right or lower border of the corners' box is not covered.
    const int left = first_pixel(std::min({a.x, b.x, c.x}), camera.width);
    const int right = first_pixel(std::max({a.x, b.x, c.x}), camera.width) - 1;
    const int top = first_pixel(std::min({a.y, b.y, c.y}), camera.height);
    const int bottom = first_pixel(std::max({a.y, b.y, c.y}), camera.height) - 1;
    if (left > right || top > bottom) {
        return;
    }
    struct Edge {
        double per_x, per_y, at;
        Edge(const Corner& from, const Corner& to, double sign, double x, double y)
            : per_x(sign * static_cast<double>(from.y - to.y)),
              per_y(sign * static_cast<double>(to.x - from.x)),
              at(per_x * (x - static_cast<double>(from.x)) + per_y * (y - static_cast<double>(from.y))) {}
        /// A place on the edge belongs to one of the two triangles.
        [[nodiscard]] double lowest() const {
            return per_x > 0.0 || (per_x == 0.0 && per_y > 0.0) ? 0.0 : 0x1p-22;
        }
    };
    const double area = static_cast<double>(b.x - a.x) * static_cast<double>(c.y - a.y) -
                        static_cast<double>(c.x - a.x) * static_cast<double>(b.y - a.y);
    if (area == 0.0 ||
        (target.world.one_sided && area > 0.0)) { // rows go down: a back runs the other way round
        return;
    }
    const double sign = area > 0.0 ? 1.0 : -1.0;
    const double x0 = left + 0.5;
    const double y0 = top + 0.5;
    const Edge bc(b, c, sign, x0, y0);
    const Edge ca(c, a, sign, x0, y0);
    const Edge ab(a, b, sign, x0, y0);
    const double bc_lowest = bc.lowest();
    const double ca_lowest = ca.lowest();
    const double ab_lowest = ab.lowest();
    const double scale = sign / area;
    for (int y = top; y <= bottom; ++y) {
        const double down = y - top;
        for (int x = left; x <= right; ++x) {
            const double across = x - left;
            const double of_a = bc.at + across * bc.per_x + down * bc.per_y;
            const double of_b = ca.at + across * ca.per_x + down * ca.per_y;
            const double of_c = ab.at + across * ab.per_x + down * ab.per_y;
            if (of_a < bc_lowest || of_b < ca_lowest || of_c < ab_lowest) {
                continue;
            }
            const auto nearness = static_cast<float>(scale * (of_a * static_cast<double>(a.nearness) +
                                                              of_b * static_cast<double>(b.nearness) +
                                                              of_c * static_cast<double>(c.nearness)));
            const std::size_t pixel = target.picture.at(x, y);
            if (nearness > target.picture.nearness[pixel] &&
                (!target.world.cut_out || is_solid(surface_colour(target.world, triangle, target.map.eye(),
                                                                  target.map.ray(x + 0.5, y + 0.5))))) {
                target.picture.nearness[pixel] = nearness;
                seen_[pixel] = triangle;
            }
        }
    }
}

void TriangleRasterizer::draw_cut(const Target& target, std::uint32_t triangle) {
    Polygon polygon;
    polygon.count = 3;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t index = target.world.indices[3 * std::size_t{triangle} + k];
        if (index >= target.world.positions.size()) {
            return;
        }
        polygon.places[k] = target.map.homogeneous(glm::dvec3(target.world.positions[index]));
        if (!std::isfinite(polygon.places[k].x + polygon.places[k].y + polygon.places[k].z)) {
            return;
        }
    }
    if (is_beside(polygon, target.picture.camera)) {
        return;
    }
    constexpr double guard = guard_px - 1.0;
    polygon = cut(polygon, {0.0, 0.0, 1.0}, min_farness);
    for (const glm::dvec3& plane : {glm::dvec3(1.0, 0.0, guard), glm::dvec3(-1.0, 0.0, guard),
                                    glm::dvec3(0.0, 1.0, guard), glm::dvec3(0.0, -1.0, guard)}) {
        polygon = cut(polygon, plane, 0.0);
    }
    std::array<Corner, 8> corners{};
    for (std::size_t k = 0; k < polygon.count; ++k) {
        const double nearness = 1.0 / std::max(min_farness, polygon.places[k].z);
        corners[k] = {rounded(std::clamp(polygon.places[k].x * nearness, -guard, guard)),
                      rounded(std::clamp(polygon.places[k].y * nearness, -guard, guard)),
                      static_cast<float>(nearness)};
    }
    for (std::size_t k = 2; k < polygon.count; ++k) {
        draw_triangle(target, corners[0], corners[k - 1], corners[k], triangle);
    }
}

void TriangleRasterizer::find_colours(const Target& target) const {
    // Pixels ask for triangles in any order, so their data is prefetched some pixels ahead.
    constexpr std::size_t indices_ahead = 24;
    constexpr std::size_t corners_ahead = 12;
    const TriangleWorld& world = target.world;
    const auto indices_of = [&](std::size_t pixel) {
        return pixel < seen_.size() && seen_[pixel] != none ? &world.indices[3 * std::size_t{seen_[pixel]}]
                                                            : nullptr;
    };
    std::size_t pixel = 0;
    for (int y = 0; y < target.picture.camera.height; ++y) {
        for (int x = 0; x < target.picture.camera.width; ++x, ++pixel) {
            if (const std::uint32_t* far = indices_of(pixel + indices_ahead)) {
                __builtin_prefetch(far);
            }
            if (const std::uint32_t* near = indices_of(pixel + corners_ahead)) {
                for (std::size_t k = 0; k < 3; ++k) {
                    __builtin_prefetch(&world.positions[near[k]]);
                    if (!world.colours.empty()) {
                        __builtin_prefetch(world.colours.data() + near[k]);
                    } else if (!world.texture_places.empty()) {
                        __builtin_prefetch(world.texture_places.data() + near[k]);
                    }
                }
            }
            if (seen_[pixel] != none) {
                const glm::u8vec4 colour =
                    surface_colour(world, seen_[pixel], target.map.eye(), target.map.ray(x + 0.5, y + 0.5));
                target.picture.colours[pixel] = {colour.r, colour.g, colour.b, 255};
            }
        }
    }
}

void TriangleRasterizer::draw_triangles(const Target& target, std::size_t first, std::size_t end) {
    constexpr std::size_t triangles_ahead = 24;
    const TriangleWorld& world = target.world;
    const std::size_t count = world.triangle_count();
    for (std::size_t k = first; k < end; ++k) {
        const std::uint32_t* indices = &world.indices[3 * k];
        if (k + triangles_ahead < count) { // the indices of an unsorted mesh may point anywhere
            for (std::size_t j = 0; j < 3; ++j) {
                __builtin_prefetch(cells_.data() + indices[3 * triangles_ahead + j]);
            }
        }
        if (std::max({indices[0], indices[1], indices[2]}) >= cells_.size()) {
            continue;
        }
        const Cell a = cells_[indices[0]];
        const Cell b = cells_[indices[1]];
        const Cell c = cells_[indices[2]];
        if (((a.column | b.column | c.column) & needs_cutting) != 0) {
            draw_cut(target, static_cast<std::uint32_t>(k));
        } else if (((a.column ^ b.column) | (a.column ^ c.column)) != 0 &&
                   ((a.row ^ b.row) | (a.row ^ c.row)) != 0) {
            draw_triangle(target, corners_[indices[0]], corners_[indices[1]], corners_[indices[2]],
                          static_cast<std::uint32_t>(k));
        }
    }
}

void TriangleRasterizer::draw(const TriangleWorld& world, DepthPicture& picture) {
    const PictureMap map(picture.camera);
    if (!map.usable()) {
        return;
    }
    const Target target{world, map, picture};
    begin_depths(world, picture);
    draw_triangles(target, 0, world.triangle_count());
    find_colours(target);
}

void TriangleRasterizer::begin_depths(const TriangleWorld& world, const DepthPicture& picture) {
    const PictureMap map(picture.camera);
    seen_.assign(picture.camera.pixel_count(), none);
    place_corners(world, map, picture.camera);
}

void TriangleRasterizer::draw_depths(const TriangleWorld& world, DepthPicture& picture, std::size_t first,
                                     std::size_t count) {
    const PictureMap map(picture.camera);
    if (map.usable()) {
        draw_triangles({world, map, picture}, first, std::min(world.triangle_count(), first + count));
    }
}

void TriangleRasterizer::colour_depths(const TriangleWorld& world, DepthPicture& picture) const {
    if (const PictureMap map(picture.camera); map.usable()) {
        find_colours({world, map, picture});
    }
}

std::uint64_t TriangleRasterizer::bytes() const {
    return corners_.capacity() * sizeof(Corner) + cells_.capacity() * sizeof(Cell) +
           seen_.capacity() * sizeof(std::uint32_t);
}

} // namespace frustumscreen::ldi

#include "app/scene/pinned_view.h"

#include "app/relief/block_relief.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace frustumscreen::scene {

namespace {

/// The share of the window's half width, as the eye sees it, that a world fills.
constexpr double filled_share = 0.9;
/// The world's nearest point lies this far below the table, in the window's widths.
constexpr double gap_share = 1e-3;

/// Calls `take(low, high)` for boxes around all of a level, in the frame of its pack's box.
template <typename Take> void for_each_extent(const PlacedLevel& level, const Take& take) {
    if (level.triangles) {
        for (const LevelTriangles::Extent& extent : level.triangles->extents) {
            take(glm::dmat4(1.0), glm::dvec3(extent.low), glm::dvec3(extent.high));
        }
        return;
    }
    const relief::BlockRelief& relief = *level.relief;
    for (std::size_t grid = 0; grid < relief.grids.size(); ++grid) {
        const glm::dmat4 from_grid = relief::box_from_grid(relief.grids[grid], double{relief.texel_box});
        for (std::size_t k = relief.first_block[grid]; k < relief.first_block[grid + 1]; ++k) {
            const relief::ReliefBlock& block = relief.blocks[k];
            const glm::dvec4 cells(block.cells[0], block.cells[1], block.cells[2], block.cells[3]);
            const glm::dvec2 u = double{block.w_u} * glm::dvec2(cells[0], cells[1]);
            const glm::dvec2 v = double{block.w_v} * glm::dvec2(cells[2], cells[3]);
            const double w = block.w0;
            take(from_grid,
                 glm::dvec3(block.u0 + cells[0], block.v0 + cells[2],
                            w + std::min(u[0], u[1]) + std::min(v[0], v[1]) + double{block.residual_low}),
                 glm::dvec3(block.u0 + cells[1], block.v0 + cells[3],
                            w + std::max(u[0], u[1]) + std::max(v[0], v[1]) + double{block.residual_high()}));
        }
    }
}

/// Calls `take(point)` for points around all of the parts, in the frame that these are placed in.
template <typename Take> void for_each_point(std::span<const Part> parts, const Take& take) {
    for (const Part& part : parts) {
        if (part.level.is_empty()) {
            continue;
        }
        const glm::dmat4 from_box = part.level.prop_from_box();
        for_each_extent(part.level, [&](const glm::dmat4& box_from_extent, const glm::dvec3& low,
                                        const glm::dvec3& high) {
            const glm::dmat4 from_extent = from_box * box_from_extent;
            for (unsigned k = 0; k < 8; ++k) {
                const glm::dvec3 share(k & 1U, k >> 1U & 1U, k >> 2U & 1U);
                take(glm::dvec3(from_extent * glm::dvec4(glm::mix(low, high, share), 1.0)));
            }
        });
    }
}

/// Turns a direction into another one: first about the vertical, then about the horizontal axis across it. A vertical direction
/// has no azimuth; then there is no turn about the vertical.
glm::dquat level_turn(const glm::dvec3& from, const glm::dvec3& to) {
    constexpr double vertical = 1e-9;
    const auto azimuth = [](const glm::dvec3& d) { return std::atan2(d.y, d.x); };
    const auto across = [](const glm::dvec3& d) { return std::hypot(d.x, d.y); };
    const bool upright = across(from) <= vertical || across(to) <= vertical;
    const double yaw = upright ? 0.0 : azimuth(to) - azimuth(from);
    const double towards = across(to) > vertical ? azimuth(to) : azimuth(from);
    const glm::dvec3 axis(-std::sin(towards), std::cos(towards), 0.0); // to the left of the direction
    const double pitch = std::atan2(from.z, across(from)) - std::atan2(to.z, across(to));
    return glm::angleAxis(pitch, axis) * glm::angleAxis(yaw, glm::dvec3(0.0, 0.0, 1.0));
}

/// The smallest sine between a ray from the eye and the planes through the eye and the surface's edges.
double clearance(const geometry::PropShape& surface, const glm::dvec3& eye, const glm::dvec3& ray) {
    double least = std::numeric_limits<double>::infinity();
    const geometry::PropFace& face = surface.faces.front();
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
        const glm::dvec3 a = face.corners[k] - eye;
        const glm::dvec3 b = face.corners[face.corners.next(k)] - eye;
        least = std::min(least, glm::dot(glm::normalize(glm::cross(b, a)), ray));
    }
    return least;
}

/// The world is turned about the eye, so that its middle lies on a ray u, made `scale` times as large about its middle, and
/// moved along u. With the height e of the eye, the distance D of the middle and the radius r = scale * R:
///     it touches the table from below:          D (-u.z) = e + r + gap
///     it fills its share q of the clearance c:  r = q c D
void put_behind(const PinRequest& request, double clear, const glm::dvec3& ray, const glm::dquat& turn,
                PinnedView& view) {
    const double gap = gap_share * std::min(request.place.width_m, request.place.depth_m);
    const double down = -ray.z;
    const double filled = filled_share * clear / down; // r = filled * (e + r + gap)
    const double radius = request.zoom * filled * (request.eye_m.z + gap) / (1.0 - filled);
    const double away = (request.eye_m.z + gap + radius) / down;
    view.scale = radius / request.world.radius;
    const glm::dquat table_from_world = turn * request.table_from_prop.rotation * request.turn;
    const geometry::RigidTransform table_from_middle{table_from_world, request.eye_m + away * ray};
    view.window_from_prop = (view.table_from_window.inverse() * table_from_middle).matrix() *
                            glm::scale(glm::dmat4(1.0), glm::dvec3(view.scale)) *
                            glm::translate(glm::dmat4(1.0), -request.world.middle);
}

/// Into a surface that may have been used before.
void put_surface(double width_m, double depth_m, geometry::PropShape& surface) {
    surface.faces.resize(1);
    geometry::PropFace& face = surface.faces.front();
    face = {};
    face.name = "window";
    surface.corners.clear();
    for (const glm::dvec2& corner :
         {glm::dvec2(-1.0, -1.0), glm::dvec2(1.0, -1.0), glm::dvec2(1.0, 1.0), glm::dvec2(-1.0, 1.0)}) {
        face.corners.push_back({0.5 * corner * glm::dvec2(width_m, depth_m), 0.0});
        surface.corners.push_back(face.corners[face.corners.size() - 1]);
    }
    surface.bounds.assign(1, face.plane);
}

bool is_finite(const glm::dmat4& matrix) {
    double sum = 0.0;
    for (int column = 0; column < 4; ++column) {
        sum += glm::dot(matrix[column], glm::dvec4(1.0));
    }
    return std::isfinite(sum);
}

} // namespace

std::optional<WorldBall> ball_around(std::span<const Part> parts) {
    const double infinity = std::numeric_limits<double>::infinity();
    geometry::Box box{glm::dvec3(infinity), glm::dvec3(-infinity)};
    for_each_point(parts, [&](const glm::dvec3& point) {
        box = {glm::min(box.low, point), glm::max(box.high, point)};
    });
    if (!(box.low.x <= box.high.x)) {
        return std::nullopt;
    }
    WorldBall ball{.middle = 0.5 * (box.low + box.high), .radius = 0.0};
    double radius2 = 0.0;
    for_each_point(parts, [&](const glm::dvec3& point) {
        const glm::dvec3 away = point - ball.middle;
        radius2 = std::max(radius2, glm::dot(away, away));
    });
    ball.radius = std::sqrt(radius2);
    return ball;
}

bool contains(const WorldBall& ball, std::span<const Part> parts) {
    bool contains = true;
    for_each_point(parts, [&](const glm::dvec3& point) {
        const glm::dvec3 away = point - ball.middle;
        contains = contains && glm::dot(away, away) <= ball.radius * ball.radius;
    });
    return contains;
}

WorldBall united(const WorldBall& a, const WorldBall& b) {
    const glm::dvec3 way = b.middle - a.middle;
    const double apart = glm::length(way);
    if (apart + b.radius <= a.radius) {
        return a;
    }
    if (apart + a.radius <= b.radius) {
        return b;
    }
    const double radius = 0.5 * (apart + a.radius + b.radius);
    return {a.middle + way * ((radius - a.radius) / apart), radius};
}

geometry::RigidTransform table_from_window(const WindowPlace& place) {
    return {glm::angleAxis(place.yaw_rad, glm::dvec3(0.0, 0.0, 1.0)), {place.middle_m, 0.0}};
}

geometry::PropShape window_surface(double width_m, double depth_m) {
    geometry::PropShape surface;
    put_surface(width_m, depth_m, surface);
    return surface;
}

std::optional<PinnedView> pin_view(const PinRequest& request) {
    PinnedView view;
    return pin_view(request, view) ? std::optional(std::move(view)) : std::nullopt;
}

bool pin_view(const PinRequest& request, PinnedView& view) {
    const WindowPlace& place = request.place;
    const glm::dvec3 middle(place.middle_m, 0.0);
    const glm::dvec3 to_prop = request.table_from_prop.point(request.prop_middle) - request.eye_m;
    const glm::dvec3 to_world = request.table_from_prop.point(request.world.middle) - request.eye_m;
    put_surface(place.width_m, place.depth_m, view.surface);
    view.table_from_window = table_from_window(place);
    if (!(request.eye_m.z > 0.0) || !(glm::length(to_prop) > 0.0) || !(glm::length(to_world) > 0.0) ||
        !(request.world.radius > 0.0) || !(request.zoom > 0.0)) {
        return false;
    }
    const glm::dquat turn = level_turn(to_prop, middle - request.eye_m);
    const glm::dvec3 eye = view.table_from_window.inverse().point(request.eye_m);
    // A world beside the prop's middle may lie beside the window; then it moves into the window's middle.
    glm::dvec3 ray = glm::normalize(turn * to_world);
    const auto clearance_of = [&](const glm::dvec3& in_table) {
        return clearance(view.surface, eye, view.table_from_window.inverse().direction(in_table));
    };
    const glm::dvec3 straight = glm::normalize(middle - request.eye_m);
    if (constexpr double min_share = 0.5; !(clearance_of(ray) > min_share * clearance_of(straight))) {
        ray = straight;
    }
    put_behind(request, clearance_of(ray), ray, turn, view);
    return is_finite(view.window_from_prop) && view.scale > 0.0;
}

void move_behind(const glm::dmat4& window_from_prop, std::span<const Part> parts, std::vector<Part>& moved) {
    moved.assign(parts.begin(), parts.end());
    for (Part& part : moved) {
        part.level.prop_from_placed = window_from_prop * part.level.prop_from_placed;
        part.level.faces = ~std::uint32_t{0};
    }
}

PlacedTorch moved_behind(const PinnedView& view, const geometry::RigidTransform& table_from_window,
                         const PlacedTorch& torch) {
    const geometry::RigidTransform& prop_from_torch = torch.table_from_torch;
    const glm::dquat turn = glm::quat_cast(glm::dmat3(view.window_from_prop) / view.scale);
    PlacedTorch moved = torch;
    moved.table_from_torch =
        table_from_window *
        geometry::RigidTransform{
            turn * prop_from_torch.rotation,
            glm::dvec3(view.window_from_prop * glm::dvec4(prop_from_torch.translation, 1.0))};
    moved.beam.full_m *= view.scale;
    moved.beam.dark_m *= view.scale;
    moved.scale *= view.scale;
    return moved;
}

} // namespace frustumscreen::scene

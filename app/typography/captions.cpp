#include "app/typography/captions.h"

#include "app/geometry/planar_hull.h"
#include "app/geometry/time_curves.h"
#include "app/typography/visitor_side.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace frustumscreen::typography {

namespace {

constexpr double comfortable_m = 0.035; ///< preferred distance from the shadow
constexpr double min_m = 0.02;          ///< no place is chosen closer than this
constexpr double near_m = 0.015;        ///< closer than this, the caption moves
constexpr double dimming_m = 0.012;     ///< closer than this, the caption dims; it is dark at 0
constexpr double grid_m = 0.01;
constexpr double beside_m = 0.008; ///< between a caption and other things on the table
constexpr Nanoseconds fade = std::chrono::milliseconds(250);
constexpr Nanoseconds between_searches = std::chrono::milliseconds(200);

/// Costs, in metres of distance from the preferred place.
constexpr double cost_of_being_hidden = 1.0;
constexpr double cost_of_later_shape = 0.15;
constexpr double cost_of_each_metre_too_close = 4.0;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// As many as two polygons have.
constexpr std::size_t max_hull_points = 2 * std::tuple_size_v<decltype(TablePolygon::points)>;

TablePolygon hull_of(std::span<glm::dvec2> points) {
    std::array<glm::dvec2, max_hull_points + 1> chain{};
    const std::span<const glm::dvec2> hull = geometry::planar_hull(points, chain);
    TablePolygon polygon;
    polygon.count = std::min(hull.size(), polygon.points.size());
    std::copy_n(hull.begin(), polygon.count, polygon.points.begin());
    return polygon;
}

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double length2 = glm::dot(along, along);
    const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * along);
}

/// True if all of `b` is on the outer side of a line along one of `a`'s edges.
bool separated_by_edge_of(std::span<const glm::dvec2> a, std::span<const glm::dvec2> b) {
    for (std::size_t k = 0; k < a.size(); ++k) {
        const glm::dvec2 edge = a[(k + 1) % a.size()] - a[k];
        if (std::all_of(b.begin(), b.end(),
                        [&](const glm::dvec2& p) { return cross(edge, p - a[k]) < 0.0; })) {
            return true;
        }
    }
    return false;
}

double min_distance_to_edges(std::span<const glm::dvec2> points, std::span<const glm::dvec2> polygon) {
    double least = std::numeric_limits<double>::infinity();
    for (const glm::dvec2& point : points) {
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            least =
                std::min(least, distance_to_segment(point, polygon[k], polygon[(k + 1) % polygon.size()]));
        }
    }
    return least;
}

TablePolygon turned_polygon(TablePolygon polygon, int quarter_turns) {
    for (std::size_t k = 0; k < polygon.count; ++k) {
        polygon.points[k] = turned(polygon.points[k], quarter_turns);
    }
    return polygon;
}

} // namespace

std::array<glm::dvec2, 4> TableRectangle::corners() const {
    const glm::dvec2 half = size_m / 2.0;
    const auto corner = [&](double x, double y) { return centre_m + turned({x, y}, quarter_turns); };
    return {corner(-half.x, -half.y), corner(half.x, -half.y), corner(half.x, half.y),
            corner(-half.x, half.y)};
}

TablePolygon polygon_of(const TableRectangle& rectangle) {
    const std::array<glm::dvec2, 4> corners = rectangle.corners();
    return {{corners[0], corners[1], corners[2], corners[3]}, corners.size()};
}

std::optional<TablePolygon> hidden_by_prop(const geometry::PropShape& prop,
                                           const geometry::RigidTransform& table_from_prop,
                                           const glm::dvec3& from_m) {
    std::array<glm::dvec2, geometry::max_corners> points{};
    assert(prop.corners.size() <= points.size());
    std::size_t count = 0;
    for (const glm::dvec3& corner_in_prop : prop.corners) {
        const glm::dvec3 corner = table_from_prop.point(corner_in_prop);
        if (!(corner.z < 0.99 * from_m.z)) {
            return std::nullopt;
        }
        // Intersection with the table of the ray from `from_m` through the corner; a corner below the table
        // counts at its own position.
        const double t = corner.z > 0.0 ? from_m.z / (from_m.z - corner.z) : 1.0;
        points[count++] = glm::dvec2(from_m) + t * glm::dvec2(corner - from_m);
    }
    return hull_of(std::span(points).first(count));
}

TablePolygon hull_of(const TablePolygon& polygon, std::span<const glm::dvec2> points) {
    std::array<glm::dvec2, max_hull_points> all{};
    assert(polygon.count + points.size() <= all.size());
    auto end = std::copy_n(polygon.points.begin(), polygon.count, all.begin());
    end = std::copy(points.begin(), points.end(), end);
    return hull_of(std::span(all.begin(), end));
}

double clearance(std::span<const glm::dvec2> a, std::span<const glm::dvec2> b) {
    if (a.empty() || b.empty()) {
        return std::numeric_limits<double>::infinity();
    }
    if (!separated_by_edge_of(a, b) && !separated_by_edge_of(b, a)) {
        return 0.0;
    }
    return std::min(min_distance_to_edges(a, b), min_distance_to_edges(b, a));
}

CaptionPlacer::CaptionPlacer(std::span<const glm::dvec2> picture_m, double border_m, Nanoseconds settles)
    : picture_m_(picture_m.begin(), picture_m.end()), border_m_(border_m), settles_(settles) {}

void CaptionPlacer::set_shapes(std::span<const glm::dvec2> sizes_m) {
    assert(sizes_m.size() <= max_shapes);
    size_count_ = std::min(sizes_m.size(), sizes_.size());
    std::copy_n(sizes_m.begin(), size_count_, sizes_.begin());
    place_.reset();
    leaves_.reset();
    next_look_.reset();
    comes_again_ = false;
}

void CaptionPlacer::set_obstacles(std::span<const TableRectangle> obstacles) {
    assert(obstacles.size() <= max_obstacles);
    obstacle_count_ = std::min(obstacles.size(), max_obstacles);
    std::copy_n(obstacles.begin(), obstacle_count_, obstacles_.begin());
}

/// All rectangles are axis-aligned.
bool CaptionPlacer::on_obstacle(const TableRectangle& rectangle, std::span<const TableRectangle> obstacles) {
    return std::any_of(obstacles.begin(), obstacles.end(), [&](const TableRectangle& obstacle) {
        const bool crossed = (rectangle.quarter_turns - obstacle.quarter_turns) % 2 != 0;
        const glm::dvec2 size = crossed ? glm::dvec2(obstacle.size_m.y, obstacle.size_m.x) : obstacle.size_m;
        const glm::dvec2 off = turned(rectangle.centre_m - obstacle.centre_m, -rectangle.quarter_turns);
        return glm::all(glm::lessThan(glm::abs(off), 0.5 * (rectangle.size_m + size) + beside_m));
    });
}

bool CaptionPlacer::inside_picture(const TableRectangle& rectangle) const {
    for (std::size_t k = 0; k < picture_m_.size(); ++k) {
        const glm::dvec2 edge = glm::normalize(picture_m_[(k + 1) % picture_m_.size()] - picture_m_[k]);
        for (const glm::dvec2& corner : rectangle.corners()) {
            if (cross(edge, corner - picture_m_[k]) < border_m_) {
                return false;
            }
        }
    }
    return picture_m_.size() >= 3;
}

std::optional<CaptionPlacer::Choice> CaptionPlacer::choose(const TablePolygon& shadow,
                                                           const TablePolygon* hidden,
                                                           const glm::dvec2& prop_m,
                                                           std::span<const TableRectangle> obstacles) const {
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    for (const glm::dvec2& corner : picture_m_) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    double front = prop_m.y;
    for (const glm::dvec2& corner : shadow.corners()) {
        front = std::min(front, corner.y);
    }
    std::optional<Choice> best;
    double best_cost = std::numeric_limits<double>::infinity();
    for (std::size_t shape = 0; shape < size_count_; ++shape) {
        const glm::dvec2 size = sizes_[shape];
        const glm::dvec2 first = low + border_m_ + size / 2.0;
        const glm::dvec2 last = high - border_m_ - size / 2.0;
        const glm::dvec2 wanted(prop_m.x, front - comfortable_m - size.y / 2.0);
        const glm::ivec2 steps(glm::floor((last - first) / grid_m + 1e-6));
        for (int k = 0; steps.x >= 0 && steps.y >= 0 && k < (steps.x + 1) * (steps.y + 1); ++k) {
            const glm::dvec2 offset(k % (steps.x + 1), k / (steps.x + 1));
            const TableRectangle rectangle{first + 1e-9 + offset * grid_m, size};
            double cost =
                glm::distance(rectangle.centre_m, wanted) + cost_of_later_shape * static_cast<double>(shape);
            if (cost >= best_cost || !inside_picture(rectangle) || on_obstacle(rectangle, obstacles)) {
                continue;
            }
            const double clear = clearance(rectangle.corners(), shadow.corners());
            if (clear < min_m) {
                continue;
            }
            cost += cost_of_each_metre_too_close * std::max(0.0, comfortable_m - clear);
            if (hidden != nullptr && clearance(rectangle.corners(), hidden->corners()) <= 0.0) {
                cost += cost_of_being_hidden;
            }
            if (cost < best_cost) {
                best_cost = cost;
                best = Choice{shape, rectangle};
            }
        }
    }
    return best;
}

void CaptionPlacer::turn_to(int quarter_turns) {
    for (glm::dvec2& corner : picture_m_) {
        corner = turned(corner, quarter_turns_ - quarter_turns);
    }
    quarter_turns_ = quarter_turns;
}

void CaptionPlacer::update(MonotonicTime now, const std::optional<TablePolygon>& shadow,
                           const std::optional<TablePolygon>& hidden, const glm::dvec2& prop_m,
                           int quarter_turns) {
    searched_in_vain_ = false;
    clearance_m_ = place_ && shadow ? clearance(place_->rectangle.corners(), shadow->corners()) : 0.0;
    if (!shadow || size_count_ == 0) {
        return;
    }
    const bool turns = place_ && place_->rectangle.quarter_turns != quarter_turns;
    const std::span<const TableRectangle> obstacles = std::span(obstacles_).first(obstacle_count_);
    if (place_ && !leaves_ && (turns || clearance_m_ < near_m || on_obstacle(place_->rectangle, obstacles))) {
        leaves_ = now;
        comes_again_ = true;
    }
    const bool gone = !place_ || (leaves_ && (now - *leaves_ >= fade || now < appears_));
    if (!gone || (next_look_ && now < *next_look_)) {
        return;
    }
    turn_to(quarter_turns);
    const TablePolygon seen_hidden = hidden ? turned_polygon(*hidden, -quarter_turns) : TablePolygon{};
    std::array<TableRectangle, max_obstacles> seen_obstacles = obstacles_;
    for (TableRectangle& obstacle : seen_obstacles) {
        obstacle.centre_m = turned(obstacle.centre_m, -quarter_turns);
        obstacle.quarter_turns -= quarter_turns;
    }
    place_ = choose(turned_polygon(*shadow, -quarter_turns), hidden ? &seen_hidden : nullptr,
                    turned(prop_m, -quarter_turns), std::span(seen_obstacles).first(obstacle_count_));
    if (place_) {
        place_->rectangle.centre_m = turned(place_->rectangle.centre_m, quarter_turns);
        place_->rectangle.quarter_turns = quarter_turns;
    }
    leaves_.reset();
    appears_ = comes_again_ ? now + settles_ : now;
    next_look_.reset();
    if (place_) {
        clearance_m_ = clearance(place_->rectangle.corners(), shadow->corners());
    } else {
        searched_in_vain_ = true;
        next_look_ = now + between_searches;
    }
}

CaptionPlace CaptionPlacer::at(MonotonicTime now) const {
    if (!place_) {
        return {};
    }
    const double in = geometry::ease(to_seconds(now - appears_) / to_seconds(fade));
    const double out = leaves_ ? 1.0 - geometry::ease(to_seconds(now - *leaves_) / to_seconds(fade)) : 1.0;
    const double clear = geometry::ease(clearance_m_ / dimming_m);
    return {place_->shape, place_->rectangle, std::min({in, out, clear})};
}

} // namespace frustumscreen::typography

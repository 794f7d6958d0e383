#include "app/scene/room_culling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::scene {

namespace {

/// Products of doubles are off by far less.
constexpr double rounding = 1e-9;

/// a u + b v + c over pixels.
struct Affine {
    double a = 0.0, b = 0.0, c = 0.0;
    [[nodiscard]] Affine operator*(double factor) const { return {a * factor, b * factor, c * factor}; }
    [[nodiscard]] Affine operator-(const Affine& other) const {
        return {a - other.a, b - other.b, c - other.c};
    }
    [[nodiscard]] double least(const glm::dvec2& low, const glm::dvec2& high) const {
        return c + std::min(a * low.x, a * high.x) + std::min(b * low.y, b * high.y);
    }
};

/// A side of a solid box: along the ray through a pixel, one unit of depth nearer to or farther from the side's plane.
struct Side {
    Affine along;
    double before = 0.0; ///< of the eye, above the plane: positive if the side faces it
};

} // namespace

RoomCulling::RoomCulling(const FlatScreen& screen)
    : corner_m_(screen.surface.corners[3]), size_px_(screen.pinhole.width, screen.pinhole.height),
      columns_((screen.pinhole.width + tile_px - 1) / tile_px),
      rows_((screen.pinhole.height + tile_px - 1) / tile_px),
      nearness_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    const glm::dvec3 across = screen.surface.corners[2] - screen.surface.corners[3];
    const glm::dvec3 along = screen.surface.corners[0] - screen.surface.corners[3];
    right_ = glm::normalize(across);
    down_ = glm::normalize(along);
    into_ = -screen.surface.faces.front().plane.normal;
    pixels_per_m_ = size_px_ / glm::dvec2(glm::length(across), glm::length(along));
}

void RoomCulling::begin(const glm::dvec3& eye_m) {
    std::fill(nearness_.begin(), nearness_.end(), 0.0);
    eye_m_ = eye_m;
    before_m_ = glm::dot(corner_m_ - eye_m, into_);
    focal_px_ = before_m_ * pixels_per_m_;
    middle_px_ =
        pixels_per_m_ * glm::dvec2(glm::dot(eye_m - corner_m_, right_), glm::dot(eye_m - corner_m_, down_));
    const glm::dvec2 low = (-slack_px - middle_px_) / focal_px_;
    const glm::dvec2 high = (size_px_ + slack_px - middle_px_) / focal_px_;
    sides_ = {glm::normalize(right_ - low.x * into_), glm::normalize(high.x * into_ - right_),
              glm::normalize(down_ - low.y * into_), glm::normalize(high.y * into_ - down_)};
}

glm::dvec3 RoomCulling::from_eye(const glm::dvec3& point_m) const {
    const glm::dvec3 ray = point_m - eye_m_;
    const double depth = glm::dot(ray, into_);
    return {middle_px_ + focal_px_ * glm::dvec2(glm::dot(ray, right_), glm::dot(ray, down_)) / depth, depth};
}

bool RoomCulling::in_view(const glm::dvec3& centre_m, double radius_m) const {
    const glm::dvec3 ray = centre_m - eye_m_;
    const double reach = radius_m * (1.0 + rounding);
    return before_m_ > 0.0 && glm::dot(ray, into_) > -reach &&
           std::all_of(sides_.begin(), sides_.end(),
                       [&](const glm::dvec3& side) { return glm::dot(ray, side) >= -reach; });
}

bool RoomCulling::in_view(const BoxCorners& box_m) const {
    const auto some = [&](const glm::dvec3& side) {
        return std::any_of(box_m.begin(), box_m.end(), [&](const glm::dvec3& corner) {
            return glm::dot(corner - eye_m_, side) >= -rounding;
        });
    };
    return before_m_ > 0.0 && some(into_) && std::all_of(sides_.begin(), sides_.end(), some);
}

RoomCulling::Seen RoomCulling::seen(const BoxCorners& box_m) const {
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high = -low;
    Seen seen{.tiles = {0, columns_, 0, rows_}, .nearness = 0.0};
    for (const glm::dvec3& corner : box_m) {
        const glm::dvec3 at = from_eye(corner);
        if (!(at.z > 0.0)) {
            seen.nearness = std::numeric_limits<double>::infinity();
            return seen;
        }
        low = glm::min(low, glm::dvec2(at));
        high = glm::max(high, glm::dvec2(at));
        seen.nearness = std::max(seen.nearness, 1.0 / at.z);
    }
    const auto tile = [](double pixel, int most) {
        return static_cast<int>(std::clamp(std::floor(pixel / tile_px), 0.0, static_cast<double>(most)));
    };
    seen.tiles = {tile(low.x - slack_px, columns_), tile(high.x + slack_px + tile_px, columns_),
                  tile(low.y - slack_px, rows_), tile(high.y + slack_px + tile_px, rows_)};
    return seen;
}

/// Along the ray through a pixel the box begins at the farthest of the sides that face the eye, and ends at the nearest of the
/// others. Both are affine in the pixel as nearness, so a tile's corners decide about all of it.
void RoomCulling::add_solid(const BoxCorners& box_m) {
    if (!(before_m_ > 0.0)) {
        return;
    }
    const glm::dvec3 middle = 0.5 * (box_m[0] + box_m[7]);
    std::array<Side, 6> sides;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t edge = std::size_t{1} << axis;
        const glm::dvec3 one = box_m[(axis == 0 ? 2U : 1U)] - box_m[0];
        const glm::dvec3 other = box_m[(axis == 2 ? 2U : 4U)] - box_m[0];
        const glm::dvec3 normal = glm::cross(one, other);
        for (const std::size_t end : {std::size_t{0}, edge}) {
            const double out = glm::dot(normal, box_m[end] - middle) < 0.0 ? -1.0 : 1.0;
            const glm::dvec3 outward = out / glm::length(normal) * normal;
            const glm::dvec2 per_px(glm::dot(outward, right_) / focal_px_.x,
                                    glm::dot(outward, down_) / focal_px_.y);
            sides[2 * axis + (end == 0 ? 0 : 1)] = {
                {per_px.x, per_px.y, glm::dot(outward, into_) - glm::dot(per_px, middle_px_)},
                glm::dot(outward, eye_m_ - box_m[end])};
        }
    }
    const auto front_end =
        std::partition(sides.begin(), sides.end(), [](const Side& side) { return side.before > 0.0; });
    if (front_end == sides.begin()) {
        return; // the eye is inside
    }
    const TileRange tiles = seen(box_m).tiles;
    for (int row = tiles.top; row < tiles.bottom; ++row) {
        for (int column = tiles.left; column < tiles.right; ++column) {
            const glm::dvec2 low = static_cast<double>(tile_px) * glm::dvec2(column, row) - slack_px;
            const glm::dvec2 high = low + (tile_px + 2.0 * slack_px);
            double nearness = std::numeric_limits<double>::infinity();
            bool covered = true;
            for (auto front = sides.begin(); covered && front != front_end; ++front) {
                const double least = (front->along * (-1.0 / front->before)).least(low, high);
                nearness = std::min(nearness, least);
                covered = least > 0.0;
                for (auto back = front_end; covered && back != sides.end(); ++back) {
                    covered =
                        (front->along * back->before - back->along * front->before).least(low, high) >= 0.0;
                }
            }
            double& tile = nearness_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                                     static_cast<std::size_t>(column)];
            tile = covered ? std::max(tile, nearness * (1.0 - rounding)) : tile;
        }
    }
}

bool RoomCulling::is_hidden(const BoxCorners& box_m) const {
    if (!(before_m_ > 0.0)) {
        return true;
    }
    const Seen object = seen(box_m);
    const double nearness = object.nearness * (1.0 + rounding);
    for (int row = object.tiles.top; row < object.tiles.bottom; ++row) {
        for (int column = object.tiles.left; column < object.tiles.right; ++column) {
            if (!(nearness_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                            static_cast<std::size_t>(column)] > nearness)) {
                return false;
            }
        }
    }
    return true;
}

BoxCorners corners_of(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& to_from) {
    BoxCorners corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const glm::dvec3 corner((k & 1U) != 0 ? high.x : low.x, (k & 2U) != 0 ? high.y : low.y,
                                (k & 4U) != 0 ? high.z : low.z);
        corners[k] = glm::dvec3(to_from * glm::dvec4(corner, 1.0));
    }
    return corners;
}

} // namespace frustumscreen::scene

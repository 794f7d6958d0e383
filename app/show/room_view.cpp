#include "app/show/room_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::show {

namespace {

/// A solid that is smaller than a few tiles hides next to nothing.
constexpr double min_solid_rad = 0.05;
/// A driver draws nothing that is very near to the eye, so it hides nothing.
constexpr double min_solid_m = 0.25;

geometry::Box box_of(const glm::dvec3& size) {
    return {{-0.5 * size.x, -0.5 * size.y, 0.0}, {0.5 * size.x, 0.5 * size.y, size.z}};
}

} // namespace

RoomView::RoomView(const room::Room& room, const scene::FlatScreen& screen,
                   std::span<const glm::dvec3> box_sizes)
    : room_(room), box_sizes_(box_sizes.begin(), box_sizes.end()), culling_(screen),
      objects_(room.objects.size()) {
    seen_.reserve(objects_.size());
    in_view_.reserve(objects_.size());
    solids_.reserve(objects_.size());
}

void RoomView::place(std::size_t object, double seconds, std::span<const room::TakenPose> taken) {
    const room::Object& from = room_.objects[object];
    const glm::dvec3& box = box_sizes_[from.pack];
    PlacedObject& placed = objects_[object];
    const room::TakenPose pose = room::pose_of(object, from, seconds, taken);
    placed.table_from_object = pose.table_from_object.matrix();
    placed.size_m = pose.size_m;
    placed.opacity = pose.opacity;
    placed.middle_m = pose.table_from_object.point({0.0, 0.0, 0.5 * pose.size_m * box.z});
    placed.radius_m = 0.5 * pose.size_m * glm::length(box);
    placed.silhouette_m2 = 0.5 * pose.size_m * pose.size_m * (box.x * box.y + box.y * box.z + box.z * box.x);
}

scene::BoxCorners RoomView::corners_of(std::size_t object, const geometry::Box& box) const {
    const double size_m = objects_[object].size_m;
    return scene::corners_of(size_m * box.low, size_m * box.high, objects_[object].table_from_object);
}

void RoomView::look_with(const glm::dvec3& eye_m, const SolidOf& solid_of) {
    culling_.begin(eye_m);
    in_view_.clear();
    solids_.clear();
    for (std::uint32_t k = 0; k < objects_.size(); ++k) {
        PlacedObject& object = objects_[k];
        const std::size_t pack = room_.objects[k].pack;
        if (object.opacity <= 0.0 || !culling_.in_view(object.middle_m, object.radius_m) ||
            !culling_.in_view(corners_of(k, box_of(box_sizes_[pack])))) {
            continue;
        }
        object.is_in_view = true;
        in_view_.push_back(k);
        const std::optional<scene::BoxCorners>* const solid = solid_of(k);
        const double away_m = glm::distance(eye_m, object.middle_m);
        const double size_rad = 2.0 * object.radius_m / away_m;
        if (solid != nullptr && *solid && object.opacity >= 1.0 && away_m > object.radius_m + min_solid_m &&
            size_rad > min_solid_rad) {
            solids_.push_back({size_rad, {}});
            const double size_m = object.size_m;
            std::transform((*solid)->begin(), (*solid)->end(), solids_.back().corners.begin(),
                           [&](const glm::dvec3& corner) {
                               return glm::dvec3(object.table_from_object * glm::dvec4(size_m * corner, 1.0));
                           });
        }
    }
    const auto end = solids_.begin() + static_cast<std::ptrdiff_t>(std::min(solids_.size(), max_solids));
    std::partial_sort(solids_.begin(), end, solids_.end(),
                      [](const Solid& a, const Solid& b) { return a.size_rad > b.size_rad; });
    std::for_each(solids_.begin(), end, [&](const Solid& solid) { culling_.add_solid(solid.corners); });
    for (const std::uint32_t k : in_view_) {
        PlacedObject& object = objects_[k];
        object.is_seen = object.is_seen || solids_.empty() ||
                         !culling_.is_hidden(corners_of(k, box_of(box_sizes_[room_.objects[k].pack])));
    }
}

void RoomView::look(double seconds, std::span<const glm::dvec3> eyes_m,
                    std::span<const room::TakenPose> taken, const SolidOf& solid_of, bool culls) {
    for (std::size_t k = 0; k < objects_.size(); ++k) {
        PlacedObject& object = objects_[k];
        const bool in_place = std::none_of(taken.begin(), taken.end(),
                                           [k](const room::TakenPose& pose) { return pose.object == k; });
        if (!placed_ || !in_place || !object.in_place || room_.objects[k].motion.moves()) {
            place(k, seconds, taken);
        }
        object.in_place = in_place;
        object.away_m = std::numeric_limits<double>::infinity();
        for (const glm::dvec3& eye_m : eyes_m) {
            object.away_m = std::min(object.away_m, glm::distance(object.middle_m, eye_m) - object.radius_m);
        }
        object.away_m = std::max(object.away_m, 1e-3);
        object.is_in_view = object.is_seen = !culls && object.opacity > 0.0;
    }
    placed_ = true;
    if (culls) {
        for (const glm::dvec3& eye_m : eyes_m) {
            look_with(eye_m, solid_of);
        }
    }
    seen_.clear();
    for (std::uint32_t k = 0; k < objects_.size(); ++k) {
        if (objects_[k].is_seen) {
            seen_.push_back(k);
        }
    }
}

} // namespace frustumscreen::show

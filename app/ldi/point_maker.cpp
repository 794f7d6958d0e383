#include "app/ldi/point_maker.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::ldi {

namespace {

/// The patch's own cameras, then all of its neighbours': with those of the report alone (Hemisphere::cameras_of), an eye near a
/// border may look past an edge at a place that none of them sees.
std::vector<std::size_t> cameras_for(const Hemisphere& hemisphere, std::size_t patch) {
    std::vector<std::size_t> cameras;
    const auto add = [&](std::size_t of) {
        const auto own = hemisphere.own_cameras_of(of);
        cameras.insert(cameras.end(), own.begin(), own.end());
    };
    add(patch);
    for (const std::size_t neighbour : hemisphere.neighbours_of(patch)) {
        add(neighbour);
    }
    return cameras;
}

} // namespace

PointMaker::PointMaker(std::vector<TriangleWorld> worlds, const Hemisphere& hemisphere,
                       const CameraView& view, std::uint64_t max_bytes, std::uint64_t first_number)
    : worlds_(std::move(worlds)), order_(hemisphere), view_(view), max_bytes_(max_bytes),
      first_number_(first_number) {}

void PointMaker::look_from(const glm::dvec3& eye) {
    const std::optional<std::size_t> patch = order_.look_from(eye);
    if (patch && building_ && *patch != *building_ && patches_[*patch] == nullptr) {
        building_.reset();
        merger_.reset();
        seen_.reset();
    }
}

std::array<bool, patch_count> PointMaker::made() const {
    std::array<bool, patch_count> made{};
    std::transform(patches_.begin(), patches_.end(), made.begin(),
                   [](const auto& patch) { return patch != nullptr; });
    return made;
}

void PointMaker::begin_picture(std::size_t camera) {
    camera_ = camera;
    world_ = next_triangle_ = 0;
    drawing_ = std::make_unique<DepthPicture>();
    drawing_->begin(camera_at(view_, order_.hemisphere().cameras()[camera]));
}

void PointMaker::end_world() {
    rasterizer_.colour_depths(worlds_[world_], *drawing_);
    next_triangle_ = 0;
    if (++world_ == worlds_.size()) {
        pictures_[camera_] = std::move(drawing_);
    }
}

bool PointMaker::draw_part(std::size_t triangles) {
    if (!drawing_) {
        const std::vector<std::size_t> cameras = cameras_for(order_.hemisphere(), *building_);
        const auto next = std::find_if(cameras.begin(), cameras.end(),
                                       [&](std::size_t camera) { return pictures_[camera] == nullptr; });
        if (next == cameras.end()) {
            return false;
        }
        begin_picture(*next);
        if (worlds_.empty()) {
            pictures_[camera_] = std::move(drawing_);
        }
        return true;
    }
    const TriangleWorld& world = worlds_[world_];
    if (next_triangle_ == 0) {
        rasterizer_.begin_depths(world, *drawing_);
    }
    const std::size_t count = std::min(triangles, world.triangle_count() - next_triangle_);
    rasterizer_.draw_depths(world, *drawing_, next_triangle_, count);
    next_triangle_ += count;
    if (next_triangle_ == world.triangle_count()) {
        end_world();
    }
    return true;
}

void PointMaker::begin_merging() {
    const Hemisphere& hemisphere = order_.hemisphere();
    std::vector<const DepthPicture*> seeing;
    for (const std::size_t camera : cameras_for(hemisphere, *building_)) {
        seeing.push_back(pictures_[camera].get());
    }
    const ImagePlane plane = hemisphere.image_plane_of(*building_);
    merger_.emplace(camera_around(seeing, hemisphere.radius_m() * hemisphere.middle_of(*building_),
                                  {glm::dvec3(0.0), plane.right, plane.up, view_.pitch_m(), view_.max_side}),
                    view_.tolerance_steps);
    merged_ = 0;
}

void PointMaker::finish() {
    auto patch = std::make_shared<PointPatch>(seen_->take());
    patch->number = first_number_ + *building_;
    seen_.reset();
    std::uint64_t patches_bytes = patch->bytes();
    for (const auto& other : patches_) {
        patches_bytes += other ? other->bytes() : 0;
    }
    is_full_ = patches_bytes > max_bytes_;
    if (!is_full_) {
        patches_[*building_] = std::move(patch);
    }
    building_.reset();
    std::array<bool, camera_count> needed{};
    for (std::size_t other = 0; other < patch_count; ++other) {
        for (const std::size_t camera : cameras_for(order_.hemisphere(), other)) {
            needed[camera] = needed[camera] || (patches_[other] == nullptr && !is_full_);
        }
    }
    for (std::size_t camera = 0; camera < camera_count; ++camera) {
        if (!needed[camera]) {
            pictures_[camera].reset();
        }
    }
}

bool PointMaker::step(std::size_t triangles) {
    if (!building_ && !is_full_) {
        building_ = order_.next(made());
    }
    if (!building_) {
        return false;
    }
    if (seen_) {
        if (seen_->step()) {
            return true;
        }
        finish();
        return !is_full_ && made_count() < patch_count;
    }
    if (!merger_) {
        if (!draw_part(triangles)) {
            begin_merging();
        }
        return true;
    }
    const std::vector<std::size_t> cameras = cameras_for(order_.hemisphere(), *building_);
    if (merged_ < cameras.size()) {
        merger_->add(*pictures_[cameras[merged_++]]);
        return true;
    }
    seen_.emplace(point_patch(merger_->take()), order_.hemisphere(), *building_, view_);
    merger_.reset();
    return true;
}

std::size_t PointMaker::made_count() const {
    return patch_count - static_cast<std::size_t>(std::count(patches_.begin(), patches_.end(), nullptr));
}

std::uint64_t PointMaker::bytes() const {
    std::uint64_t bytes =
        rasterizer_.bytes() + (merger_ ? merger_->bytes() : 0) + (seen_ ? seen_->bytes() : 0);
    const auto add = [&bytes](const std::unique_ptr<DepthPicture>& picture) {
        bytes +=
            picture ? picture->nearness.size() * sizeof(float) + picture->colours.size() * sizeof(glm::u8vec4)
                    : 0;
    };
    add(drawing_);
    std::for_each(pictures_.begin(), pictures_.end(), add);
    for (const auto& patch : patches_) {
        bytes += patch ? patch->bytes() : 0;
    }
    return bytes;
}

} // namespace frustumscreen::ldi

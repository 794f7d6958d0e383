#include "app/ldi/patch_maker.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::ldi {

PatchMaker::PatchMaker(std::shared_ptr<const TriangleWorld> world, const Hemisphere& hemisphere,
                       const PatchLimits& limits)
    : world_(std::move(world)), hemisphere_(hemisphere), limits_(limits),
      views_(camera_views_for(*world_, hemisphere_, limits)) {}

void PatchMaker::look_from(const glm::dvec3& eye) {
    const std::optional<std::size_t> patch = hemisphere_.patch_of(eye);
    if (!patch) {
        return;
    }
    looking_from_ = glm::normalize(eye);
    if (build_ && *patch != building_ && patches_[*patch] == nullptr) {
        build_.reset();
    }
}

std::optional<std::size_t> PatchMaker::next_patch() const {
    const std::optional<std::size_t> looked_at = hemisphere_.patch_of(looking_from_);
    std::optional<std::size_t> next;
    double nearest = -2.0;
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        const double near = patch == looked_at ? 2.0 : glm::dot(looking_from_, hemisphere_.middle_of(patch));
        if (patches_[patch] == nullptr && near > nearest) {
            next = patch;
            nearest = near;
        }
    }
    return next;
}

bool PatchMaker::step(std::size_t triangles) {
    if (!build_) {
        const std::optional<std::size_t> next = next_patch();
        if (!next) {
            return false;
        }
        building_ = *next;
        build_.emplace(*world_, hemisphere_, views_, building_, limits_);
    }
    if (!build_->step(triangles)) {
        patches_[building_] = std::make_shared<const PatchRelief>(build_->take());
        build_.reset();
    }
    return made_count() < patch_count;
}

std::size_t PatchMaker::made_count() const {
    return patch_count - static_cast<std::size_t>(std::count(patches_.begin(), patches_.end(), nullptr));
}

std::uint64_t PatchMaker::bytes() const {
    std::uint64_t bytes = views_.bytes() + (build_ ? build_->bytes() : 0);
    for (const std::shared_ptr<const PatchRelief>& patch : patches_) {
        bytes += patch ? relief::bytes_of(patch->relief) : 0;
    }
    return bytes;
}

} // namespace frustumscreen::ldi

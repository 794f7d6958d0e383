#include "app/ldi/patch_maker.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::ldi {

PatchMaker::PatchMaker(std::shared_ptr<const TriangleWorld> world, const Hemisphere& hemisphere,
                       const PatchLimits& limits)
    : world_(std::move(world)), order_(hemisphere), limits_(limits),
      views_(camera_views_for(*world_, order_.hemisphere(), limits)) {}

void PatchMaker::look_from(const glm::dvec3& eye) {
    const std::optional<std::size_t> patch = order_.look_from(eye);
    if (patch && build_ && *patch != building_ && patches_[*patch] == nullptr) {
        build_.reset();
    }
}

std::optional<std::size_t> PatchMaker::next_patch() const {
    std::array<bool, patch_count> made{};
    std::transform(patches_.begin(), patches_.end(), made.begin(),
                   [](const auto& patch) { return patch != nullptr; });
    return order_.next(made);
}

bool PatchMaker::step(std::size_t triangles) {
    if (!build_) {
        const std::optional<std::size_t> next = next_patch();
        if (!next) {
            return false;
        }
        building_ = *next;
        build_.emplace(*world_, order_.hemisphere(), views_, building_, limits_);
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

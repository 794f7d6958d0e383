#include "app/show/patch_job.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::show {

PatchJob::PatchJob(PatchJobSetUp set_up)
    : set_up_(std::move(set_up)), patches_{.hemisphere = ldi::Hemisphere(set_up_.radius_m),
                                           .box = {},
                                           .samples = set_up_.samples} {}

void PatchJob::look_from(const glm::dvec3& eye) {
    if (const std::optional<std::size_t> patch = patches_.hemisphere.patch_of(eye)) {
        looked_at_.store(*patch, std::memory_order_relaxed);
    }
}

void PatchJob::update() {
    for (std::size_t k = 0; k < ldi::patch_count; ++k) {
        if (patches_.patches[k] == nullptr && is_made_[k].load(std::memory_order_acquire)) {
            patches_.box = box_; // written before the first patch
            patches_.patches[k] = made_[k].get();
        }
    }
}

bool PatchJob::has_first() const {
    return is_done() || is_made_[looked_at_.load(std::memory_order_relaxed)].load(std::memory_order_acquire);
}

void PatchJob::begin() {
    Result<FrozenWorld> world = set_up_.make_world();
    set_up_.make_world = nullptr; // and what it keeps
    if (!world || world->worlds.empty()) {
        done_.store(true, std::memory_order_release);
        return;
    }
    box_ = world->box;
    maker_.emplace(std::move(world->worlds), patches_.hemisphere, set_up_.view, set_up_.max_bytes,
                   set_up_.number * ldi::patch_count + 1);
}

void PatchJob::hand_over() {
    for (std::size_t k = 0; k < ldi::patch_count; ++k) {
        if (made_[k] != nullptr || maker_->patch(k) == nullptr) {
            continue;
        }
        made_[k] = maker_->patch(k);
        is_made_[k].store(true, std::memory_order_release);
    }
}

void PatchJob::step() {
    if (is_done()) {
        return;
    }
    if (!maker_) {
        begin();
        return;
    }
    maker_->look_from(patches_.hemisphere.middle_of(looked_at_.load(std::memory_order_relaxed)));
    const bool goes_on = maker_->step();
    hand_over();
    if (!goes_on) {
        maker_.reset();
        done_.store(true, std::memory_order_release);
    }
}

} // namespace frustumscreen::show

#include "app/show/patch_job.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::show {

void PatchJob::begin(PatchJobSetUp set_up) {
    set_up_ = std::move(set_up);
    patches_ = {.hemisphere = ldi::Hemisphere(set_up_.radius_m),
                .box = {},
                .samples = set_up_.samples,
                .patches = {}};
    looked_at_.store(0, std::memory_order_relaxed);
    state_.store(State::Begun, std::memory_order_release);
}

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

void PatchJob::show(std::span<const scene::WindowPatches::OfEye> eyes) {
    patches_.eye_count = std::min(eyes.size(), patches_.eyes.size());
    std::copy_n(eyes.begin(), patches_.eye_count, patches_.eyes.begin());
}

bool PatchJob::has_first() const {
    return is_done() || is_made_[looked_at_.load(std::memory_order_relaxed)].load(std::memory_order_acquire);
}

bool PatchJob::needs_work() const {
    const State state = state_.load(std::memory_order_acquire);
    return state == State::Begun || state == State::Left;
}

void PatchJob::make_world() {
    Result<FrozenWorld> world = (*set_up_.make_world)(set_up_.shown);
    if (!world || world->worlds.empty()) {
        end();
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

void PatchJob::end() {
    State begun = State::Begun;
    state_.compare_exchange_strong(begun, State::Done, std::memory_order_release, std::memory_order_relaxed);
}

void PatchJob::free() {
    maker_.reset();
    for (std::size_t k = 0; k < ldi::patch_count; ++k) {
        made_[k].reset();
        is_made_[k].store(false, std::memory_order_relaxed);
    }
    set_up_.make_world.reset();
    state_.store(State::Free, std::memory_order_release);
}

void PatchJob::step() {
    const State state = state_.load(std::memory_order_acquire);
    if (state == State::Left) {
        free();
        return;
    }
    if (state != State::Begun) {
        return;
    }
    if (!maker_) {
        make_world();
        return;
    }
    maker_->look_from(patches_.hemisphere.middle_of(looked_at_.load(std::memory_order_relaxed)));
    const bool goes_on = maker_->step();
    hand_over();
    if (!goes_on) {
        maker_.reset();
        end();
    }
}

} // namespace frustumscreen::show

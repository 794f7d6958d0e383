#include "app/show/set_switch.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::show {

bool SetSwitch::step(MonotonicTime now, exhibit::State state, exhibit::Exhibit& exhibit) {
    static_cast<void>(library_->news(status_));
    library_hangs_ = now > library_->alive_until();
    release_the_old();
    if (coming_ && exhibit.set_has_left()) {
        const std::size_t first = goal(state, exhibit).value_or(0);
        std::optional<exhibit::TableBrowser> browser = std::exchange(coming_->browser, std::nullopt);
        leaving_ = artifacts_.exchange(std::move(coming_));
        // The exhibit's old catalogue is destroyed where the set is.
        leaving_->catalogue =
            exhibit.show_set(artifacts_.catalogue(), std::move(browser), artifacts_.words(), first, now);
        return true;
    }
    take_the_new(exhibit);
    if (coming_) {
        bring(state, exhibit);
    }
    return false;
}

void SetSwitch::release_the_old() {
    if (leaving_ && !leaving_->release_some(artifacts_.store())) {
        static_cast<void>(library_->give_back(leaving_));
    }
}

/// A newer set replaces one that is not shown yet.
void SetSwitch::take_the_new(exhibit::Exhibit& exhibit) {
    if (leaving_ || exhibit.leaves_set()) {
        return;
    }
    std::unique_ptr<ShownSet> newer = library_->take();
    if (!newer) {
        return;
    }
    leaving_ = std::exchange(coming_, std::move(newer));
    exhibit.await_no_set();
    if (const Result<void> prepared = artifacts_.prepare(*coming_); !prepared) {
        give_up(prepared.error().message, exhibit);
    }
}

std::optional<std::size_t> SetSwitch::goal(exhibit::State state, const exhibit::Exhibit& exhibit) const {
    const std::span<const exhibit::ArtifactState> states = coming_->artifact_cache->states();
    const auto can_be_shown = [&](std::size_t artifact) {
        return states[artifact] != exhibit::ArtifactState::Unusable;
    };
    if (state != exhibit::State::Attract) { // in other states a visitor is looking at it
        const std::vector<std::string>& names = coming_->names;
        const auto same = std::find(names.begin(), names.end(), artifacts_.set().names[exhibit.chosen()]);
        const auto artifact = static_cast<std::size_t>(same - names.begin());
        if (same != names.end() && can_be_shown(artifact)) {
            return artifact;
        }
    }
    for (std::size_t artifact = 0; artifact < states.size(); ++artifact) {
        if (can_be_shown(artifact)) {
            return artifact;
        }
    }
    return std::nullopt;
}

void SetSwitch::bring(exhibit::State state, exhibit::Exhibit& exhibit) {
    const std::optional<std::size_t> first = goal(state, exhibit);
    if (!first || !coming_->trouble.empty()) {
        give_up(first ? std::string(coming_->trouble) : fault_of(coming_->artifact_cache->left_out(), true),
                exhibit);
        return;
    }
    const std::array<std::size_t, 1> wanted{*first};
    const residency::CacheRequest request{.shown = *first,
                                          .shown_language = exhibit.language(),
                                          .wanted = wanted,
                                          .language = exhibit.language()};
    if (const Result<void> uploaded = coming_->upload(artifacts_.store(), request, frame_bytes); !uploaded) {
        give_up(uploaded.error().message, exhibit);
        return;
    }
    exhibit.await_set(coming_->ready(request));
}

void SetSwitch::give_up(const std::string& trouble, exhibit::Exhibit& exhibit) {
    if (exhibit.leaves_set()) {
        return; // too late: its fault is reported when it is shown
    }
    coming_->trouble = trouble;
    exhibit.await_no_set();
    if (!leaving_) {
        leaving_ = std::move(coming_);
    }
}

void SetSwitch::report(MonotonicTime now, exhibit::State state) {
    library_->report({.now = now,
                      .number = artifacts_.set().number,
                      .shows_nothing = state == exhibit::State::Fault,
                      .left_out = artifacts_.left_out()});
}

} // namespace frustumscreen::show

// The contents that torches throw onto the artifact, and the buttons of a torch that is held.
#include "app/exhibit/exhibit.h"

namespace frustumscreen::exhibit {

void Exhibit::take_torch_presses() {
    next_content_ = leaves_light_ = false;
    if (!torches_ || !torches_->held() || state_ == State::Staff) {
        return;
    }
    const bool rests = object_dwell_.settled() || (table_ && table_->presented().ring);
    if (!rests && presses_.choose()) {
        next_content_ = true;
        presses_.end_choose();
    }
    const bool on_site = catalogue_.site(selection_.artifact()) != nullptr; // the button is the site's
    leaves_light_ = !on_site && presses_.take_behaviour();
}

void Exhibit::throw_light(MonotonicTime now, const tracking::TrackedState& tracked_state, const Shown& shown,
                          const DrawnPose& drawn, Presentation& presentation) {
    if (!torches_) {
        return;
    }
    const std::span<const glm::dvec3> hull = catalogue_.hull(shown.artifact);
    TorchLights::Input input{
        .tracked_state = tracked_state,
        .table_from_prop = drawn.table_from_prop,
        .artifact = shown.artifact,
        .contents = catalogue_.contents(shown.artifact),
        .object = around(hull.empty() ? std::span<const glm::dvec3>(place_.prop.corners) : hull),
        .light = note_of(state_).artifact ? presentation.brightness : 0.0,
        .next = next_content_,
        .leave = leaves_light_,
        .gone = state_ == State::Attract};
    input.object.centre_m = drawn.table_from_prop.point(input.object.centre_m);
    presentation.torches = torches_->step(now, input);
    presentation.brightness *= presentation.torches.house_light;
    torch_says_ = torch_advice_.step(now, state_ == State::View ? torches_->aim() : std::nullopt);
}

std::optional<WordIndex> Exhibit::torch_word() const {
    if (!torch_says_ || !place_.guidance) {
        return std::nullopt;
    }
    return advice_.find(*torch_says_ == TorchAim::Past ? "point_lamp" : "lamp_closer", selection_.language());
}

std::uint32_t Exhibit::torch_lamps() const {
    if (!torches_ || !torches_->held()) {
        return 0;
    }
    const bool changes = catalogue_.contents(selection_.artifact()) > 0;
    const bool leaves = torches_->aim() == TorchAim::Lights;
    return (changes ? 1U << settings::button_of(settings::Command::Choose) : 0U) |
           (leaves ? 1U << settings::button_of(settings::Command::Behaviour) : 0U);
}

std::optional<TitleIndex> Exhibit::content_title(const CatalogueEntry& entry, std::size_t artifact,
                                                 std::size_t language, glm::dvec2& size_m) const {
    const std::optional<std::size_t> content = torches_->content();
    if (!content || *content >= entry.content_title_sizes_m.size() ||
        language >= entry.content_title_sizes_m[*content].size()) {
        return std::nullopt;
    }
    size_m = entry.content_title_sizes_m[*content][language];
    if (size_m.y <= 0.0) {
        return std::nullopt;
    }
    return TitleIndex{
        .artifact = artifact, .behaviour = entry.behaviours.size() + *content, .language = language};
}

} // namespace frustumscreen::exhibit

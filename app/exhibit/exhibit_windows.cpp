// Windows on the table: when the button pins one, and which things they keep clear of.
#include "app/exhibit/exhibit.h"

namespace frustumscreen::exhibit {

namespace {

/// In this part of a visit a line tells a visitor who has pinned no window about the button.
constexpr Nanoseconds invites_after = std::chrono::seconds(20);
constexpr Nanoseconds invites_until = std::chrono::seconds(30);

constexpr double min_share = 0.9; ///< a view can be pinned from this share of the artifact's light on

/// `from`: the browser's pictures or the windows; empty: there are none.
template <typename Obstacles, typename From> void add_places(Obstacles& obstacles, const From& from) {
    if (from) {
        for (const typography::TableRectangle& place : from->obstacles()) {
            obstacles.add(place);
        }
    }
}

} // namespace

Exhibit::Obstacles Exhibit::lying_on_table() const {
    Obstacles lying;
    add_places(lying, table_);
    add_places(lying, windows_);
    return lying;
}

void Exhibit::step_windows(MonotonicTime now, const tracking::TrackedState& tracked_state, const Shown& shown,
                           const DrawnPose& drawn, Presentation& presentation) {
    const bool pin = presses_.take_window();
    if (!windows_) {
        return;
    }
    for (const PresentedWindow& window : windows_->presented().windows()) {
        if (!catalogue_.ready(window.artifact)) {
            windows_->drop_artifact(window.artifact);
        }
    }
    Obstacles others;
    add_places(others, table_);
    if (const typography::TableRectangle caption = caption_.place(now); caption.size_m.x > 0.0) {
        others.add(caption);
    }
    if (presentation.hotspot) {
        others.add(presentation.hotspot->label);
    }
    if (presentation.title) {
        others.add(presentation.title->rectangle);
    }
    if (presentation.advice) {
        others.add(presentation.advice->rectangle);
    }
    const SentenceEnvironment around =
        environment_of(place_, drawn, tracked_state.eye_m, side_.quarter_turns());
    WindowDesk::Input input{.artifact = shown.artifact,
                            .pin = pin,
                            .shows = has_artifact() && note_of(state_).artifact && state_ != State::Attract &&
                                     !drawn.attracts && !shown.changing && !leaves_set() &&
                                     catalogue_.ready(shown.artifact) &&
                                     presentation.artifact_light * drawn.brightness >= min_share,
                            .eye_m = tracked_state.eye_m,
                            .table_from_prop = drawn.table_from_prop,
                            .shadow = area_hidden_by(place_.prop, drawn, place_.lens_m),
                            .hidden = around.hidden,
                            .sign = std::nullopt,
                            .stands = tracked_state.prop_known && !drawn.attracts &&
                                      standing_place(place_.prop, tracked_state.table_from_prop).has_value(),
                            .prop_m = around.prop_m,
                            .quarter_turns = side_.quarter_turns(),
                            .obstacles = others.all(),
                            .gone = state_ == State::Attract};
    if (presentation.sign) {
        input.sign = typography::hull_of({}, presentation.sign->corners_m);
    }
    const std::size_t before = windows_->presented().windows().size();
    windows_->step(now, input);
    presentation.windows = windows_->presented();

    if (state_ == State::Attract) {
        visit_began_.reset();
        has_pinned_ = false;
    } else if (!visit_began_) {
        visit_began_ = now;
    }
    has_pinned_ = has_pinned_ || windows_->presented().windows().size() > before;
    invites_to_pin_ = visit_began_ && !has_pinned_ && now - *visit_began_ >= invites_after &&
                      now - *visit_began_ < invites_until && (windows_->can_pin() || invites_to_pin_);
}

std::optional<WordIndex> Exhibit::window_word() const {
    const bool has_button =
        place_.buttons > static_cast<std::size_t>(settings::button_of(settings::Command::Window));
    return invites_to_pin_ && has_button && place_.guidance
               ? advice_.find("pin_window", selection_.language())
               : std::nullopt;
}

} // namespace frustumscreen::exhibit

// Windows on the table: when the button pins one, and which things they keep clear of.
#include "app/exhibit/exhibit.h"
#include "app/exhibit/languages.h"

#include <algorithm>

namespace frustumscreen::exhibit {

namespace {

/// In this part of a visit a line tells a visitor who has pinned no window about the button.
constexpr Nanoseconds invites_after = std::chrono::seconds(20);
constexpr Nanoseconds invites_until = std::chrono::seconds(30);
/// In this time after the first window a line tells who has not held the button what it does then.
constexpr Nanoseconds tells_of_lens_after = std::chrono::seconds(8);
constexpr Nanoseconds tells_of_lens_until = std::chrono::seconds(16);

constexpr double min_share = 0.9; ///< a view can be pinned from this share of the artifact's light on

/// `from`: the browser's pictures or the windows; empty: there are none.
template <typename Obstacles, typename From> void add_places(Obstacles& obstacles, const From& from) {
    if (from) {
        for (const typography::TableRectangle& place : from->obstacles()) {
            obstacles.add(place);
        }
    }
}

/// Also one without captions; null: there is no such artifact.
const CatalogueEntry* find(const Catalogue& catalogue, std::size_t artifact) {
    return artifact < catalogue.size() ? &catalogue[artifact] : nullptr;
}

/// As large as every title of an artifact's states in every language.
glm::dvec2 room_for(const std::vector<std::vector<glm::dvec2>>& sizes_m) {
    glm::dvec2 room(0.0);
    for (const std::vector<glm::dvec2>& state : sizes_m) {
        for (const glm::dvec2& size : state) {
            room = glm::max(room, size);
        }
    }
    return room;
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
    const bool hold = presses_.take_window_hold();
    const bool pressed = presses_.take_any();
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
    const ViewToPin seen{std::nullopt, tracked_state.eye_m, drawn.table_from_prop};
    const CatalogueEntry* const entry = find(catalogue_.all(), shown.artifact);
    const std::size_t states = entry != nullptr ? entry->state_title_sizes_m.size() : 0;
    WindowDesk::Input input{
        .artifact = shown.artifact,
        .pin = pin,
        .shows = has_artifact() && note_of(state_).artifact && state_ != State::Attract && !drawn.attracts &&
                 !shown.changing && !leaves_set() && catalogue_.ready(shown.artifact) &&
                 presentation.artifact_light * drawn.brightness >= min_share,
        .eye_m = tracked_state.eye_m,
        .table_from_prop = drawn.table_from_prop,
        .view = history_.next(shown.artifact, states, seen),
        .title_m = entry != nullptr ? room_for(entry->state_title_sizes_m) : glm::dvec2(0.0),
        .hold = hold && state_ != State::Staff,
        .ends_lens = pressed || !tracked_state.prop_known || state_ == State::Staff,
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
    windows_->step(now, input);
    if (windows_->has_pinned()) {
        history_.note(shown.artifact, *input.view);
    }
    presentation.windows = windows_->presented();
    place_titles(shown.language, presentation.windows);

    if (state_ == State::Attract) {
        visit_began_.reset();
        has_pinned_ = has_turned_ = false;
        first_pin_.reset();
        history_.forget();
    } else if (!visit_began_) {
        visit_began_ = now;
    }
    has_pinned_ = has_pinned_ || windows_->has_pinned();
    has_turned_ = has_turned_ || hold;
    first_pin_ = has_pinned_ && !first_pin_ ? std::optional(now) : first_pin_;
    invites_to_turn_ = first_pin_ && !has_turned_ && now - *first_pin_ >= tells_of_lens_after &&
                       now - *first_pin_ < tells_of_lens_until;
    invites_to_pin_ = visit_began_ && !has_pinned_ && now - *visit_began_ >= invites_after &&
                      now - *visit_began_ < invites_until && (windows_->can_pin() || invites_to_pin_);
}

void Exhibit::place_titles(std::string_view language, PresentedWindows& windows) const {
    for (PresentedWindow& window : windows.windows()) {
        if (!window.state || window.title.size_m.y <= 0.0) {
            continue;
        }
        const CatalogueEntry* const entry =
            catalogue_.captioned(window.artifact); // titles are in its languages
        window.language = entry != nullptr ? caption_for(language, entry->languages) : 0;
        const bool has_title = entry != nullptr && *window.state < entry->state_title_sizes_m.size() &&
                               window.language < entry->state_title_sizes_m[*window.state].size();
        const glm::dvec2 size =
            has_title ? entry->state_title_sizes_m[*window.state][window.language] : glm::dvec2(0.0);
        const glm::dvec2 up(0.0, 0.5 * (window.title.size_m.y - size.y)); // close to the window
        window.title.centre_m += typography::turned(up, window.title.quarter_turns);
        window.title.size_m = size;
    }
}

std::optional<WordIndex> Exhibit::window_word() const {
    const bool has_button =
        place_.buttons > static_cast<std::size_t>(settings::button_of(settings::Command::Window));
    if (!has_button || !place_.guidance || !(invites_to_pin_ || invites_to_turn_)) {
        return std::nullopt;
    }
    return advice_.find(invites_to_pin_ ? "pin_window" : "turn_window", selection_.language());
}

} // namespace frustumscreen::exhibit

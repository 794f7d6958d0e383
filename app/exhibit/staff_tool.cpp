#include "app/exhibit/staff_tool.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace frustumscreen::exhibit {

namespace {

constexpr std::size_t first_button = 0, second_button = 1, third_button = 2;
constexpr int light_count = 3;

StaffLight light_after(StaffLight light, int steps) {
    return static_cast<StaffLight>((static_cast<int>(light) + light_count + steps) % light_count);
}

} // namespace

void StaffTool::begin(State before, MonotonicTime now) {
    state_before_ = before;
    StaffView view;
    view.louder_db = view_.louder_db;
    view.stays = view_.stays;
    view.resets = view_.resets;
    view.copies = view_.copies;
    view_ = view;
    shown_ = view;
    before_ = {};
    measure_ = reset_ = copy_ = false;
    begun_ = pressed_ = lit_ = shown_since_ = now;
}

void StaffTool::press(std::size_t button, MonotonicTime now) {
    if (button >= before_.size()) {
        return;
    }
    before_[button] = Step{
        .page = view_.page, .light = view_.light, .louder_db = view_.louder_db, .number = ++press_number_};
    latest_other_ = button != first_button ? button : latest_other_;
    std::uint16_t& presses = view_.presses[button];
    presses = presses < std::numeric_limits<std::uint16_t>::max() ? static_cast<std::uint16_t>(presses + 1)
                                                                  : presses;
    view_.pressed = static_cast<std::uint8_t>(button);
    view_.held = false;
    pressed_ = lit_ = now;
    act(button);
}

void StaffTool::act(std::size_t button) {
    if (view_.page == StaffPage::Buttons) {
        return;
    }
    if (button == second_button) {
        view_.page = static_cast<StaffPage>(static_cast<std::uint8_t>(view_.page) + 1);
        view_.light = StaffLight::White;
        return;
    }
    const int steps = button == first_button ? 1 : button == third_button ? -1 : 0;
    if (view_.page == StaffPage::Light) {
        view_.light = light_after(view_.light, steps);
    } else if (view_.page == StaffPage::Sound && steps != 0) {
        change_volume(steps);
        ++tones_;
    }
}

/// The volume wraps around from the loudest to the quietest: two buttons reach all steps.
void StaffTool::change_volume(int steps) {
    const int requested_db = view_.louder_db + steps * volume_step_db;
    view_.louder_db = requested_db > loudest_db    ? quietest_db
                      : requested_db < quietest_db ? loudest_db
                                                   : requested_db;
}

void StaffTool::hold(bool first, MonotonicTime now) {
    const std::size_t button = first ? first_button : latest_other_;
    undo(before_[button]);
    view_.pressed = static_cast<std::uint8_t>(button);
    view_.held = true;
    pressed_ = lit_ = now;
    if (view_.page == StaffPage::Buttons) {
        return;
    }
    if (first && view_.page == StaffPage::Place) {
        measure_ = true;
    } else if (first && view_.page == StaffPage::Status && view_.resets) {
        reset_ = true;
    } else if (first && view_.page == StaffPage::Copy && view_.copies) {
        copy_ = view_.kept = true; // until the result is known
    } else {
        view_.kept = true;
    }
}

void StaffTool::undo(std::optional<Step>& before) {
    if (before) {
        view_.page = before->page;
        view_.light = before->light;
        view_.louder_db = before->louder_db;
        before.reset();
    }
}

void StaffTool::undo_chord(std::size_t last_button) {
    std::optional<Step>* earlier = &before_[first_button];
    std::optional<Step>* later = &before_[std::min(last_button, before_.size() - 1)];
    if (*earlier && *later && (*later)->number < (*earlier)->number) {
        std::swap(earlier, later);
    }
    undo(*later);
    undo(*earlier);
}

void StaffTool::step(MonotonicTime now) {
    if (view_.pressed && now - lit_ >= lit_for) {
        view_.pressed.reset();
        view_.held = false;
    }
    const bool is_flat = view_.page == StaffPage::Light && view_.light != StaffLight::Greys;
    view_.has_words = !is_flat || now - pressed_ < words_stay;
    if (shown_ != view_ && now - shown_since_ >= between_views) {
        shown_ = view_;
        shown_since_ = now;
    }
}

bool StaffTool::is_over(MonotonicTime now) const {
    if (view_.stays) {
        return false;
    }
    return now - begun_ >= longest || (!view_.kept && now - pressed_ >= after_press);
}

bool StaffTool::take_measure() {
    return std::exchange(measure_, false);
}

bool StaffTool::take_reset() {
    return std::exchange(reset_, false);
}

bool StaffTool::take_copy() {
    return std::exchange(copy_, false);
}

void StaffTool::set_louder_db(int louder_db) {
    const int steps =
        (std::clamp(louder_db, quietest_db, loudest_db) - quietest_db + volume_step_db / 2) / volume_step_db;
    view_.louder_db = quietest_db + steps * volume_step_db;
}

} // namespace frustumscreen::exhibit

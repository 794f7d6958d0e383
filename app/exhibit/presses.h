/// The visitor's presses: which ones the staff's chord undoes, and which requests are not handled yet.
///
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/settings/command.h"

#include <array>
#include <cstddef>
#include <utility>

namespace frustumscreen::exhibit {

class Presses {
public:
    /// `counts`: the press is the visitor's. `command` is one of `button_commands`.
    void take(settings::Command command, bool counts) {
        at(command) = counts;
        any_ = true;
        choose_ = choose_ || (counts && command == settings::Command::Choose);
        help_ = help_ || (counts && command == settings::Command::Help);
        behaviour_ = behaviour_ || (counts && command == settings::Command::Behaviour);
        window_ = window_ || (counts && command == settings::Command::Window);
    }
    /// No chord undoes this press.
    void forget(settings::Command command) { at(command) = false; }
    /// True if the button's latest press is to be undone; the next call returns false.
    [[nodiscard]] bool undo(std::size_t button) {
        return button < undoable_.size() && std::exchange(undoable_[button], false);
    }

    /// The next thing is requested: the picture under the prop, or the next fact.
    [[nodiscard]] bool choose() const { return choose_; }
    void end_choose() { choose_ = false; }
    [[nodiscard]] bool help() const { return help_; }
    void end_help() { help_ = false; }
    /// True if a behaviour is requested; the next call returns false.
    [[nodiscard]] bool take_behaviour() { return std::exchange(behaviour_, false); }
    /// True if a window is to be pinned; the next call returns false.
    [[nodiscard]] bool take_window() { return std::exchange(window_, false); }
    void hold_window() { window_held_ = true; }
    /// True if the button for windows is held since this step; the next call returns false.
    [[nodiscard]] bool take_window_hold() { return std::exchange(window_held_, false); }
    /// True if something was pressed; the next call returns false.
    [[nodiscard]] bool take_any() { return std::exchange(any_, false); }

private:
    [[nodiscard]] bool& at(settings::Command command) {
        return undoable_.at(static_cast<std::size_t>(settings::button_of(command)));
    }

    std::array<bool, settings::button_commands.size()>
        undoable_{}; ///< by button: its latest press reached the selection
    bool choose_ = false;
    bool help_ = false;
    bool behaviour_ = false;
    bool window_ = false, window_held_ = false, any_ = false;
};

} // namespace frustumscreen::exhibit

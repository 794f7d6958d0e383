/// What the panel's buttons ask for. Only this file knows which button means what.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace frustumscreen {

enum class Command : std::uint8_t {
    PreviousArtifact,
    NextArtifact,
    NextLanguage,
    Choose, ///< the picture that the prop rests on, at once; else the next thing to know about the artifact
    Help,   ///< what to do, at once; where nothing is to be done, what the artifact is
    StaffMode, ///< the chord: the first and the last button were held together
    HoldFirst, ///< the first button's press became a long one; for the staff alone
    HoldOther, ///< that of another button did
};

/// The commands of buttons 0 to 4; a panel may have fewer buttons.
inline constexpr std::array button_commands{Command::PreviousArtifact, Command::NextArtifact,
                                            Command::NextLanguage, Command::Choose, Command::Help};

/// A button's press, which counts at once.
[[nodiscard]] constexpr bool is_press(Command command) {
    return std::find(button_commands.begin(), button_commands.end(), command) != button_commands.end();
}
/// A visitor's press that goes on means nothing more.
[[nodiscard]] constexpr bool is_hold(Command command) {
    return command == Command::HoldFirst || command == Command::HoldOther;
}

/// Returns nothing if there is no such button.
[[nodiscard]] constexpr std::optional<Command> command_of_button(int button) {
    const auto index = static_cast<std::size_t>(button);
    return button >= 0 && index < button_commands.size() ? std::optional(button_commands[index])
                                                         : std::nullopt;
}
/// `command` is one of `button_commands`.
[[nodiscard]] constexpr int button_of(Command command) {
    return static_cast<int>(std::find(button_commands.begin(), button_commands.end(), command) -
                            button_commands.begin());
}

} // namespace frustumscreen

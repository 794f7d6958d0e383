/// The commands of the panel's buttons. Only this file assigns commands to buttons.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace frustumscreen::settings {

enum class Command : std::uint8_t {
    PreviousArtifact,
    NextArtifact,
    NextLanguage,
    Choose,     ///< the picture that the prop rests on, at once; otherwise the next fact about the artifact
    Help,       ///< advice, at once; if there is none, the artifact's description
    Behaviour,  ///< the next of the artifact's behaviours that have a button
    Window,     ///< what is seen through the prop is pinned onto the table
    StaffMode,  ///< the first and the last button were held together
    HoldFirst,  ///< the first button is held; for the staff alone
    HoldOther,  ///< another button is held; for the staff alone
    HoldWindow, ///< the button `Window` is held: the newest window follows the prop
};

/// The commands of buttons 0 to 6; a panel may have fewer buttons.
inline constexpr std::array button_commands{
    Command::PreviousArtifact, Command::NextArtifact, Command::NextLanguage, Command::Choose, Command::Help,
    Command::Behaviour,        Command::Window};

/// True for a button's press, which takes effect at once.
[[nodiscard]] constexpr bool is_press(Command command) {
    return std::find(button_commands.begin(), button_commands.end(), command) != button_commands.end();
}
/// True for a button held longer than a press.
[[nodiscard]] constexpr bool is_hold(Command command) {
    return command == Command::HoldFirst || command == Command::HoldOther || command == Command::HoldWindow;
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

} // namespace frustumscreen::settings

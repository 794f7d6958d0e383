/// The staff's use of the buttons while the staff picture is shown: pages, volume, and when the picture ends.
///
///     first button    does what the page is for: the next light, louder and a tone
///     second button   the next page
///     third button    undoes one step of the first
///     any, held       the picture is kept; the first one on StaffPage::Place: the table is measured; while it is
///                     offered, on StaffPage::Status: the kiosk goes back to the state of delivery; on
///                     StaffPage::Copy: a copy of the kiosk is written to the stick, and the picture is kept
///
/// Buttons  two are enough. On StaffPage::Buttons each press is only counted. This page is therefore the last, and
///          only the chord leaves it, as the chord ends the picture on every page. The effect of the presses of a
///          chord, or of a button that is then held, is undone.
/// End      `after_press` after the latest press; if kept, `longest` after it appeared, the upper limit. Without a
///          calibration (`stays`) only the chord ends it.
/// Flashes  the picture follows the presses at most once every `between_views`, however fast the buttons are pressed.
/// Units    decibels.
/// Time     `now` never goes back.
/// Threads  a value; one caller. Allocates nothing.
#pragma once

#include "app/exhibit/states.h"
#include "app/settings/command.h"
#include "firmware_host/base/time.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace frustumscreen::exhibit {

enum class StaffPage : std::uint8_t { Status, Place, Focus, Light, Sound, Tracker, Copy, Buttons };
inline constexpr std::array<std::string_view, 8> staff_page_names{
    "Status", "Place", "Focus", "Light", "Sound", "Tracker", "Copy to the stick", "Buttons"};
/// The picture of StaffPage::Light: all white, all black, steps from black to white.
enum class StaffLight : std::uint8_t { White, Black, Greys };

/// The content of the staff picture.
struct StaffView {
    StaffPage page = StaffPage::Status;
    StaffLight light = StaffLight::White;
    bool has_words = true; ///< a white or black picture loses its words after `words_stay`, to be measured
    int louder_db = 0;     ///< relative to the settings' volume
    std::array<std::uint16_t, settings::button_commands.size()>
        presses{};                       ///< of each button since the picture appeared
    std::optional<std::uint8_t> pressed; ///< the latest button, for `lit_for`
    bool held = false;                   ///< `pressed` was held long enough to count as held
    bool kept = false;
    bool stays = false;
    bool resets = false; ///< the state of delivery is offered
    bool copies = false; ///< a copy of the kiosk onto a stick is offered

    [[nodiscard]] bool operator==(const StaffView&) const = default;
};

class StaffTool {
public:
    static constexpr Nanoseconds after_press = std::chrono::minutes(1);
    static constexpr Nanoseconds longest = std::chrono::minutes(30);
    static constexpr Nanoseconds words_stay = std::chrono::seconds(5);
    static constexpr Nanoseconds lit_for = std::chrono::seconds(1);
    static constexpr Nanoseconds between_views = std::chrono::milliseconds(350);
    static constexpr int volume_step_db = 3, quietest_db = -18, loudest_db = 12;

    /// `stays`: there is no calibration.
    explicit StaffTool(bool stays) { view_.stays = stays; }

    /// Shows the first page; `before`: the exhibit's state until then.
    void begin(State before, MonotonicTime now);
    void press(std::size_t button, MonotonicTime now);
    /// Call when a button is held: that of the latest press of `first`, or of another one.
    void hold(bool first, MonotonicTime now);
    /// Call when the first and the last button are held: undoes the effect of their presses.
    void undo_chord(std::size_t last_button);
    /// Call in every step while the picture is shown, after the presses.
    void step(MonotonicTime now);
    [[nodiscard]] bool is_over(MonotonicTime now) const;
    /// True if the staff asked to measure the table since `begin` or the last call.
    [[nodiscard]] bool take_measure();
    /// Begins or ends the offer of the state of delivery.
    void offer_reset(bool offered) { view_.resets = offered; }
    /// True if the staff confirmed it since `begin` or the last call.
    [[nodiscard]] bool take_reset();
    /// Begins or ends the offer of a copy of the kiosk.
    void offer_copy(bool offered) { view_.copies = offered; }
    /// True if the staff confirmed it since `begin` or the last call.
    [[nodiscard]] bool take_copy();

    /// The content to show.
    [[nodiscard]] const StaffView& shown() const { return shown_; }
    [[nodiscard]] State state_before() const { return state_before_; }
    /// Number of tones asked for.
    [[nodiscard]] std::uint32_t tones() const { return tones_; }
    /// Valid also while the picture is not shown.
    [[nodiscard]] int louder_db() const { return view_.louder_db; }
    /// Restores a kept volume; a value between the steps counts as the nearest.
    void set_louder_db(int louder_db);

private:
    /// The values that a press changes and `undo` restores.
    struct Step {
        StaffPage page;
        StaffLight light;
        int louder_db;
        std::uint64_t number; ///< of the press
    };
    void act(std::size_t button);
    void change_volume(int steps);
    void undo(std::optional<Step>& before);

    State state_before_ = State::Attract;
    StaffView view_;  ///< as pressed
    StaffView shown_; ///< follows it
    std::array<std::optional<Step>, settings::button_commands.size()>
        before_{}; ///< each button's latest press
    std::uint64_t press_number_ = 0;
    std::uint32_t tones_ = 0;
    bool measure_ = false;
    bool reset_ = false;
    bool copy_ = false;
    std::size_t latest_other_ = 1; ///< the latest pressed button other than the first
    MonotonicTime begun_, pressed_, lit_, shown_since_;
};

} // namespace frustumscreen::exhibit

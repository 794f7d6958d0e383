/// What the staff do with the buttons while their picture is shown: pages, volume, and when the picture goes.
///
///     first button    does what the page is for: the next light, louder and a tone
///     second button   the next page
///     third button    one step back of what the first one does
///     any, held       the picture is kept; the first one on StaffPage::Place: the table is measured
///
/// Buttons  two are enough. On StaffPage::Buttons each press counts and does nothing else; so this page comes last, and the chord
///          alone leads away from it, as it ends the picture on every page. What the presses of a chord, or of a button that is then
///          held, did before is undone.
/// End      `after_press` after the latest press; kept: `longest` after it came, which is the most. Without a calibration (`stays`) it
///          goes with the chord alone.
/// Flashes  what is shown follows the presses at most once every `between_views`, whoever hammers at the buttons.
/// Units    decibels.
/// Time     `now` never goes back.
/// Threads  a value; one caller. Allocates nothing.
#pragma once

#include "app/settings/command.h"
#include "firmware_host/base/time.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace frustumscreen {

enum class StaffPage : std::uint8_t { Status, Place, Focus, Light, Sound, Tracker, Buttons };
inline constexpr std::array<std::string_view, 7> staff_page_names{"Status", "Place",   "Focus",  "Light",
                                                                  "Sound",  "Tracker", "Buttons"};
/// Of StaffPage::Light: all white, all black, steps from black to white.
enum class StaffLight : std::uint8_t { White, Black, Greys };

/// What is shown to the staff.
struct StaffView {
    StaffPage page = StaffPage::Status;
    StaffLight light = StaffLight::White;
    bool has_words = true; ///< a white or black picture is without any after `words_stay`, to be measured
    int louder_db = 0;     ///< than the settings say
    std::array<std::uint16_t, button_commands.size()> presses{}; ///< of each button since the picture came
    std::optional<std::uint8_t> pressed;                         ///< the latest button, for `lit_for`
    bool held = false; ///< `pressed` was held long enough to count as that
    bool kept = false;
    bool stays = false;

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

    /// The picture comes, with its first page.
    void begin(MonotonicTime now);
    void press(std::size_t button, MonotonicTime now);
    /// The button of the latest press of `first`, or of another one, is held.
    void hold(bool first, MonotonicTime now);
    /// The first and the last button are held: what their presses did is undone.
    void undo_chord(std::size_t last_button);
    /// Call in every step, after what was pressed; the picture is shown.
    void step(MonotonicTime now);
    [[nodiscard]] bool is_over(MonotonicTime now) const;
    /// Since `begin` or the last call, the staff asked to measure the table.
    [[nodiscard]] bool take_measure();

    /// What is shown.
    [[nodiscard]] const StaffView& shown() const { return shown_; }
    /// How often a tone was asked for.
    [[nodiscard]] std::uint32_t tones() const { return tones_; }
    /// Also while the picture is not shown.
    [[nodiscard]] int louder_db() const { return view_.louder_db; }
    /// As it was kept; a value that is none of its steps counts as the nearest.
    void set_louder_db(int louder_db);

private:
    /// What a press changes, and undoing brings back.
    struct Step {
        StaffPage page;
        StaffLight light;
        int louder_db;
        std::uint64_t number; ///< of the press
    };
    void act(std::size_t button);
    void change_volume(int steps);
    void undo(std::optional<Step>& before);

    StaffView view_;                                                   ///< as pressed
    StaffView shown_;                                                  ///< follows it
    std::array<std::optional<Step>, button_commands.size()> before_{}; ///< each button's latest press
    std::uint64_t press_number_ = 0;
    std::uint32_t tones_ = 0;
    bool measure_ = false;
    std::size_t latest_other_ = 1; ///< the button but the first that was pressed last
    MonotonicTime begun_, pressed_, lit_, shown_since_;
};

} // namespace frustumscreen

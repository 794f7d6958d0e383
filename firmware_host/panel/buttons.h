/// What levels on wires mean: contact bounce, presses, long presses, the staff's chord, buttons that stick or
/// chatter.
///
/// A level counts once it has held for the debounce time; its time is when it began. A button that is down at
/// the first sample reports nothing but being stuck until it was up: a chip's spurious first edge is no
/// press, and wires that are swapped or shorted are no chord.
///
/// A press is reported at once, even if the button may turn out to be held for the chord: no visitor waits
/// for the staff. A chord begins with the latest press of each of its buttons; whoever acted on those presses
/// undoes it.
///
/// A loose contact gets through any debounce: one of 5 kHz, looked at every 20 ms, presses up to nine times a
/// second for as long as it has power. So a button of `too_many_edges` within `chatter_window` is ignored
/// until its level has been still for `quiet`. Forty edges are twenty presses, two a second for ten seconds,
/// which is more than anyone needs: a change of artifact takes half a second, so nobody sees artifacts that
/// pass so fast. A child that hammers at it (six to seven presses a second are about as fast as a finger
/// goes) is ignored after three seconds, and counts again three seconds after it lets go. Edges are counted,
/// not presses, because a loose contact has many more of them: it is found within a few seconds, even if it
/// rarely holds long enough to press.
///
/// Time     a parameter, monotonic; samples may come at any interval; one that is older than the last is
///          ignored.
/// Threads  values; any. Allocates nothing after construction but for the caller's events.
#pragma once

#include "firmware_host/panel/panel.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen {

struct ButtonTimes {
    Nanoseconds debounce = std::chrono::milliseconds(30);
    Nanoseconds long_press = std::chrono::milliseconds(1500);
    Nanoseconds chord = std::chrono::seconds(3);
    Nanoseconds stuck = std::chrono::seconds(30);
    Nanoseconds chatter_window = std::chrono::seconds(10);
    Nanoseconds quiet = std::chrono::seconds(3);
};

class Buttons {
public:
    static constexpr std::size_t too_many_edges = 40; ///< within `chatter_window`

    Buttons(std::size_t count, const ButtonTimes& times);

    /// The levels at `now`, true = down, one each button. Appends what they mean, in ascending time.
    void sample(MonotonicTime now, std::span<const bool> down, std::vector<PanelEvent>& events);
    /// When something happens next even if no level changes; nothing = never.
    [[nodiscard]] std::optional<MonotonicTime> due() const;
    /// The button counts as broken.
    [[nodiscard]] bool ignored(std::size_t which) const {
        return buttons_[which].stuck || buttons_[which].chatters;
    }
    /// The first and the last button are down, as the latest sample has them: both counted, and neither is let go.
    [[nodiscard]] bool chord_held() const {
        return chord_since() && buttons_.front().level && buttons_.back().level;
    }
    [[nodiscard]] bool any_stuck() const;
    [[nodiscard]] bool any_chatters() const;

private:
    struct Button {
        bool level = false;   ///< as sampled last
        bool down = false;    ///< as it counts
        bool pressed = false; ///< down, after it was up: its press was reported
        bool mute = false;    ///< no long press until it comes up
        bool stuck = false;
        bool chatters = false; ///< until it is quiet, only `level` is followed
        MonotonicTime level_since{};
        MonotonicTime down_since{};
        std::array<MonotonicTime, too_many_edges - 1> edges{}; ///< the latest, in a ring
        std::size_t edge_count = 0;                            ///< since it chattered last
    };
    void settle(MonotonicTime now, std::size_t which, std::vector<PanelEvent>& events);
    [[nodiscard]] bool edge(Button& button);
    void calm_down(MonotonicTime now, std::size_t which, std::vector<PanelEvent>& events);
    void hold(MonotonicTime now, std::size_t which, std::vector<PanelEvent>& events);
    void hold_chord(MonotonicTime now, std::vector<PanelEvent>& events);
    /// Since when the chord is held; nothing = it is not.
    [[nodiscard]] std::optional<MonotonicTime> chord_since() const;

    ButtonTimes times_;
    std::vector<Button> buttons_;
    std::optional<MonotonicTime> last_;
    bool chord_said_ = false;
};

} // namespace frustumscreen

/// Interprets levels on lines: contact bounce, presses, long presses, the staff's chord, and buttons that
/// stick or chatter.
///
/// A level counts once it has lasted for the debounce time; its time is that of its start. A button that is
/// down at the first sample reports only Stuck until it has been up: a chip's spurious first edge is not a
/// press, and swapped or shorted wires are not a chord.
///
/// A press is reported at once, even if the button may later turn out to be held for the chord, so visitors
/// do not wait for a staff function. A chord begins with the latest press of its buttons; the client that
/// acted on those presses must undo its actions.
///
/// Debouncing does not stop a loose contact: one of 5 kHz, sampled every 20 ms, presses up to nine times a
/// second while it is powered. A button with `too_many_edges` within `chatter_window` is therefore ignored
/// until its level has been still for `quiet`. Forty edges are twenty presses, two a second for ten seconds.
/// No visitor needs more: a change of artifact takes half a second, so faster presses show nothing. A child
/// that hammers on a button (a finger reaches six to seven presses a second) is ignored after three seconds,
/// and counts again three seconds after the last press. Edges are counted instead of presses, because a loose
/// contact causes many more edges and is thus found within a few seconds, even if it rarely lasts long enough
/// for a press.
///
/// Time     a parameter, monotonic; samples may come at any interval; one that is older than the previous is
///          ignored.
/// Threads  values; any. After construction, allocates only for the caller's events.
#pragma once

#include "firmware_host/panel/panel.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::panel {

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

    /// The levels at `now`, true = down, one for each button. Appends their events, in ascending time.
    void sample(MonotonicTime now, std::span<const bool> down, std::vector<PanelEvent>& events);
    /// Time of the next event if no level changes; nullopt = never.
    [[nodiscard]] std::optional<MonotonicTime> due() const;
    /// Whether the button counts as broken.
    [[nodiscard]] bool ignored(std::size_t which) const {
        return buttons_[which].stuck || buttons_[which].chatters;
    }
    /// Whether the first and the last button are down in the latest sample, and their presses were reported.
    [[nodiscard]] bool chord_held() const {
        return chord_since() && buttons_.front().level && buttons_.back().level;
    }
    [[nodiscard]] bool any_stuck() const;
    [[nodiscard]] bool any_chatters() const;

private:
    struct Button {
        bool level = false;   ///< in the latest sample
        bool down = false;    ///< after debouncing
        bool pressed = false; ///< down after it was up; the press was reported
        bool mute = false;    ///< no long press until it is up again
        bool stuck = false;
        bool chatters = false; ///< until it is quiet, only `level` is updated
        MonotonicTime level_since{};
        MonotonicTime down_since{};
        std::array<MonotonicTime, too_many_edges - 1> edges{}; ///< the latest ones, in a ring
        std::size_t edge_count = 0;                            ///< since it last chattered
    };
    void settle(MonotonicTime now, std::size_t which, std::vector<PanelEvent>& events);
    [[nodiscard]] bool edge(Button& button);
    void calm_down(MonotonicTime now, std::size_t which, std::vector<PanelEvent>& events);
    void hold(MonotonicTime now, std::size_t which, std::vector<PanelEvent>& events);
    void hold_chord(MonotonicTime now, std::vector<PanelEvent>& events);
    /// Start of the chord; nullopt = the chord is not held.
    [[nodiscard]] std::optional<MonotonicTime> chord_since() const;

    ButtonTimes times_;
    std::vector<Button> buttons_;
    std::optional<MonotonicTime> last_;
    bool chord_said_ = false;
};

} // namespace frustumscreen::panel

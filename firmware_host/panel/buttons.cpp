#include "firmware_host/panel/buttons.h"

#include <algorithm>
#include <cassert>

namespace frustumscreen::panel {

Buttons::Buttons(std::size_t count, const ButtonTimes& times) : times_(times), buttons_(count) {}

void Buttons::sample(MonotonicTime now, std::span<const bool> down, std::vector<PanelEvent>& events) {
    assert(down.size() == buttons_.size());
    if (last_ && now < *last_) {
        return;
    }
    const bool first = !last_;
    last_ = now;
    const std::size_t begin = events.size();
    for (std::size_t k = 0; k < buttons_.size(); ++k) {
        Button& button = buttons_[k];
        if (first) {
            button = {.level = down[k], .down = down[k], .level_since = now, .down_since = now};
        } else if (down[k] != button.level) {
            button.level = down[k];
            button.level_since = now;
            if (edge(button) && !button.chatters && !button.stuck) {
                button.chatters = true;
                button.pressed = false;
                events.push_back({now, static_cast<int>(k), PressKind::Chatters});
            }
        }
        if (button.chatters) {
            calm_down(now, k, events);
        } else {
            settle(now, k, events);
        }
        hold(now, k, events);
    }
    hold_chord(now, events);
    std::stable_sort(events.begin() + static_cast<std::ptrdiff_t>(begin), events.end(),
                     [](const PanelEvent& a, const PanelEvent& b) { return a.time < b.time; });
}

/// Accepts a level that has lasted for the debounce time.
void Buttons::settle(MonotonicTime now, std::size_t which, std::vector<PanelEvent>& events) {
    Button& button = buttons_[which];
    if (button.level == button.down || now - button.level_since < times_.debounce) {
        return;
    }
    button.down = button.level;
    const int number = static_cast<int>(which);
    if (button.down) {
        button.down_since = button.level_since;
        button.pressed = true;
        events.push_back({button.level_since, number, PressKind::Press});
        return;
    }
    if (button.stuck) {
        events.push_back({button.level_since, number, PressKind::Freed});
    }
    button.pressed = false;
    button.mute = false;
    button.stuck = false;
}

/// Returns true for one edge too many. Bounces within the debounce time count as one edge.
bool Buttons::edge(Button& button) {
    const MonotonicTime time = button.level_since;
    const std::size_t latest = (button.edge_count + button.edges.size() - 1) % button.edges.size();
    if (button.edge_count > 0 && time - button.edges[latest] < times_.debounce) {
        return false;
    }
    MonotonicTime& oldest = button.edges[button.edge_count % button.edges.size()];
    const bool too_many = button.edge_count >= button.edges.size() && time - oldest <= times_.chatter_window;
    oldest = time;
    ++button.edge_count;
    return too_many;
}

/// A button that became quiet is treated as at the first sample: if it is down, it reports nothing until it
/// has been up.
void Buttons::calm_down(MonotonicTime now, std::size_t which, std::vector<PanelEvent>& events) {
    Button& button = buttons_[which];
    if (now - button.level_since < times_.quiet) {
        return;
    }
    button = {.level = button.level,
              .down = button.level,
              .level_since = button.level_since,
              .down_since = button.level_since};
    events.push_back({button.level_since + times_.quiet, static_cast<int>(which), PressKind::Freed});
}

/// Reports the events of a button that stays down. One that is up is not known to have stayed down until now, even if
/// that level has not lasted for the debounce time yet: after a late sample it may have been up for long.
void Buttons::hold(MonotonicTime now, std::size_t which, std::vector<PanelEvent>& events) {
    Button& button = buttons_[which];
    if (!button.down || !button.level || button.stuck || button.chatters) {
        return;
    }
    const int number = static_cast<int>(which);
    if (button.pressed && !button.mute && !chord_since() && now - button.down_since >= times_.long_press) {
        button.mute = true;
        events.push_back({button.down_since + times_.long_press, number, PressKind::LongPress});
    }
    if (now - button.down_since >= times_.stuck) {
        button.stuck = true;
        events.push_back({button.down_since + times_.stuck, number, PressKind::Stuck});
    }
}

void Buttons::hold_chord(MonotonicTime now, std::vector<PanelEvent>& events) {
    const std::optional<MonotonicTime> since = chord_since();
    if (!since) {
        chord_said_ = false;
        return;
    }
    if (!chord_said_ && chord_held() && now - *since >= times_.chord) {
        chord_said_ = true;
        buttons_.front().mute = true;
        buttons_.back().mute = true;
        events.push_back({*since + times_.chord, 0, PressKind::Chord});
    }
}

std::optional<MonotonicTime> Buttons::chord_since() const {
    if (buttons_.size() < 2) {
        return std::nullopt;
    }
    const Button& first = buttons_.front();
    const Button& last = buttons_.back();
    const bool held = first.pressed && last.pressed && !first.stuck && !last.stuck;
    return held ? std::optional(std::max(first.down_since, last.down_since)) : std::nullopt;
}

std::optional<MonotonicTime> Buttons::due() const {
    std::optional<MonotonicTime> next;
    const auto consider = [&next](MonotonicTime time) { next = next ? std::min(*next, time) : time; };
    const std::optional<MonotonicTime> chord = chord_since();
    if (chord_held() && !chord_said_) {
        consider(*chord + times_.chord);
    }
    for (const Button& button : buttons_) {
        if (button.chatters) {
            consider(button.level_since + times_.quiet);
            continue;
        }
        if (button.level != button.down) {
            consider(button.level_since + times_.debounce);
        } else if (button.down && !button.stuck) {
            consider(button.down_since + times_.stuck);
            if (button.pressed && !button.mute && !chord) {
                consider(button.down_since + times_.long_press);
            }
        }
    }
    return next;
}

bool Buttons::any_stuck() const {
    return std::any_of(buttons_.begin(), buttons_.end(), [](const Button& button) { return button.stuck; });
}

bool Buttons::any_chatters() const {
    return std::any_of(buttons_.begin(), buttons_.end(),
                       [](const Button& button) { return button.chatters; });
}

} // namespace frustumscreen::panel

#include "firmware_host/panel/button_panel.h"

#include "firmware_host/base/device_thread.h"

#include <algorithm>

namespace frustumscreen::panel {

namespace {

constexpr Nanoseconds look_again = std::chrono::milliseconds(500);
constexpr Nanoseconds longest_wait = std::chrono::milliseconds(100); ///< a stop is noticed after that

DeviceState impaired(MessageId id, std::string_view sentence) {
    return {{DeviceHealth::Impaired, id}, Sentence(sentence)};
}

/// While no button is broken.
DeviceState state_of(const ButtonLines& lines) {
    return lines.remark().empty()
               ? DeviceState{{DeviceHealth::Well, "panel.well"}, Sentence("its buttons are there")}
               : impaired("panel.line_has_function", lines.remark());
}

/// `otherwise`: while none is broken.
DeviceState state_of(const Buttons& buttons, const DeviceState& otherwise) {
    if (buttons.any_stuck() && buttons.any_chatters()) {
        return impaired("panel.stuck_and_chatters",
                        "a button is stuck, another chatters, and both are ignored; free or replace them");
    }
    if (buttons.any_stuck()) {
        return impaired("panel.stuck", "a button is stuck and is ignored; free it or replace it");
    }
    return buttons.any_chatters()
               ? impaired("panel.chatters",
                          "a button chatters and is ignored until it is quiet; look at its wires, or "
                          "replace it")
               : otherwise;
}

/// State of the lamps; sent to them when it changes.
class Lamps {
public:
    explicit Lamps(std::size_t count) : count_(count), lit_(std::make_unique<bool[]>(count)) {}

    /// Lights the requested buttons that are not broken.
    [[nodiscard]] Result<void> follow(std::uint32_t asked, const Buttons& buttons, ButtonLines& lines) {
        bool changed = false;
        for (std::size_t k = 0; k < count_; ++k) {
            const bool lit = ((asked >> k) & 1U) != 0 && !buttons.ignored(k);
            changed = changed || lit != lit_[k];
            lit_[k] = lit;
        }
        return changed ? lines.light({lit_.get(), count_}) : Result<void>{};
    }

private:
    std::size_t count_;
    std::unique_ptr<bool[]> lit_; ///< dark at first, as after opening
};

} // namespace

ButtonPanel::ButtonPanel(OpenLines open, std::size_t buttons, const ButtonTimes& times)
    : open_(std::move(open)), count_(buttons), times_(times),
      thread_([this](const std::stop_token& stop) { watch(stop); }) {}

Result<void> ButtonPanel::poll(MonotonicTime now, std::vector<PanelEvent>& events) {
    mailbox_.take(now, events);
    static_cast<void>(said_.try_take(state_));
    return {};
}

void ButtonPanel::watch(const std::stop_token& stop) {
    begin_device_thread("panel");
    while (!stop.stop_requested()) {
        heartbeat_.promise(monotonic_now() + longest_round);
        Result<std::unique_ptr<ButtonLines>> lines = open_();
        said_.put(away(lines ? serve(**lines, stop) : lines.error()));
        held_until_.promise(MonotonicTime{});
        lines = {}; // close the chip before searching for it again
        sleep_until_stop(stop, look_again);
    }
}

Error ButtonPanel::serve(ButtonLines& lines, const std::stop_token& stop) {
    const DeviceState whole = state_of(lines);
    said_.put(whole);
    Buttons buttons(count_, times_);
    const auto down = std::make_unique<bool[]>(count_);
    const std::span<bool> levels(down.get(), count_);
    Lamps lamps(count_);
    std::vector<PanelEvent> events;
    while (!stop.stop_requested()) {
        heartbeat_.promise(monotonic_now() + longest_round);
        if (Result<void> read = lines.read(levels); !read) {
            return read.error();
        }
        const MonotonicTime now = monotonic_now();
        events.clear();
        buttons.sample(now, levels, events);
        held_until_.promise(buttons.chord_held() ? now + held_for : MonotonicTime{});
        if (!events.empty()) {
            mailbox_.put(events);
            said_.put(state_of(buttons, whole));
        }
        if (Result<void> lit = lamps.follow(requested_, buttons, lines); !lit) {
            return lit.error();
        }
        const std::optional<MonotonicTime> due = buttons.due();
        const Nanoseconds until_due = due ? std::max(Nanoseconds(*due - now), Nanoseconds(0)) : longest_wait;
        if (Result<void> waited = lines.wait(std::min(until_due, longest_wait)); !waited) {
            return waited.error();
        }
    }
    const Result<void> dark = lamps.follow(0, buttons, lines);
    return dark ? Error{ErrorKind::DeviceLost, "panel.ended", {}} : dark.error();
}

} // namespace frustumscreen::panel

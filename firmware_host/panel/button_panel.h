/// A panel of real buttons. Its own thread waits for them, and searches for an unplugged chip until it is
/// back.
///
/// Threads  `poll`, `state`: one caller, never blocked by the device. At most `max_waiting` events wait; new
///          ones overwrite the oldest.
/// Time     events have the monotonic clock's time.
#pragma once

#include "firmware_host/base/heartbeat.h"
#include "firmware_host/base/latest.h"
#include "firmware_host/base/mailbox.h"
#include "firmware_host/panel/button_lines.h"
#include "firmware_host/panel/buttons.h"
#include "firmware_host/panel/panel.h"

#include <atomic>
#include <stop_token>
#include <thread>

namespace frustumscreen::panel {

class ButtonPanel final : public Panel {
public:
    static constexpr std::size_t max_waiting = 64;
    /// Longest opening, or reading of all levels: a USB bridge that does not answer costs 5 s per transfer,
    /// until the kernel gives up, and each line takes several transfers.
    static constexpr Nanoseconds longest_round = std::chrono::seconds(60);
    /// The chord counts as released if the levels were not read for this long.
    static constexpr Nanoseconds held_for = std::chrono::milliseconds(500);

    ButtonPanel(OpenLines open, std::size_t buttons, const ButtonTimes& times);

    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<PanelEvent>& events) override;
    [[nodiscard]] std::string name() const override { return "buttons"; }
    [[nodiscard]] std::string_view state() const override { return state_.sentence.view(); }
    [[nodiscard]] DeviceCondition condition() const override { return state_.condition; }
    [[nodiscard]] bool chord_held(MonotonicTime now) const override {
        return now < held_until_.promised_until();
    }
    void light(std::uint32_t buttons) override { requested_ = buttons; }
    [[nodiscard]] std::optional<MonotonicTime> alive_until() const override {
        return heartbeat_.promised_until();
    }

private:
    void watch(const std::stop_token& stop);
    /// Serves the buttons until the device is lost or `stop` is requested.
    [[nodiscard]] Error serve(ButtonLines& lines, const std::stop_token& stop);

    OpenLines open_;
    std::size_t count_;
    ButtonTimes times_;
    Mailbox<PanelEvent, max_waiting> mailbox_;
    Latest<DeviceState> said_;
    DeviceState state_{{DeviceHealth::Away, "panel.not_opened"},
                       Sentence("its buttons are not opened yet")}; ///< the latest that `poll` saw
    std::atomic<std::uint32_t> requested_{0};                       ///< lamps
    Heartbeat heartbeat_{monotonic_now() + longest_round};
    Heartbeat held_until_{MonotonicTime{}}; ///< the chord counts as held until then
    std::jthread thread_;                   ///< last: it uses all members above
};

} // namespace frustumscreen::panel

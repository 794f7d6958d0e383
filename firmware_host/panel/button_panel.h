/// A panel of real buttons. A thread of its own waits for them; a chip that is unplugged is looked for until
/// it is back.
///
/// Threads  `poll`, `problem`: one caller, never blocked by the device. At most `most_waiting` events wait;
/// the
///          oldest give way.
/// Time     events bear the monotonic clock's time.
#pragma once

#include "firmware_host/panel/button_lines.h"
#include "firmware_host/panel/buttons.h"
#include "firmware_host/panel/panel.h"

#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

namespace frustumscreen {

class ButtonPanel final : public Panel {
public:
    static constexpr std::size_t most_waiting = 64;

    ButtonPanel(OpenLines open, std::size_t buttons, const ButtonTimes& times);

    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<PanelEvent>& events) override;
    [[nodiscard]] std::string name() const override { return "buttons"; }
    [[nodiscard]] std::string problem() const override;

private:
    void watch(const std::stop_token& stop);
    /// Until the device is lost.
    [[nodiscard]] Error serve(ButtonLines& lines, const std::stop_token& stop);
    void hand_over(const std::vector<PanelEvent>& events, bool any_stuck);
    void set_problem(std::string problem);

    OpenLines open_;
    std::size_t count_;
    ButtonTimes times_;
    mutable std::mutex mutex_; ///< guards what follows; held for a copy's time
    std::condition_variable_any stopped_;
    std::vector<PanelEvent> waiting_;
    std::string problem_;
    std::jthread thread_; ///< last: it uses all of the above
};

} // namespace frustumscreen

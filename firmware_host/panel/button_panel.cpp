#include "firmware_host/panel/button_panel.h"

#include <algorithm>

namespace frustumscreen {

namespace {

constexpr Nanoseconds look_again = std::chrono::milliseconds(500);
constexpr Nanoseconds longest_wait = std::chrono::milliseconds(100); ///< a stop is heard after that

MonotonicTime monotonic_now() {
    return MonotonicTime(std::chrono::steady_clock::now().time_since_epoch());
}

} // namespace

ButtonPanel::ButtonPanel(OpenLines open, std::size_t buttons, const ButtonTimes& times)
    : open_(std::move(open)), count_(buttons), times_(times), problem_("panel: not opened yet") {
    waiting_.reserve(most_waiting);
    thread_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

Result<void> ButtonPanel::poll(MonotonicTime now, std::vector<PanelEvent>& events) {
    const std::lock_guard lock(mutex_);
    const auto later = std::find_if(waiting_.begin(), waiting_.end(),
                                    [now](const PanelEvent& event) { return event.time > now; });
    events.insert(events.end(), waiting_.begin(), later);
    waiting_.erase(waiting_.begin(), later);
    return {};
}

std::string ButtonPanel::problem() const {
    const std::lock_guard lock(mutex_);
    return problem_;
}

void ButtonPanel::watch(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        Result<std::unique_ptr<ButtonLines>> lines = open_();
        set_problem(lines ? serve(**lines, stop).message : lines.error().message);
        lines = {}; // closed before it is looked for again
        std::unique_lock lock(mutex_);
        stopped_.wait_for(lock, stop, look_again, [] { return false; });
    }
}

Error ButtonPanel::serve(ButtonLines& lines, const std::stop_token& stop) {
    set_problem({});
    Buttons buttons(count_, times_);
    const auto down = std::make_unique<bool[]>(count_);
    const std::span<bool> levels(down.get(), count_);
    std::vector<PanelEvent> events;
    while (!stop.stop_requested()) {
        if (Result<void> read = lines.read(levels); !read) {
            return read.error();
        }
        const MonotonicTime now = monotonic_now();
        events.clear();
        buttons.sample(now, levels, events);
        if (!events.empty()) {
            hand_over(events, buttons.any_stuck());
        }
        const std::optional<MonotonicTime> due = buttons.due();
        const Nanoseconds until_due = due ? std::max(Nanoseconds(*due - now), Nanoseconds(0)) : longest_wait;
        if (Result<void> waited = lines.wait(std::min(until_due, longest_wait)); !waited) {
            return waited.error();
        }
    }
    return {ErrorKind::DeviceLost, {}};
}

void ButtonPanel::hand_over(const std::vector<PanelEvent>& events, bool any_stuck) {
    const std::lock_guard lock(mutex_);
    for (const PanelEvent& event : events) {
        if (waiting_.size() == most_waiting) {
            waiting_.erase(waiting_.begin());
        }
        waiting_.push_back(event);
    }
    problem_ = any_stuck ? "panel: a button is stuck and is ignored; free it or exchange it" : "";
}

void ButtonPanel::set_problem(std::string problem) {
    const std::lock_guard lock(mutex_);
    problem_ = std::move(problem);
}

} // namespace frustumscreen

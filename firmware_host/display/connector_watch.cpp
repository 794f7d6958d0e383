#include "firmware_host/display/connector_watch.h"

#include "firmware_host/base/device_thread.h"

#include <utility>

namespace frustumscreen::display {

namespace {

constexpr Nanoseconds between_looks_in_the_dark = std::chrono::seconds(2);
constexpr Nanoseconds between_looks_while_lit = std::chrono::seconds(1); ///< cheap: no probing
/// Over a bad cable the kernel reads a projector's EDID repeatedly, with a time limit for each try.
constexpr Nanoseconds longest_look = std::chrono::seconds(20);
/// Reading the kernel's knowledge is immediate, unless the kernel is probing a projector on its own; the
/// service manager's watchdog allows for that.
constexpr Nanoseconds longest_glance = std::chrono::milliseconds(500);

} // namespace

ConnectorWatch::ConnectorWatch(LookAtCard look, std::unique_ptr<Hotplug> hotplug,
                               std::shared_ptr<SharedCardState> shared_state)
    : look_(std::move(look)), hotplug_(std::move(hotplug)), shared_state_(std::move(shared_state)),
      heartbeat_(monotonic_now() + longest_look), thread_([this] { run(); }) {}

ConnectorWatch::~ConnectorWatch() {
    stop_ = true;
    hotplug_->wake();
    thread_.join();
}

std::optional<CardSeen> ConnectorWatch::news() {
    const std::unique_lock lock(news_mutex_, std::try_to_lock);
    return lock.owns_lock() ? std::exchange(news_, std::nullopt) : std::nullopt;
}

void ConnectorWatch::run() {
    begin_device_thread("connectors");
    std::optional<CardSeen> last;
    bool plugged = true; // the connectors at the start are news
    while (!stop_) {
        const bool thoroughly = plugged || !lit_;
        const Nanoseconds longest = thoroughly ? longest_look : longest_glance;
        const Nanoseconds others = shared_state_->has_lease ? longest_look : Nanoseconds(0);
        heartbeat_.promise(monotonic_now() + longest + others);
        CardSeen seen;
        {
            const std::lock_guard lock(shared_state_->probe_mutex);
            seen = look_(thoroughly);
        }
        if (plugged || seen != last) {
            const std::lock_guard lock(news_mutex_);
            news_ = seen;
            last = std::move(seen);
        }
        const Nanoseconds pause = lit_ ? between_looks_while_lit : between_looks_in_the_dark;
        heartbeat_.promise(monotonic_now() + pause + longest_glance + others);
        plugged = hotplug_->wait(pause);
    }
}

} // namespace frustumscreen::display

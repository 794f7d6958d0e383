/// Watches on a thread of its own what is connected to a graphics card: asking a projector may take long.
///
/// A hot-plug is looked at at once. In the dark the projectors are asked again and again, because some plug
/// in without a word; while one is lit, only what the kernel knows is looked at, because asking disturbs
/// some.
///
/// Threads  `news`, `quiet`, `set_lit`: the render thread, never blocked.
#pragma once

#include "firmware_host/base/heartbeat.h"
#include "firmware_host/display/hotplug.h"
#include "firmware_host/display/kms_mode.h"

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace frustumscreen {

/// As KmsCard::look.
using LookAtCard = std::function<CardSeen(bool thoroughly)>;

class ConnectorWatch {
public:
    ConnectorWatch(LookAtCard look, std::unique_ptr<Hotplug> hotplug);
    ~ConnectorWatch();
    ConnectorWatch(const ConnectorWatch&) = delete;
    ConnectorWatch& operator=(const ConnectorWatch&) = delete;

    /// What is connected, if that was not handed out before and changed or was plugged.
    [[nodiscard]] std::optional<CardSeen> news();
    /// While it is held nobody asks the card; not held: the card is just being asked.
    [[nodiscard]] std::unique_lock<std::mutex> quiet() { return std::unique_lock(asking_, std::try_to_lock); }
    /// Until when its thread promises to be heard of again.
    [[nodiscard]] MonotonicTime alive_until() const { return heartbeat_.promised_until(); }
    /// Is a projector lit?
    void set_lit(bool lit) { lit_ = lit; }

private:
    void run();

    LookAtCard look_;
    std::unique_ptr<Hotplug> hotplug_;
    Heartbeat heartbeat_;
    std::atomic<bool> lit_{false};
    std::atomic<bool> stop_{false};
    std::mutex asking_;
    std::mutex news_mutex_;
    std::optional<CardSeen> news_;
    std::thread thread_; ///< last: it uses all of the above
};

} // namespace frustumscreen

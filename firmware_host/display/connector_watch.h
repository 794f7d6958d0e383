/// Watches what is connected to a graphics card on its own thread, because asking a projector may take long.
///
/// It looks at once after a hot-plug. While nothing is lit it asks the projectors again and again, because
/// some plug in without an event; while one is lit it only reads what the kernel knows, because asking
/// disturbs some.
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

    /// What is connected, if it changed or was plugged and was not handed out yet.
    [[nodiscard]] std::optional<CardSeen> news();
    /// While this lock is held nobody asks the card; if it could not be taken, the card is being asked now.
    [[nodiscard]] std::unique_lock<std::mutex> quiet() { return std::unique_lock(asking_, std::try_to_lock); }
    /// Until when its thread promises to be heard from again.
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

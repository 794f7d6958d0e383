/// Watches the connectors of a graphics card on its own thread, because probing a projector may take long.
///
/// After a hot-plug event it probes at once. While no projector is lit it probes repeatedly, because some
/// projectors cause no event; while one is lit it only reads the kernel's knowledge, because probing disturbs
/// some projectors.
///
/// Threads  `news`, `quiet`, `set_lit`: the render thread; they never block.
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

namespace frustumscreen::display {

/// The state that two outputs of one card share.
struct SharedCardState {
    std::mutex probe_mutex; ///< held while a connector is probed or a mode is set
    std::atomic<bool> has_lease =
        false; ///< a probe for one output delays probes for the other, also in the kernel
};

/// As KmsCard::look.
using LookAtCard = std::function<CardSeen(bool thoroughly)>;

class ConnectorWatch {
public:
    /// `shared_state`: shared by the watches of one card. While the card has a lease, another watch's probe may delay this
    /// one's.
    ConnectorWatch(LookAtCard look, std::unique_ptr<Hotplug> hotplug,
                   std::shared_ptr<SharedCardState> shared_state = std::make_shared<SharedCardState>());
    ~ConnectorWatch();
    ConnectorWatch(const ConnectorWatch&) = delete;
    ConnectorWatch& operator=(const ConnectorWatch&) = delete;

    /// The state of the card, if it changed or an event came, and it was not returned yet.
    [[nodiscard]] std::optional<CardSeen> news();
    /// While the returned lock is held, no watch of this card asks it. If the lock does not own its mutex, the
    /// card is being asked now.
    [[nodiscard]] std::unique_lock<std::mutex> quiet() {
        return std::unique_lock(shared_state_->probe_mutex, std::try_to_lock);
    }
    /// Time until which the thread has promised a sign of life.
    [[nodiscard]] MonotonicTime alive_until() const { return heartbeat_.promised_until(); }
    /// Tells the watch whether a projector is lit.
    void set_lit(bool lit) { lit_ = lit; }

private:
    void run();

    LookAtCard look_;
    std::unique_ptr<Hotplug> hotplug_;
    std::shared_ptr<SharedCardState> shared_state_;
    Heartbeat heartbeat_;
    std::atomic<bool> lit_{false};
    std::atomic<bool> stop_{false};
    std::mutex news_mutex_;
    std::optional<CardSeen> news_;
    std::thread thread_; ///< last: it uses all members above
};

} // namespace frustumscreen::display

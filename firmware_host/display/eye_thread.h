/// A graphics card whose refreshes show two eyes' pictures in turn (EyeLayout::InTurn), kept in order by a thread: the
/// exhibit's frames may take longer than a refresh, the turns may not.
///
/// Threads  the render thread; its calls wait at most for a call of the card that is under way, except `wait_flip`.
#pragma once

#include "firmware_host/base/heartbeat.h"
#include "firmware_host/display/eye_order.h"

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

namespace frustumscreen::display {

class EyeThread final : public KmsDevice {
public:
    /// `card_file` can be read when the card reports a flip.
    EyeThread(std::unique_ptr<KmsDevice> card, int card_file);
    ~EyeThread() override;
    EyeThread(const EyeThread&) = delete;
    EyeThread& operator=(const EyeThread&) = delete;

    [[nodiscard]] KmsAnswer light(std::uint32_t connector, const ModeTiming& mode, const ScannedOut& shown,
                                  std::uint64_t ticket) override;
    [[nodiscard]] KmsAnswer flip(FramebufferId shown, std::uint64_t ticket) override;
    [[nodiscard]] KmsAnswer darken() override;
    [[nodiscard]] bool become_master() override;
    [[nodiscard]] std::optional<Flipped> wait_flip(Nanoseconds at_most) override;
    [[nodiscard]] bool flips_keep_time() const override;
    [[nodiscard]] std::string_view shortcoming() const override;
    [[nodiscard]] bool in_turn() const override;
    [[nodiscard]] std::string_view card() const override { return device_->card(); }
    [[nodiscard]] std::optional<MonotonicTime> alive_until() const override {
        return heartbeat_.promised_until();
    }
    [[nodiscard]] MonotonicTime now() const override { return device_->now(); }

private:
    void run();
    /// Returns when the card reports a flip, and after `at_most` at the latest.
    void wait_for_card(Nanoseconds at_most) const;

    std::unique_ptr<KmsDevice> device_;
    int card_file_;
    mutable std::mutex mutex_; ///< for the device and the order
    std::condition_variable turned_;
    EyeOrder order_;
    Heartbeat heartbeat_;
    std::atomic<bool> stop_{false};
    std::thread thread_; ///< last: it uses all members above
};

} // namespace frustumscreen::display

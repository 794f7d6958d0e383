#include "firmware_host/display/eye_thread.h"

#include "firmware_host/base/device_thread.h"

#include <poll.h>

#include <algorithm>
#include <ctime>
#include <utility>

namespace frustumscreen::display {

namespace {

constexpr Nanoseconds longest_rest = std::chrono::milliseconds(50);
constexpr Nanoseconds shortest_rest = std::chrono::microseconds(100);
/// A call of the card, while it sets a mode for the render thread too.
constexpr Nanoseconds longest_call = std::chrono::seconds(2);

} // namespace

EyeThread::EyeThread(std::unique_ptr<KmsDevice> card, int card_file)
    : device_(std::move(card)), card_file_(card_file), order_(*device_),
      heartbeat_(monotonic_now() + longest_call), thread_([this] { run(); }) {}

EyeThread::~EyeThread() {
    stop_ = true;
    thread_.join();
}

KmsAnswer EyeThread::light(std::uint32_t connector, const ModeTiming& mode, const ScannedOut& shown,
                           std::uint64_t ticket) {
    const std::lock_guard lock(mutex_);
    return order_.light(connector, mode, shown, ticket);
}

KmsAnswer EyeThread::flip(FramebufferId shown, std::uint64_t ticket) {
    const std::lock_guard lock(mutex_);
    return order_.flip(shown, ticket);
}

KmsAnswer EyeThread::darken() {
    const std::lock_guard lock(mutex_);
    return order_.darken();
}

bool EyeThread::become_master() {
    const std::lock_guard lock(mutex_);
    return device_->become_master();
}

std::optional<Flipped> EyeThread::wait_flip(Nanoseconds at_most) {
    std::unique_lock lock(mutex_);
    std::optional<Flipped> shown;
    turned_.wait_for(lock, at_most, [this, &shown] {
        shown = order_.next_shown();
        return shown.has_value();
    });
    return shown;
}

bool EyeThread::flips_keep_time() const {
    const std::lock_guard lock(mutex_);
    return device_->flips_keep_time();
}

std::string_view EyeThread::shortcoming() const {
    const std::lock_guard lock(mutex_);
    return device_->shortcoming();
}

bool EyeThread::in_turn() const {
    const std::lock_guard lock(mutex_);
    return order_.in_turn();
}

void EyeThread::wait_for_card(Nanoseconds at_most) const {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(at_most);
    const timespec limit{.tv_sec = seconds.count(), .tv_nsec = (at_most - seconds).count()};
    pollfd card{card_file_, POLLIN, 0};
    if (::ppoll(&card, 1, &limit, nullptr) > 0 && (card.revents & POLLIN) == 0) {
        std::this_thread::sleep_for(longest_rest); // the card is gone, and its file says so at once
    }
}

void EyeThread::run() {
    begin_device_thread("eyes");
    Nanoseconds rest = shortest_rest;
    while (!stop_) {
        heartbeat_.promise(monotonic_now() + longest_rest + longest_call);
        wait_for_card(rest);
        {
            const std::lock_guard lock(mutex_);
            order_.turn();
            rest = std::clamp(Nanoseconds(order_.due() - device_->now()), shortest_rest, longest_rest);
        }
        turned_.notify_one();
    }
}

} // namespace frustumscreen::display

// A fake graphics card and its memory that behave like the kernel's KMS, on their own clock.
#pragma once

#include "firmware_host/display/kms_device.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <string>
#include <vector>

namespace frustumscreen::display {

inline constexpr Nanoseconds one_refresh{16666667};

inline ModeTiming a_mode(int width, int height, double hz, bool preferred = false, std::uint32_t flags = 0) {
    ModeTiming mode;
    mode.width = static_cast<std::uint16_t>(width);
    mode.height = static_cast<std::uint16_t>(height);
    mode.htotal = static_cast<std::uint16_t>(width + 100);
    mode.vtotal = static_cast<std::uint16_t>(height + 20);
    const double halves = (flags & mode_interlaced) != 0 ? 2.0 : 1.0;
    mode.clock_khz =
        static_cast<std::uint32_t>(std::lround(hz / halves * mode.htotal * mode.vtotal / 1000.0));
    mode.preferred = preferred;
    mode.flags = flags;
    return mode;
}

inline ConnectorSeen a_projector(std::uint32_t id = 1, std::string name = "HDMI-A-1") {
    return {id, std::move(name), Plugged::Yes, false, false, {a_mode(1280, 800, 60.0, true)}};
}

inline CardSeen a_card(std::vector<ConnectorSeen> connectors) {
    return {CardState::There, std::move(connectors)};
}

class FakeKms final : public KmsDevice {
public:
    struct Shown {
        std::uint32_t connector = 0;
        ModeTiming mode;
        FramebufferId framebuffer = 0;
        PixelSize size;
        PixelRectangle place;
    };

    KmsAnswer light(std::uint32_t connector, const ModeTiming& mode, const ScannedOut& shown,
                    std::uint64_t ticket) override {
        if (!scales && !(shown.place == PixelRectangle{0, 0, shown.size.width, shown.size.height})) {
            ++scalings_refused;
            return KmsAnswer::Refused;
        }
        ++lights;
        if (const KmsAnswer answer = answer_to_modeset(mode); answer != KmsAnswer::Done) {
            return answer;
        }
        setting_a_mode_ = true;
        queue(Shown{connector, mode, shown.framebuffer, shown.size, shown.place}, ticket);
        return KmsAnswer::Done;
    }
    KmsAnswer flip(FramebufferId shown, std::uint64_t ticket) override {
        if (gone || !master || !screen) {
            return gone ? KmsAnswer::Gone : !master ? KmsAnswer::NotMaster : KmsAnswer::Refused;
        }
        const bool scaled = !(screen->place == PixelRectangle{0, 0, screen->size.width, screen->size.height});
        if (std::find(no_flips.begin(), no_flips.end(), screen->mode) != no_flips.end() ||
            (no_scaled_flips && scaled)) {
            return KmsAnswer::Refused;
        }
        if (!queued_.empty() || busy > 0) {
            busy -= busy > 0 ? 1 : 0;
            return KmsAnswer::Busy;
        }
        ++flips;
        Shown next = *screen;
        next.framebuffer = shown;
        queue(next, ticket);
        return KmsAnswer::Done;
    }
    KmsAnswer darken() override {
        if (const KmsAnswer answer = answer_to_modeset({}); answer != KmsAnswer::Done) {
            return answer;
        }
        ++darkenings;
        screen.reset();
        return KmsAnswer::Done;
    }
    bool become_master() override {
        master = master || !held_by_another;
        return master;
    }
    std::optional<Flipped> wait_flip(Nanoseconds at_most) override {
        const MonotonicTime give_up = time + at_most;
        if (hangs || queued_.empty() || queued_.front().at > give_up) {
            time = give_up;
            longest_wait = std::max(longest_wait, at_most);
            return std::nullopt;
        }
        const Queued done = queued_.front();
        queued_.pop_front();
        longest_wait = std::max(longest_wait, Nanoseconds(done.at - time));
        time = std::max(time, done.at);
        if (fails_later != KmsAnswer::Done) {
            return Flipped{.time = done.at, .ticket = done.ticket, .answer = fails_later};
        }
        screen = done.what;
        setting_a_mode_ = false;
        flipped = done.at;
        return Flipped{.time = done.at, .ticket = done.ticket};
    }
    /// The kernel cannot tell while a mode is being set.
    bool flips_keep_time() const override { return keeps_time && !setting_a_mode_; }
    std::string_view shortcoming() const override { return lacks; }
    bool in_turn() const override { return turns; }
    std::string_view card() const override { return "/dev/dri/card0"; }
    MonotonicTime now() const override { return time; }

    MonotonicTime time = from_microseconds(1'000'000);
    std::optional<Shown> screen; ///< shown by the projector
    std::vector<ModeTiming> refused;
    std::vector<ModeTiming> no_flips; ///< modes with memory for one picture only
    std::string_view lacks;           ///< the shortcoming it reports
    bool turns = false;               ///< it shows both halves of a framebuffer in turn
    bool scales = false;              ///< it can scale framebuffers to the mode's size
    bool no_scaled_flips = false;
    int scalings_refused = 0;
    KmsAnswer fails_later = KmsAnswer::Done; ///< of flips that were queued
    bool gone = false;
    bool master = true;
    bool held_by_another = false;
    bool hangs = false;     ///< flips never complete
    bool keeps_time = true; ///< flips complete at refreshes; otherwise immediately
    MonotonicTime flipped;  ///< time of the last flip
    int busy = 0;           ///< number of calls that are answered Busy
    int lights = 0;
    int flips = 0;
    int darkenings = 0;
    Nanoseconds longest_wait{0};

private:
    struct Queued {
        MonotonicTime at;
        std::uint64_t ticket = 0;
        Shown what;
    };
    KmsAnswer answer_to_modeset(const ModeTiming& mode) {
        if (gone) {
            return KmsAnswer::Gone;
        }
        if (!master) {
            return KmsAnswer::NotMaster;
        }
        if (busy > 0 || (hangs && !queued_.empty())) {
            busy -= busy > 0 ? 1 : 0;
            return KmsAnswer::Busy;
        }
        const bool refuses = std::find(refused.begin(), refused.end(), mode) != refused.end();
        return refuses ? KmsAnswer::Refused : KmsAnswer::Done;
    }
    void queue(const Shown& what, std::uint64_t ticket) {
        const auto refreshes = time.time_since_epoch() / one_refresh + 1;
        queued_.push_back({keeps_time ? MonotonicTime(refreshes * one_refresh) : time, ticket, what});
    }
    std::deque<Queued> queued_;
    bool setting_a_mode_ = false;
};

/// Counts the filled pictures; every pair has its own framebuffers.
struct FakeMemory {
    int pairs = 0;
    int alive = 0;
    int fills = 0;
    PixelRectangle filled; ///< most recent part
    PixelSize size;        ///< of the newest pair
    bool none_left = false;

    class Pair final : public ScanoutPair {
    public:
        Pair(FakeMemory& memory, PixelSize size, int number) : memory_(memory), size_(size), number_(number) {
            ++memory_.alive;
        }
        ~Pair() override { --memory_.alive; }
        Pair(const Pair&) = delete;
        Pair& operator=(const Pair&) = delete;
        PixelSize size() const override { return size_; }
        FramebufferId fill(int which, const PixelRectangle& part) override {
            ++memory_.fills;
            memory_.filled = part;
            return name(which);
        }
        /// Every byte of its pixels is its framebuffer's id.
        bool read(int which, std::span<std::byte> rgba) const override {
            std::fill(rgba.begin(), rgba.end(), static_cast<std::byte>(name(which)));
            return true;
        }

    private:
        [[nodiscard]] FramebufferId name(int which) const {
            return static_cast<FramebufferId>(10 * number_ + which);
        }
        FakeMemory& memory_;
        PixelSize size_;
        int number_;
    };

    MakeScanout maker() {
        return [this](PixelSize size) -> Result<std::unique_ptr<ScanoutPair>> {
            if (none_left) {
                return fail(ErrorKind::BadConfiguration, "test.device", "no memory");
            }
            this->size = size;
            return std::make_unique<Pair>(*this, size, ++pairs);
        };
    }
};

} // namespace frustumscreen::display

/// The order of two eyes' pictures on a screen that shows them in turn: refreshes of even number show the left eye's, the
/// upper half of the framebuffer, and refreshes of odd number the right eye's, the lower half.
///
/// A page flip is queued for every refresh, also while the picture stays the same. The parity of the card's refresh number
/// selects the eye, so a late flip costs one refresh and the order of the eyes is kept. If the next refresh is too near, the flip
/// waits for the one after it. A new framebuffer replaces the previous one for both eyes, beginning with the eye that is
/// next.
///
/// A card whose flips do not keep time, or that cannot change the shown rows in a flip, shows the left eye's picture alone.
///
/// Time     the card's clock. `turn` is due after each of the card's flips, and at `due`.
/// Threads  one at a time (eye_thread.h).
/// Errors   the kernel's answers, at once or with `next_shown`.
#pragma once

#include "firmware_host/display/kms_device.h"

#include <optional>

namespace frustumscreen::display {

class EyeOrder {
public:
    explicit EyeOrder(KmsDevice& card) : card_(card) {}

    /// As those of KmsDevice. The framebuffer holds the left eye's rows, `shown.size.height` of them, and as many of
    /// the right eye's below. After Done, `next_shown` reports the flip, or that it failed. Busy: the flip for the
    /// next refresh is not done, so no further one can be queued; try again.
    [[nodiscard]] KmsAnswer light(std::uint32_t connector, const ModeTiming& mode, const ScannedOut& shown,
                                  std::uint64_t ticket);
    [[nodiscard]] KmsAnswer flip(FramebufferId shown, std::uint64_t ticket);
    [[nodiscard]] KmsAnswer darken();

    /// Takes the card's flips, and flips for the next refresh.
    void turn();
    /// When `turn` has something to do, if no flip comes before.
    [[nodiscard]] MonotonicTime due() const;
    /// The first flip to the framebuffer of the last `light` or `flip`, or its failure; once.
    [[nodiscard]] std::optional<Flipped> next_shown();
    /// Whether both eyes' pictures are shown.
    [[nodiscard]] bool in_turn() const { return refusals_ < max_refusals && card_.flips_keep_time(); }

private:
    /// After this many refusals the card counts as unable to change the shown rows in a flip.
    static constexpr int max_refusals = 3;

    struct Picture {
        FramebufferId framebuffer = 0;
        std::uint64_t ticket = 0; ///< the caller's
    };
    struct Queued {
        Picture picture;
        int first_row = 0;
        MonotonicTime at;
    };

    void take_flips();
    void take(const Flipped& flipped);
    /// Queues a flip for the next refresh, unless one is queued. Also Done if there is nothing to do yet.
    [[nodiscard]] KmsAnswer flip_on();
    /// True if the card has accepted a flip to the next picture; its event may be lost.
    [[nodiscard]] bool next_is_taken() const;
    /// The first row of the eye of the next refresh; nullopt: a flip may miss that refresh.
    [[nodiscard]] std::optional<int> next_row(MonotonicTime now);

    KmsDevice& card_;
    Nanoseconds period_{1};
    int right_row_ = 0; ///< the right eye's first row
    Flipped last_;      ///< the card's last flip
    std::optional<Picture> shown_;
    std::optional<Picture> next_; ///< not shown yet
    MonotonicTime next_since_;
    std::optional<Queued> queued_;
    std::uint64_t ticket_ = 0; ///< of the last call of the card
    std::optional<MonotonicTime> not_before_;
    std::optional<Flipped> news_;        ///< for `next_shown`
    KmsAnswer failed_ = KmsAnswer::Done; ///< for the next `flip`: a flip without news failed
    bool stopped_ = false;               ///< no flip until the caller's next picture
    bool right_shown_ = false;           ///< since `light`
    int refusals_ = 0;                   ///< of flips before the right eye's first
};

} // namespace frustumscreen::display

/// The presenter: the state machine that turns the exhibit's pictures into flips on a projector that may be
/// plugged in and out at any time.
///
/// Without a projector, pictures are accepted but not shown; when a projector appears, the next picture
/// lights it.
///
/// `stay_dark` turns the projector off, as DPMS does, whatever is plugged in or out; the next picture lights
/// it again.
///
/// If the picture holds two above each other (EyeLayout::InTurn), the device shows one at each refresh; both are replaced
/// together.
///
/// A picture without a size is drawn in the mode's size. If picture and mode differ in size, the card's own
/// scaler fills the mode if it can; otherwise the picture is scaled while it is copied.
///
/// Time     the device's clock; `present` waits at most `flip_timeout`, for the previous flip.
/// Threads  the render thread.
/// Errors   the card has returned after it was gone, or has taken no picture for `stuck_given_up`, or the
///          projector is at another card: the program must be restarted.
#pragma once

#include "firmware_host/base/device_state.h"
#include "firmware_host/display/flip_clock.h"
#include "firmware_host/display/kms_device.h"

#include <array>
#include <string_view>
#include <vector>

namespace frustumscreen::display {

/// Longest wait for a flip before the exhibit continues without it: fifteen refreshes of 60 Hz.
inline constexpr Nanoseconds flip_timeout = std::chrono::milliseconds(250);
/// After this time a missing flip is given up, and the projector is lit again.
inline constexpr Nanoseconds flip_given_up = std::chrono::seconds(2);
/// A card that takes no picture for this long, although a projector is there, hangs.
inline constexpr Nanoseconds stuck_given_up = std::chrono::seconds(10);
/// Pause between attempts to light a projector.
inline constexpr Nanoseconds between_tries = std::chrono::seconds(1);

class Presenter {
public:
    Presenter(KmsDevice& device, MakeScanout make_scanout, OutputRequest request);

    /// Takes the connectors' state after each probe.
    void connected(CardSeen seen);
    /// Shows the picture if there is a projector; returns the time of its flip, otherwise now. `changed` is
    /// the part of the picture that changed since the previous call. `may_set`: a mode may be set now,
    /// because no other thread is asking the card.
    [[nodiscard]] Result<MonotonicTime> present(const PixelRectangle& changed, bool may_set);

    /// Whether `present` would not wait. A flip that does not come is noticed here too, as in `present`.
    [[nodiscard]] bool takes_picture();

    /// Keeps the projector dark; call it in place of `present`. `may_set` and errors as there.
    [[nodiscard]] Result<void> stay_dark(bool may_set);

    /// Waits at most `flip_timeout`; true: the picture presented last is on the screen.
    [[nodiscard]] bool wait_until_shown();

    [[nodiscard]] bool lit() const { return lit_.has_value(); }
    /// Whether the first picture is shown, or no projector can take one now.
    [[nodiscard]] bool settled() const { return lit_ ? lit_->shown : looked_ && !about_to_light(); }
    /// Reads the first pixels of the top row of the framebuffer that flipped last, as RGBA codes; false: none
    /// is lit.
    [[nodiscard]] bool read_shown(std::span<std::byte> rgba) const;
    [[nodiscard]] std::string_view state() const { return state_.sentence.view(); }
    [[nodiscard]] DeviceCondition condition() const { return state_.condition; }
    [[nodiscard]] MonotonicTime next_frame(MonotonicTime now, Nanoseconds period) const {
        return clock_.next_frame(now, period);
    }

private:
    struct Lit {
        std::uint32_t connector = 0;
        std::string name;
        ModeTiming mode;
        bool as_requested = true; ///< the mode satisfies the settings
        bool blindly = false;     ///< the connector reports that nothing is connected
        bool shown = false;       ///< the flip to its first picture is done
        bool flips = false;       ///< it has shown more than its first picture
        bool in_turn = false;     ///< the last sentence's: both eyes' pictures are shown in turn
    };
    struct Queued {
        MonotonicTime at;
        std::uint64_t ticket = 0;
        int framebuffer = 0;
    };

    [[nodiscard]] bool about_to_light() const {
        return !try_again_ && choose_connector(seen_, request_) != nullptr;
    }
    [[nodiscard]] Result<void> check_card();
    void take_ready_flips();
    void wake();
    void wait_for_flip();
    void note_late();
    void give_up_flip();
    void take(const Flipped& flipped);
    /// Whether the lit output is still the right one.
    [[nodiscard]] bool still_right() const;
    void darken();
    void light();
    [[nodiscard]] bool light(const ConnectorSeen& connector, const ModeTiming& mode);
    /// `size`: of what the screen shows of the framebuffer.
    [[nodiscard]] bool light(const ConnectorSeen& connector, const ModeTiming& mode, PixelSize size);
    void flip();
    void flip_failed(KmsAnswer answer);
    /// The framebuffer of which the screen shows `size`.
    [[nodiscard]] PixelSize framebuffer_for(PixelSize size) const;
    [[nodiscard]] bool make_scanout(PixelSize size);
    /// Updates the framebuffer that is not shown.
    [[nodiscard]] FramebufferId fill();
    /// Acts on any answer other than Done.
    void went_wrong(KmsAnswer answer);
    void lose(MessageId id, std::string_view why);
    void lose_card();
    void say_lit();

    KmsDevice& device_;
    MakeScanout make_scanout_;
    OutputRequest request_;
    CardSeen seen_;
    std::unique_ptr<ScanoutPair> scanout_;
    std::unique_ptr<ScanoutPair> shown_before_; ///< the old pair, until the new one is shown
    std::array<PixelRectangle, 2> stale_{};     ///< the part of the picture that each framebuffer lacks
    std::optional<Lit> lit_;
    std::optional<Queued> queued_;
    FlipClock clock_;
    std::optional<MonotonicTime> try_again_;   ///< no attempt to light before this time
    std::optional<MonotonicTime> stuck_since_; ///< the card has taken no picture since
    bool looked_ = false;                      ///< the connectors' state is known
    bool card_scales_ = true;                  ///< true until the card refuses
    Sentence no_memory_;                       ///< why the last framebuffers could not be made; else empty
    std::vector<ModeTiming> unfit_;            ///< showed only one picture: the card lacks memory for more
    std::uint64_t ticket_ = 0;
    int free_ = 0;      ///< the framebuffer that is not shown
    bool late_ = false; ///< the queued flip did not come in time
    bool master_ = true;
    bool darken_ = false; ///< turn off the lit output
    enum class Sleep : std::uint8_t { None, Wanted, Dark };
    Sleep sleep_ = Sleep::None; ///< dark on purpose: to be turned off, or turned off
    DeviceState state_;
};

} // namespace frustumscreen::display

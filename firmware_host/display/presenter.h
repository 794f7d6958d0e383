/// The output's state machine: turns the exhibit's pictures into flips on a projector that comes and goes.
///
/// Without a projector, pictures are accepted and not shown; when one comes, the next picture lights it.
///
/// Dark on purpose, with `stay_dark`, it is turned off as DPMS does, whatever comes and goes; the next picture lights it.
///
/// A picture without a size of its own is drawn in the mode's. A mode of another size than the picture's is filled by the card's own scaler where it has one, else the
/// picture is scaled on its way into memory.
///
/// Time     the device's clock; `present` waits at most `flip_patience`, for the flip before.
/// Threads  the render thread.
/// Errors   a card that is back after it was gone, or that takes no picture for `stuck_given_up`, or a
///          projector at another card: the program must be started again.
#pragma once

#include "firmware_host/base/device_state.h"
#include "firmware_host/display/flip_clock.h"
#include "firmware_host/display/kms_device.h"

#include <array>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// How long a flip may take before the exhibit goes on without it: fifteen refreshes of 60 Hz.
inline constexpr Nanoseconds flip_patience = std::chrono::milliseconds(250);
/// A flip that does not come for so long is given up and the projector lit anew.
inline constexpr Nanoseconds flip_given_up = std::chrono::seconds(2);
/// A card that takes no picture for so long, though a projector is there, hangs.
inline constexpr Nanoseconds stuck_given_up = std::chrono::seconds(10);
/// Between tries to light a projector that could not be lit.
inline constexpr Nanoseconds between_tries = std::chrono::seconds(1);

class Presenter {
public:
    Presenter(KmsDevice& device, MakeScanout make_scanout, OutputRequest request);

    /// Takes what is connected, after each new look.
    void connected(CardSeen seen);
    /// Shows the picture where there is a projector; returns the time at which it flips, else now. `changed`:
    /// the part of the picture that changed since the call before. `may_set`: this is a good moment to set a
    /// mode, because nobody else is asking the card.
    [[nodiscard]] Result<MonotonicTime> present(const PixelRectangle& changed, bool may_set);

    /// Keeps the projector dark, in place of `present`; `may_set` and errors as there.
    [[nodiscard]] Result<void> stay_dark(bool may_set);

    /// Waits at most `flip_patience`; true: the picture presented last is on the screen.
    [[nodiscard]] bool wait_until_shown();

    [[nodiscard]] bool lit() const { return lit_.has_value(); }
    /// The first picture is shown, or it is known that no projector takes one now.
    [[nodiscard]] bool settled() const { return lit_ ? lit_->shown : looked_ && !about_to_light(); }
    /// Reads the first pixels of the top row of the framebuffer that flipped last, RGBA codes; false: none is
    /// lit.
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
        bool as_requested = true; ///< it is the mode that the settings ask for
        bool blindly = false;     ///< the connector says that nothing is connected
        bool shown = false;       ///< its first picture was flipped to
        bool flips = false;       ///< it has shown more than its first picture
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
    void take_flips();
    void wake();
    void wait_for_flip();
    void take(const Flipped& flipped);
    /// Is what is lit still what should be lit?
    [[nodiscard]] bool still_right() const;
    void darken();
    void light();
    [[nodiscard]] bool light(const ConnectorSeen& connector, const ModeTiming& mode);
    [[nodiscard]] bool light(const ConnectorSeen& connector, const ModeTiming& mode, PixelSize framebuffer);
    void flip();
    [[nodiscard]] bool make_scanout(PixelSize size);
    /// Brings the framebuffer that is not shown up to date.
    [[nodiscard]] FramebufferId fill();
    /// Acts on an answer other than Done.
    void went_wrong(KmsAnswer answer);
    void lose(MessageId id, std::string_view why);
    void lose_card();
    void say_lit();

    KmsDevice& device_;
    MakeScanout make_scanout_;
    OutputRequest request_;
    CardSeen seen_;
    std::unique_ptr<ScanoutPair> scanout_;
    std::unique_ptr<ScanoutPair> shown_before_; ///< until what is new is shown
    std::array<PixelRectangle, 2> stale_{};     ///< the part of the picture that each framebuffer lacks
    std::optional<Lit> lit_;
    std::optional<Queued> queued_;
    FlipClock clock_;
    std::optional<MonotonicTime> try_again_;   ///< not before
    std::optional<MonotonicTime> stuck_since_; ///< the card took no picture since
    bool looked_ = false;                      ///< what is connected is known
    bool card_scales_ = true;                  ///< true until it refuses
    Sentence no_memory_;            ///< why the last framebuffers could not be made; empty: they could
    std::vector<ModeTiming> unfit_; ///< lit, but showed only one picture: the card has no memory for more
    std::uint64_t ticket_ = 0;
    int free_ = 0;      ///< the framebuffer that is not shown
    bool late_ = false; ///< the queued flip did not come in time
    bool master_ = true;
    bool darken_ = false; ///< what was lit is to be turned off
    enum class Rest : std::uint8_t { None, Wanted, Dark };
    Rest rest_ = Rest::None; ///< dark on purpose: to be turned off, or turned off
    DeviceState state_;
};

} // namespace frustumscreen

/// The projector on a connector of this machine's graphics card.
///
/// For EyeLayout::InTurn the picture is twice as high as what the projector shows: the left eye's above the right eye's.
///
/// The renderer draws into one framebuffer object of the picture's size. Each picture is copied from there to
/// the scanned-out framebuffer, scaled if the projector's mode has another size, so plugging, unplugging or
/// exchanging the projector never affects the renderer.
///
/// Time     CLOCK_MONOTONIC, from the card's page flips.
/// Threads  the creating thread, on which the context is current. Another thread probes the connectors; a third one flips
///          from eye to eye, if the eyes' pictures are shown in turn.
/// Errors   at the start: no card, no permission, no OpenGL ES 3. Later: the card has returned after it was
///          gone, it hangs, or the projector is now at another card. `state` describes all other faults.
#pragma once

#include "firmware_host/display/card_screen.h"
#include "firmware_host/display/connector_watch.h"
#include "firmware_host/display/display.h"
#include "firmware_host/display/kms_card.h"
#include "firmware_host/display/presenter.h"

#include <memory>
#include <string_view>

namespace frustumscreen::display {

/// The card's device. It has a thread only if the eyes' pictures are shown in turn. Without atomic commits no flip
/// can change the shown rows: the left eye's are shown.
[[nodiscard]] std::unique_ptr<KmsDevice> make_device(const KmsCard& card, EyeLayout eyes);

class KmsDisplay final : public Display {
public:
    /// `card`: as KmsCard::open; the size of what the projector shows is in `request`.
    [[nodiscard]] static Result<std::unique_ptr<KmsDisplay>> create(std::string_view card,
                                                                    const OutputRequest& request);

    /// The screen's output beside the projector's: on its card by a lease, or on another card. `projector` may be closed
    /// first.
    [[nodiscard]] static Result<std::unique_ptr<KmsDisplay>>
    create_beside(KmsDisplay& projector, std::string_view card, const OutputRequest& request);

    [[nodiscard]] bool make_current() const override { return screen_->gpu().context().make_current(); }
    [[nodiscard]] int width() const override { return screen_->picture().width(); }
    [[nodiscard]] int height() const override { return screen_->picture().height(); }
    [[nodiscard]] unsigned framebuffer() const override { return screen_->picture().name(); }
    [[nodiscard]] int buffer_age() const override { return presented_ ? 1 : 0; }
    void changed(const PixelRectangle& part) override { changed_ = united(changed_, part); }
    /// Waits until the picture is drawn, and at most `flip_timeout` for the previous flip.
    [[nodiscard]] Result<MonotonicTime> present(MonotonicTime now) override;
    [[nodiscard]] bool takes_picture() override;
    [[nodiscard]] Result<void> stay_dark() override;
    [[nodiscard]] MonotonicTime next_frame(MonotonicTime now, Nanoseconds period) const override {
        return presenter_.next_frame(now, period);
    }
    [[nodiscard]] bool read_shown(std::span<std::byte> rgba) const override {
        return presenter_.read_shown(rgba);
    }
    [[nodiscard]] bool settled() const override { return presenter_.settled(); }
    [[nodiscard]] std::optional<MonotonicTime> alive_until() const override;
    [[nodiscard]] std::string name() const override { return card_.path() + ", " + gl_driver_name(); }
    [[nodiscard]] std::string_view state() const override { return presenter_.state(); }
    [[nodiscard]] DeviceCondition condition() const override { return presenter_.condition(); }

private:
    void take_news();
    [[nodiscard]] static Result<std::unique_ptr<KmsDisplay>> on(KmsCard card, bool any_card,
                                                                const OutputRequest& request);

    KmsDisplay(KmsCard card, bool any_card, std::unique_ptr<CardScreen> screen, const OutputRequest& request);

    KmsCard card_;
    OutputRequest request_;
    std::optional<OtherCards> other_cards_; ///< used by the watch's thread; none: a named card
    std::unique_ptr<CardScreen> screen_;
    std::unique_ptr<KmsDevice> kms_;
    Presenter presenter_;
    bool presented_ = false;
    PixelRectangle changed_; ///< empty: `changed` was not called
    ConnectorWatch watch_;   ///< last: its thread uses the card
};

} // namespace frustumscreen::display

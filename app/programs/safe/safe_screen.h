/// The safe picture on the first projector that there is, by the kernel's mode setting alone: no EGL, no OpenGL, no udev.
///
/// Threads  one. `show` draws on it, asks the card what is connected, and waits for the flip.
/// Errors   at the start: no card, no permission, another program holds the screen. Later: the card hangs or is back after it was
///          gone, or a projector is at another card: the program must be started again.
#pragma once

#include "app/programs/safe/safe_scanout.h"
#include "firmware_host/display/kms_card.h"
#include "firmware_host/display/presenter.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen {

class SafeScreen {
public:
    /// `card`: as KmsCard::open. `languages`: of lay_out_safe_page.
    [[nodiscard]] static Result<std::unique_ptr<SafeScreen>> open(const std::string& card,
                                                                  std::vector<std::string_view> languages);

    /// Takes up what is connected now and shows the picture with another code. True: it is on the screen.
    [[nodiscard]] Result<bool> show(const SafeText& text);
    [[nodiscard]] bool lit() const { return presenter_.lit(); }
    /// A sentence about the projector.
    [[nodiscard]] std::string_view state() const { return presenter_.state(); }

private:
    SafeScreen(KmsCard card, bool any_card, std::vector<std::string_view> languages);

    KmsCard card_;
    std::optional<OtherCards> other_cards_; ///< none: this card was asked for
    SafePicture picture_;
    std::unique_ptr<KmsDevice> kms_;
    Presenter presenter_;
    std::optional<CardSeen> seen_;
    int pictures_since_asked_ = 0; ///< what is connected
};

} // namespace frustumscreen

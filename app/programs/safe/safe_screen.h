/// The safe picture on the first projector found, only by the kernel's mode setting: no EGL, no OpenGL, no
/// udev.
///
/// Threads  one. `show` draws on it, asks the card for its connectors, and waits for the flip.
/// Errors   at the start: no card, no permission, another program holds the screen. Later: the card hangs,
///          has returned after it was gone, or a projector is at another card: the program must be restarted.
#pragma once

#include "app/programs/safe/safe_scanout.h"
#include "firmware_host/display/kms_card.h"
#include "firmware_host/display/presenter.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen::programs {

class SafeScreen {
public:
    /// `card`: as KmsCard::open. `languages`: as lay_out_safe_page.
    [[nodiscard]] static Result<std::unique_ptr<SafeScreen>>
    open(const std::string& card, std::vector<std::string_view> languages,
         safe::EyeHalves halves = safe::EyeHalves::None);

    /// Checks the connectors and shows the picture with the next code. Returns true if it is on the screen.
    [[nodiscard]] Result<bool> show(const safe::SafeText& text);
    [[nodiscard]] bool lit() const { return presenter_.lit(); }
    /// A sentence about the projector.
    [[nodiscard]] std::string_view state() const { return presenter_.state(); }

private:
    SafeScreen(display::KmsCard card, bool any_card, std::vector<std::string_view> languages,
               safe::EyeHalves halves);

    display::KmsCard card_;
    std::optional<display::OtherCards> other_cards_; ///< none: the card was named
    SafePicture picture_;
    std::unique_ptr<display::KmsDevice> kms_;
    display::Presenter presenter_;
    std::optional<display::CardSeen> seen_;
    int pictures_since_asked_ = 0; ///< since the connectors were last probed
};

} // namespace frustumscreen::programs

#include "app/programs/safe/safe_screen.h"

#include <fmt/format.h>

#include <utility>

namespace frustumscreen::programs {

namespace {
constexpr int pictures_between_asking = 10;
} // namespace

Result<std::unique_ptr<SafeScreen>>
SafeScreen::open(const std::string& name, std::vector<std::string_view> languages, safe::EyeHalves halves) {
    TRY(display::KmsCard card, display::KmsCard::open(name, {}));
    if (!display::take_screen(card.file())) {
        return fail(ErrorKind::DeviceLost, "safe.screen_held",
                    "another program holds the screen of {}; end it, or wait until it has ended",
                    card.path());
    }
    return std::unique_ptr<SafeScreen>(
        new SafeScreen(std::move(card), name.empty(), std::move(languages), halves));
}

SafeScreen::SafeScreen(display::KmsCard card, bool any_card, std::vector<std::string_view> languages,
                       safe::EyeHalves halves)
    : card_(std::move(card)),
      other_cards_(any_card ? std::optional<display::OtherCards>(display::OtherCards(card_.path(), {}))
                            : std::nullopt),
      picture_{.languages = std::move(languages), .text = {}, .code = 0, .halves = halves},
      kms_(display::make_kms_device(card_)),
      presenter_(*kms_, [this](PixelSize size) { return SafeScanout::make(card_.file(), size, picture_); },
                 {}) {}

Result<bool> SafeScreen::show(const safe::SafeText& text) {
    // The kernel notices an unplugged projector by itself, but another mode only when the projector is
    // probed, which disturbs some projectors. Without udev no event triggers the probe.
    const bool thoroughly = !presenter_.lit() || ++pictures_since_asked_ >= pictures_between_asking;
    pictures_since_asked_ = thoroughly ? 0 : pictures_since_asked_;
    display::CardSeen seen =
        display::look_for_projector(card_, other_cards_ ? &*other_cards_ : nullptr, {}, thoroughly);
    display::add_usual_modes(seen);
    if (seen != seen_) {
        presenter_.connected(seen);
        seen_ = std::move(seen);
    }
    picture_.text = text;
    ++picture_.code;
    TRY_VOID(presenter_.present({}, true));
    return presenter_.wait_until_shown();
}

} // namespace frustumscreen::programs

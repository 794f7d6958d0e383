#include "firmware_host/display/kms_display.h"

#include <GLES3/gl31.h>
#include <fmt/format.h>

#include <utility>

namespace frustumscreen {

Result<std::unique_ptr<KmsDisplay>> KmsDisplay::create(std::string_view card_name, const OutputWish& wish) {
    Result<KmsCard> card = KmsCard::open(card_name);
    if (!card) {
        return tl::unexpected<Error>(card.error());
    }
    if (!take_screen(card->file())) {
        return fail(
            ErrorKind::DeviceLost, // opened anew later, it may be had
            fmt::format("display: another program holds the screen of {}; end it, or run with --headless",
                        card->path()));
    }
    Result<std::unique_ptr<CardScreen>> screen =
        CardScreen::create(card->file(), {wish.picture_width, wish.picture_height});
    if (!screen) {
        return tl::unexpected<Error>(screen.error());
    }
    return std::unique_ptr<KmsDisplay>(new KmsDisplay(std::move(*card), std::move(*screen), wish));
}

KmsDisplay::KmsDisplay(KmsCard card, std::unique_ptr<CardScreen> screen, const OutputWish& wish)
    : card_(std::move(card)), screen_(std::move(screen)), kms_(card_),
      presenter_(
          kms_, [this](PixelSize size) { return screen_->make_pair(size); }, wish),
      watch_([this](bool thoroughly) { return card_.look(thoroughly); }, make_udev_hotplug()) {}

Result<MonotonicTime> KmsDisplay::present(MonotonicTime /*now*/) {
    glFinish(); // in the dark too: the exhibit's pace and its watchdog do not depend on a projector
    presented_ = true;
    if (std::optional<CardSeen> seen = watch_.news()) {
        presenter_.connected(std::move(*seen));
    }
    const PixelPlace told = std::exchange(changed_, {});
    const std::unique_lock quiet = watch_.quiet();
    Result<MonotonicTime> shown =
        presenter_.present(told.empty() ? PixelPlace{0, 0, width(), height()} : told, quiet.owns_lock());
    watch_.set_lit(presenter_.lit());
    return shown;
}

} // namespace frustumscreen

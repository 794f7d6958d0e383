#include "firmware_host/display/kms_display.h"

#include "firmware_host/display/atomic_kms.h"
#include "firmware_host/display/legacy_kms.h"

#include <GLES3/gl31.h>
#include <fmt/format.h>

#include <utility>

namespace frustumscreen {

namespace {

std::unique_ptr<KmsDevice> make_device(const KmsCard& card) {
    if (card.is_atomic()) {
        return std::make_unique<AtomicKms>(card);
    }
    return std::make_unique<LegacyKms>(card);
}

} // namespace

Result<std::unique_ptr<KmsDisplay>> KmsDisplay::create(std::string_view card_name,
                                                       const OutputRequest& request) {
    Result<KmsCard> card = KmsCard::open(card_name, request);
    if (!card) {
        return tl::unexpected<Error>(card.error());
    }
    if (!take_screen(card->file())) {
        return fail(
            ErrorKind::DeviceLost, // it may be free when it is opened again later
            fmt::format("display: another program holds the screen of {}; end it, or run with --headless",
                        card->path()));
    }
    Result<std::unique_ptr<CardScreen>> screen =
        CardScreen::create(card->file(), {request.picture_width, request.picture_height});
    if (!screen) {
        return tl::unexpected<Error>(screen.error());
    }
    return std::unique_ptr<KmsDisplay>(
        new KmsDisplay(std::move(*card), card_name.empty(), std::move(*screen), request));
}

KmsDisplay::KmsDisplay(KmsCard card, bool any_card, std::unique_ptr<CardScreen> screen,
                       const OutputRequest& request)
    : card_(std::move(card)), request_(request),
      other_cards_(any_card ? std::optional<OtherCards>(OtherCards(card_.path(), request)) : std::nullopt),
      screen_(std::move(screen)), kms_(make_device(card_)),
      presenter_(
          *kms_, [this](PixelSize size) { return screen_->make_pair(size); }, request),
      watch_([this](bool thoroughly) { return look(thoroughly); }, make_udev_hotplug()) {}

CardSeen KmsDisplay::look(bool thoroughly) {
    CardSeen seen = card_.look(thoroughly);
    if (other_cards_ && seen.state == CardState::There && choose_connector(seen, request_) == nullptr &&
        other_cards_->have_projector()) {
        seen.state = CardState::Elsewhere;
    }
    return seen;
}

Result<MonotonicTime> KmsDisplay::present(MonotonicTime /*now*/) {
    glFinish(); // without a projector too: the exhibit's pace and its watchdog do not depend on one
    presented_ = true;
    if (std::optional<CardSeen> seen = watch_.news()) {
        presenter_.connected(std::move(*seen));
    }
    const PixelRectangle told = std::exchange(changed_, {});
    const std::unique_lock quiet = watch_.quiet();
    Result<MonotonicTime> shown =
        presenter_.present(told.empty() ? PixelRectangle{0, 0, width(), height()} : told, quiet.owns_lock());
    watch_.set_lit(presenter_.lit());
    return shown;
}

} // namespace frustumscreen

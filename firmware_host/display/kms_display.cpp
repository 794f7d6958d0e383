#include "firmware_host/display/kms_display.h"

#include "firmware_host/display/eye_thread.h"

#include <GLES3/gl31.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace frustumscreen::display {

namespace {

/// Also if one path is a link, as in /dev/dri/by-path.
bool same_card(const std::string& one, const std::string& other) {
    std::error_code failed;
    return one == other || std::filesystem::equivalent(one, other, failed);
}

} // namespace

std::unique_ptr<KmsDevice> make_device(const KmsCard& card, EyeLayout eyes) {
    std::unique_ptr<KmsDevice> device = make_kms_device(card);
    if (eyes == EyeLayout::InTurn && card.is_atomic()) {
        return std::make_unique<EyeThread>(std::move(device), card.file());
    }
    return device;
}

Result<std::unique_ptr<KmsDisplay>> KmsDisplay::create(std::string_view card_name,
                                                       const OutputRequest& request) {
    Result<KmsCard> card = KmsCard::open(card_name, request);
    if (!card) {
        Error error = card.error();
        if (error.kind == ErrorKind::DeviceLost && card_name.empty()) {
            error.message += ", or run with --headless";
        }
        return tl::unexpected<Error>(std::move(error));
    }
    return on(std::move(*card), card_name.empty(), request);
}

Result<std::unique_ptr<KmsDisplay>>
KmsDisplay::create_beside(KmsDisplay& projector, std::string_view card_name, const OutputRequest& request) {
    Result<KmsCard> card = KmsCard::open(card_name, request);
    if (card && !same_card(card->path(), projector.card_.path())) {
        return on(std::move(*card), card_name.empty(), request);
    }
    if (!card) {
        return tl::unexpected<Error>(card.error());
    }
    TRY(KmsCard lease, projector.card_.lease(request, projector.request_.connector));
    return on(std::move(lease), false, request);
}

Result<std::unique_ptr<KmsDisplay>> KmsDisplay::on(KmsCard card, bool any_card,
                                                   const OutputRequest& request) {
    if (!card.become_master()) {
        return fail(ErrorKind::DeviceLost, "display.screen_held", // it may be free at a later attempt
                    "display: another program holds the screen of {}; end it, or run with --headless",
                    card.path());
    }
    TRY(std::unique_ptr<CardScreen> screen,
        CardScreen::create(card.memory_file(), {request.picture_width, request.picture_height},
                           request.eyes));
    return std::unique_ptr<KmsDisplay>(new KmsDisplay(std::move(card), any_card, std::move(screen), request));
}

KmsDisplay::KmsDisplay(KmsCard card, bool any_card, std::unique_ptr<CardScreen> screen,
                       const OutputRequest& request)
    : card_(std::move(card)), request_(request),
      other_cards_(any_card ? std::optional<OtherCards>(OtherCards(card_.path(), request)) : std::nullopt),
      screen_(std::move(screen)), kms_(make_device(card_, request.eyes)),
      presenter_(
          *kms_, [this](PixelSize size) { return screen_->make_pair(size); }, request),
      watch_(
          [this](bool thoroughly) {
              return look_for_projector(card_, other_cards_ ? &*other_cards_ : nullptr, request_, thoroughly);
          },
          make_udev_hotplug(), card_.shared_state()) {}

std::optional<MonotonicTime> KmsDisplay::alive_until() const {
    return std::min(watch_.alive_until(), kms_->alive_until().value_or(MonotonicTime::max()));
}

void KmsDisplay::take_news() {
    if (std::optional<CardSeen> seen = watch_.news()) {
        presenter_.connected(std::move(*seen));
    }
}

bool KmsDisplay::takes_picture() {
    take_news();
    const bool takes = presenter_.takes_picture();
    watch_.set_lit(presenter_.lit());
    return takes;
}

/// A projector that sleeps is not probed, because that wakes some.
Result<void> KmsDisplay::stay_dark() {
    take_news();
    const std::unique_lock quiet = watch_.quiet();
    Result<void> dark = presenter_.stay_dark(quiet.owns_lock());
    watch_.set_lit(true);
    return dark;
}

Result<MonotonicTime> KmsDisplay::present(MonotonicTime /*now*/) {
    glFinish(); // without a projector too: the exhibit's pace and its watchdog do not depend on one
    presented_ = true;
    take_news();
    const PixelRectangle told = std::exchange(changed_, {});
    const std::unique_lock quiet = watch_.quiet();
    Result<MonotonicTime> shown = presenter_.present(
        told.empty() ? PixelRectangle{.x = 0, .y = 0, .width = width(), .height = height()} : told,
        quiet.owns_lock());
    watch_.set_lit(presenter_.lit());
    return shown;
}

} // namespace frustumscreen::display

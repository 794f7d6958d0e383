#include "firmware_host/display/card_screen.h"

#include "firmware_host/display/dumb_scanout.h"
#include "firmware_host/display/gbm_scanout.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::display {

Result<std::unique_ptr<CardScreen>> CardScreen::create(int card, PixelSize shown, EyeLayout eyes) {
    TRY(DrawingGpu gpu, DrawingGpu::choose_for(card));
    TRY(PictureFramebuffer picture, PictureFramebuffer::create(shown.width, shown.height * stacked(eyes)));
    TRY(EglContext copying, gpu.context().sharing());
    Result<PictureCopy> copy = [&]() -> Result<PictureCopy> {
        const CopyingNow now(copying, gpu.context());
        if (!now.current()) {
            return fail(ErrorKind::Internal, "display.second_context",
                        "display: the second OpenGL ES context cannot be made current");
        }
        return PictureCopy::create(stacked(eyes));
    }();
    TRY_VOID(copy);
    std::unique_ptr<CardScreen> screen(
        new CardScreen(card, std::move(gpu), std::move(picture), std::move(copying), std::move(*copy)));
    screen->warm_up();
    return screen;
}

/// Drivers compile a program for each target format at its first draw. Do that here, not when a projector is
/// plugged in. An error is reported when a projector needs the framebuffers.
void CardScreen::warm_up() const {
    const PixelSize exact{picture_.width(), picture_.height()};
    const PixelSize scaled{std::max(exact.width / 2, 1), std::max(exact.height / 2, 1)};
    for (const PixelSize size : {exact, scaled}) {
        if (const Result<std::unique_ptr<ScanoutPair>> pair = make_pair(size)) {
            static_cast<void>(
                (*pair)->fill(0, {.x = 0, .y = 0, .width = exact.width, .height = exact.height}));
        }
    }
}

Result<std::unique_ptr<ScanoutPair>> CardScreen::make_pair(PixelSize size) const {
    return gpu_.card_memory() != nullptr ? make_gbm_scanout(*this, size) : make_dumb_scanout(*this, size);
}

} // namespace frustumscreen::display

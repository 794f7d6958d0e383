/// Framebuffers in the memory of a card that draws for itself, through GBM; the picture is copied into them
/// by drawing.
///
/// Threads  the render thread.
/// Errors   one clause that names what the card lacks.
/// Source   EGL_KHR_image_pixmap (a GBM buffer as an EGL image), OES_EGL_image.
#pragma once

#include "firmware_host/display/card_screen.h"

#include <memory>

namespace frustumscreen::display {

/// `screen` must outlive the result.
[[nodiscard]] Result<std::unique_ptr<ScanoutPair>> make_gbm_scanout(const CardScreen& screen, PixelSize size);

} // namespace frustumscreen::display

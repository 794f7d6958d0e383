#include "firmware_host/display/surfaceless_display.h"

#include <GLES3/gl31.h>

namespace frustumscreen::display {

Result<std::unique_ptr<SurfacelessDisplay>> SurfacelessDisplay::create(int width, int height) {
    TRY(EglContext context, EglContext::without_screen());
    TRY(PictureFramebuffer picture, PictureFramebuffer::create(width, height));
    return std::unique_ptr<SurfacelessDisplay>(
        new SurfacelessDisplay(std::move(context), std::move(picture)));
}

Result<MonotonicTime> SurfacelessDisplay::present(MonotonicTime now) {
    glFinish();
    presented_ = true;
    return now;
}

} // namespace frustumscreen::display

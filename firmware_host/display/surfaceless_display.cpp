#include "firmware_host/display/surfaceless_display.h"

#include <GLES3/gl31.h>

namespace frustumscreen {

Result<std::unique_ptr<SurfacelessDisplay>> SurfacelessDisplay::create(int width, int height) {
    Result<EglContext> context = EglContext::without_screen();
    if (!context) {
        return tl::unexpected<Error>(context.error());
    }
    Result<PictureFramebuffer> picture = PictureFramebuffer::create(width, height);
    if (!picture) {
        return tl::unexpected<Error>(picture.error());
    }
    return std::unique_ptr<SurfacelessDisplay>(
        new SurfacelessDisplay(std::move(*context), std::move(*picture)));
}

Result<MonotonicTime> SurfacelessDisplay::present(MonotonicTime now) {
    glFinish();
    presented_ = true;
    return now;
}

} // namespace frustumscreen

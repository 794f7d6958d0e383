/// The card's memory through GBM: an OpenGL ES context on the card, and framebuffers that it can show.
///
/// Threads  the render thread. The copying has a context of its own, so that the renderer's state stays as it
/// is. Errors   no GBM or EGL on this card; framebuffers that it cannot make. Source   EGL_KHR_image_pixmap
/// (a GBM buffer as an EGL image), OES_EGL_image.
#pragma once

#include "firmware_host/display/egl_context.h"
#include "firmware_host/display/kms_device.h"
#include "firmware_host/display/picture_copy.h"
#include "firmware_host/display/picture_framebuffer.h"

#include <memory>

struct gbm_device;

namespace frustumscreen {

class GbmScreen {
public:
    /// `card` stays open for as long as this lives. The picture's context is current afterwards.
    [[nodiscard]] static Result<std::unique_ptr<GbmScreen>> create(int card, PixelSize picture);

    [[nodiscard]] const PictureFramebuffer& picture() const { return picture_; }
    [[nodiscard]] Result<std::unique_ptr<ScanoutPair>> make_pair(PixelSize size) const;

private:
    friend class GbmScanoutPair;
    using Device = std::unique_ptr<gbm_device, void (*)(gbm_device*)>;
    GbmScreen(int card, Device device, EglContext context, PictureFramebuffer picture, EglContext copying,
              PictureCopy copy)
        : card_(card), device_(std::move(device)), context_(std::move(context)), picture_(std::move(picture)),
          copying_(std::move(copying)), copy_(std::move(copy)) {}

    int card_;
    Device device_;
    EglContext context_;
    PictureFramebuffer picture_;
    EglContext copying_;
    PictureCopy copy_;
};

} // namespace frustumscreen

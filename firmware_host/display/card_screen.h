/// The exhibit's picture on a graphics card: the GPU that draws it, and the way into the framebuffers that
/// the card scans out.
///
/// Threads  the render thread. The copy has its own context and does not touch the renderer's state.
/// Errors   neither GBM nor EGL; framebuffers that the card cannot make.
#pragma once

#include "firmware_host/display/drawing_gpu.h"
#include "firmware_host/display/kms_device.h"
#include "firmware_host/display/picture_copy.h"
#include "firmware_host/display/picture_framebuffer.h"

#include <memory>

namespace frustumscreen::display {

class CardScreen {
public:
    /// `card` must stay open for the lifetime of the result. The picture's context is current afterwards. `shown`: size of
    /// what the screen shows at a time; the picture and its framebuffers hold that for both eyes, if `eyes` are in turn.
    [[nodiscard]] static Result<std::unique_ptr<CardScreen>> create(int card, PixelSize shown,
                                                                    EyeLayout eyes = EyeLayout::One);

    [[nodiscard]] const PictureFramebuffer& picture() const { return picture_; }
    /// Errors   a clause, for the output's state.
    [[nodiscard]] Result<std::unique_ptr<ScanoutPair>> make_pair(PixelSize size) const;

    // Used by the framebuffers:
    [[nodiscard]] int card() const { return card_; }
    [[nodiscard]] const DrawingGpu& gpu() const { return gpu_; }
    [[nodiscard]] const EglContext& copying() const { return copying_; }
    [[nodiscard]] const PictureCopy& copy() const { return copy_; }

private:
    CardScreen(int card, DrawingGpu gpu, PictureFramebuffer picture, EglContext copying, PictureCopy copy)
        : card_(card), gpu_(std::move(gpu)), picture_(std::move(picture)), copying_(std::move(copying)),
          copy_(std::move(copy)) {}
    void warm_up() const;

    int card_;
    DrawingGpu gpu_;
    PictureFramebuffer picture_;
    EglContext copying_;
    PictureCopy copy_;
};

/// Makes the copy's context current during its lifetime, and the picture's context afterwards.
class CopyingNow {
public:
    explicit CopyingNow(const CardScreen& screen) : CopyingNow(screen.copying(), screen.gpu().context()) {}
    CopyingNow(const EglContext& copying, const EglContext& after)
        : after_(after), current_(copying.make_current()) {}
    ~CopyingNow() { static_cast<void>(after_.make_current()); }
    CopyingNow(const CopyingNow&) = delete;
    CopyingNow& operator=(const CopyingNow&) = delete;
    [[nodiscard]] bool current() const { return current_; }

private:
    const EglContext& after_;
    bool current_;
};

} // namespace frustumscreen::display

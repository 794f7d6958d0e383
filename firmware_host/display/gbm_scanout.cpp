#include "firmware_host/display/gbm_scanout.h"

#include "firmware_host/display/kms_framebuffer.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES2/gl2.h>
#include <GLES2/gl2ext.h>
#include <GLES3/gl31.h>
#include <fmt/format.h>

#include <array>

extern "C" {
#include <gbm.h>
}

namespace frustumscreen::display {

namespace {

class GbmScanoutPair final : public ScanoutPair {
public:
    GbmScanoutPair(const CardScreen& screen, PixelSize size) : screen_(screen), size_(size) {}
    ~GbmScanoutPair() override;
    GbmScanoutPair(const GbmScanoutPair&) = delete;
    GbmScanoutPair& operator=(const GbmScanoutPair&) = delete;

    /// Returns the name of the missing feature; nullptr = success.
    [[nodiscard]] const char* make();
    [[nodiscard]] PixelSize size() const override { return size_; }
    [[nodiscard]] FramebufferId fill(int which, const PixelRectangle& part) override;
    [[nodiscard]] bool read(int which, std::span<std::byte> rgba) const override;

private:
    struct Buffer {
        gbm_bo* memory = nullptr;
        EGLImageKHR image = EGL_NO_IMAGE_KHR;
        unsigned colour = 0;      ///< GL renderbuffer
        unsigned framebuffer = 0; ///< GL framebuffer
        FramebufferId shown = 0;  ///< KMS framebuffer
    };
    [[nodiscard]] const char* make(Buffer& buffer);

    const CardScreen& screen_;
    PixelSize size_;
    std::array<Buffer, 2> buffers_;
};

const char* GbmScanoutPair::make() {
    const CopyingNow copying(screen_);
    if (!copying.current()) {
        return "the second OpenGL ES context";
    }
    for (Buffer& buffer : buffers_) {
        if (const char* missing = make(buffer)) {
            return missing;
        }
    }
    return nullptr;
}

const char* GbmScanoutPair::make(Buffer& buffer) {
    static const auto create_image =
        reinterpret_cast<PFNEGLCREATEIMAGEKHRPROC>(eglGetProcAddress("eglCreateImageKHR"));
    static const auto image_as_storage = reinterpret_cast<PFNGLEGLIMAGETARGETRENDERBUFFERSTORAGEOESPROC>(
        eglGetProcAddress("glEGLImageTargetRenderbufferStorageOES"));
    if (create_image == nullptr || image_as_storage == nullptr) {
        return "EGL images";
    }
    buffer.memory = gbm_bo_create(screen_.gpu().card_memory(), static_cast<std::uint32_t>(size_.width),
                                  static_cast<std::uint32_t>(size_.height), GBM_FORMAT_XRGB8888,
                                  GBM_BO_USE_SCANOUT | GBM_BO_USE_RENDERING);
    if (buffer.memory == nullptr) {
        return "memory that can be shown";
    }
    buffer.shown = add_framebuffer(screen_.card(), size_, gbm_bo_get_handle(buffer.memory).u32,
                                   gbm_bo_get_stride(buffer.memory));
    if (buffer.shown == 0) {
        return "a framebuffer";
    }
    buffer.image = create_image(screen_.copying().egl_display(), EGL_NO_CONTEXT, EGL_NATIVE_PIXMAP_KHR,
                                reinterpret_cast<EGLClientBuffer>(buffer.memory), nullptr);
    if (buffer.image == EGL_NO_IMAGE_KHR) {
        return "an EGL image of its memory";
    }
    glGenRenderbuffers(1, &buffer.colour);
    glBindRenderbuffer(GL_RENDERBUFFER, buffer.colour);
    image_as_storage(GL_RENDERBUFFER, buffer.image);
    glGenFramebuffers(1, &buffer.framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, buffer.framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffer.colour);
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE
               ? nullptr
               : "memory that can be drawn into";
}

GbmScanoutPair::~GbmScanoutPair() {
    static const auto destroy_image =
        reinterpret_cast<PFNEGLDESTROYIMAGEKHRPROC>(eglGetProcAddress("eglDestroyImageKHR"));
    const CopyingNow copying(screen_);
    for (Buffer& buffer : buffers_) {
        if (copying.current()) { // otherwise the names would be the renderer's
            glDeleteFramebuffers(1, &buffer.framebuffer);
            glDeleteRenderbuffers(1, &buffer.colour);
        }
        if (buffer.image != EGL_NO_IMAGE_KHR && destroy_image != nullptr) {
            destroy_image(screen_.copying().egl_display(), buffer.image);
        }
        remove_framebuffer(screen_.card(), buffer.shown);
        if (buffer.memory != nullptr) {
            gbm_bo_destroy(buffer.memory);
        }
    }
}

/// The picture is complete (KmsDisplay::present). The kernel shows the copy only when it is complete too,
/// whether the card or the processor draws it.
FramebufferId GbmScanoutPair::fill(int which, const PixelRectangle& part) {
    const Buffer& buffer = buffers_.at(static_cast<std::size_t>(which));
    const CopyingNow copying(screen_);
    if (copying.current()) {
        glBindFramebuffer(GL_FRAMEBUFFER, buffer.framebuffer);
        screen_.copy().draw(screen_.picture(), size_, TopRow::First, part);
        glFinish();
    }
    return buffer.shown;
}

bool GbmScanoutPair::read(int which, std::span<std::byte> rgba) const {
    const CopyingNow copying(screen_);
    if (!copying.current()) {
        return false;
    }
    glBindFramebuffer(GL_FRAMEBUFFER, buffers_.at(static_cast<std::size_t>(which)).framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, static_cast<GLsizei>(rgba.size() / 4), 1, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    return true;
}

} // namespace

Result<std::unique_ptr<ScanoutPair>> make_gbm_scanout(const CardScreen& screen, PixelSize size) {
    auto pair = std::make_unique<GbmScanoutPair>(screen, size);
    if (const char* missing = pair->make()) {
        return fail(ErrorKind::BadConfiguration, "display.scanout_lacks",
                    "the graphics card lacks {} for {} x {} pixels", missing, size.width, size.height);
    }
    return pair;
}

} // namespace frustumscreen::display

#include "firmware_host/display/gbm_scanout.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES2/gl2.h>
#include <GLES2/gl2ext.h>
#include <GLES3/gl31.h>
#include <fmt/format.h>

#include <array>

extern "C" {
#include <drm_fourcc.h>
#include <gbm.h>
#include <xf86drm.h>
#include <xf86drmMode.h>
}

namespace frustumscreen {

namespace {

/// The copying's context for as long as this lives, the picture's afterwards.
class Copying {
public:
    Copying(const EglContext& copying, const EglContext& after)
        : after_(after), current_(copying.make_current()) {}
    ~Copying() { static_cast<void>(after_.make_current()); }
    Copying(const Copying&) = delete;
    Copying& operator=(const Copying&) = delete;
    [[nodiscard]] bool current() const { return current_; }

private:
    const EglContext& after_;
    bool current_;
};

} // namespace

class GbmScanoutPair final : public ScanoutPair {
public:
    GbmScanoutPair(const GbmScreen& screen, PixelSize size) : screen_(screen), size_(size) {}
    ~GbmScanoutPair() override;
    GbmScanoutPair(const GbmScanoutPair&) = delete;
    GbmScanoutPair& operator=(const GbmScanoutPair&) = delete;

    /// What is missing; nullptr = nothing.
    [[nodiscard]] const char* make();
    [[nodiscard]] PixelSize size() const override { return size_; }
    [[nodiscard]] FramebufferId fill(int which, const PixelPlace& part) override;
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
    [[nodiscard]] bool register_with_kms(Buffer& buffer) const;

    const GbmScreen& screen_;
    PixelSize size_;
    std::array<Buffer, 2> buffers_;
};

const char* GbmScanoutPair::make() {
    const Copying copying(screen_.copying_, screen_.context_);
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
    buffer.memory = gbm_bo_create(screen_.device_.get(), static_cast<std::uint32_t>(size_.width),
                                  static_cast<std::uint32_t>(size_.height), GBM_FORMAT_XRGB8888,
                                  GBM_BO_USE_SCANOUT | GBM_BO_USE_RENDERING);
    if (buffer.memory == nullptr) {
        return "memory that can be shown";
    }
    if (!register_with_kms(buffer)) {
        return "a framebuffer";
    }
    buffer.image = create_image(screen_.copying_.egl_display(), EGL_NO_CONTEXT, EGL_NATIVE_PIXMAP_KHR,
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

/// Without modifiers: the driver then lays memory out as the kernel expects it. Old drivers know only depth
/// and bits.
bool GbmScanoutPair::register_with_kms(Buffer& buffer) const {
    const auto width = static_cast<std::uint32_t>(size_.width);
    const auto height = static_cast<std::uint32_t>(size_.height);
    const std::array<std::uint32_t, 4> handles{gbm_bo_get_handle(buffer.memory).u32};
    const std::array<std::uint32_t, 4> strides{gbm_bo_get_stride(buffer.memory)};
    const std::array<std::uint32_t, 4> offsets{};
    return drmModeAddFB2(screen_.card_, width, height, DRM_FORMAT_XRGB8888, handles.data(), strides.data(),
                         offsets.data(), &buffer.shown, 0) == 0 ||
           drmModeAddFB(screen_.card_, width, height, 24, 32, strides[0], handles[0], &buffer.shown) == 0;
}

GbmScanoutPair::~GbmScanoutPair() {
    static const auto destroy_image =
        reinterpret_cast<PFNEGLDESTROYIMAGEKHRPROC>(eglGetProcAddress("eglDestroyImageKHR"));
    const Copying copying(screen_.copying_, screen_.context_);
    for (Buffer& buffer : buffers_) {
        glDeleteFramebuffers(1, &buffer.framebuffer);
        glDeleteRenderbuffers(1, &buffer.colour);
        if (buffer.image != EGL_NO_IMAGE_KHR && destroy_image != nullptr) {
            destroy_image(screen_.copying_.egl_display(), buffer.image);
        }
        if (buffer.shown != 0) {
            drmModeRmFB(screen_.card_, buffer.shown);
        }
        if (buffer.memory != nullptr) {
            gbm_bo_destroy(buffer.memory);
        }
    }
}

/// The picture is drawn to its end (KmsDisplay::present). The kernel shows the copy only when it is drawn
/// too, on a card that draws itself and on one that does not.
FramebufferId GbmScanoutPair::fill(int which, const PixelPlace& part) {
    const Buffer& buffer = buffers_.at(static_cast<std::size_t>(which));
    const Copying copying(screen_.copying_, screen_.context_);
    if (copying.current()) {
        glBindFramebuffer(GL_FRAMEBUFFER, buffer.framebuffer);
        screen_.copy_.draw(screen_.picture_, size_, TopRow::First, part);
        glFinish();
    }
    return buffer.shown;
}

bool GbmScanoutPair::read(int which, std::span<std::byte> rgba) const {
    const Copying copying(screen_.copying_, screen_.context_);
    if (!copying.current()) {
        return false;
    }
    glBindFramebuffer(GL_FRAMEBUFFER, buffers_.at(static_cast<std::size_t>(which)).framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, static_cast<GLsizei>(rgba.size() / 4), 1, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    return true;
}

Result<std::unique_ptr<GbmScreen>> GbmScreen::create(int card, PixelSize picture_size) {
    Device device(gbm_create_device(card), gbm_device_destroy);
    if (!device) {
        return fail(ErrorKind::BadConfiguration,
                    "display: no memory for pictures on the graphics card (GBM); install libgl1-mesa-dri");
    }
    Result<EglContext> context = EglContext::on_gbm(device.get());
    if (!context) {
        return tl::unexpected<Error>(context.error());
    }
    Result<PictureFramebuffer> picture = PictureFramebuffer::create(picture_size.width, picture_size.height);
    if (!picture) {
        return tl::unexpected<Error>(picture.error());
    }
    Result<EglContext> copying = context->sharing();
    if (!copying) {
        return tl::unexpected<Error>(copying.error());
    }
    Result<PictureCopy> copy = [&] {
        const Copying now(*copying, *context);
        return PictureCopy::create();
    }();
    if (!copy) {
        return tl::unexpected<Error>(copy.error());
    }
    return std::unique_ptr<GbmScreen>(new GbmScreen(card, std::move(device), std::move(*context),
                                                    std::move(*picture), std::move(*copying),
                                                    std::move(*copy)));
}

Result<std::unique_ptr<ScanoutPair>> GbmScreen::make_pair(PixelSize size) const {
    auto pair = std::make_unique<GbmScanoutPair>(*this, size);
    if (const char* missing = pair->make()) {
        return fail(ErrorKind::BadConfiguration,
                    fmt::format("display: the graphics card has not {} for {} x {} pixels", missing,
                                size.width, size.height));
    }
    return pair;
}

} // namespace frustumscreen

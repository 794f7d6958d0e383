// Choice of the GPU that draws for a card, and the transfer of its pictures into memory that the card shows.
#include "firmware_host/display/card_screen.h"
#include "tests/display/fake_desk.h"

#include <EGL/egl.h>
#include <GLES3/gl31.h>

namespace frustumscreen::display {
namespace {

constexpr PixelSize picture_size{64, 40};

bool holds(std::string_view text, std::string_view words) {
    return text.find(words) != std::string_view::npos;
}

/// An open card.
class Drawing : public Desk {
protected:
    Drawing() : card_(KmsCard::open(card_path, {}).value()) {}

    [[nodiscard]] long opened() const {
        return std::count(kernel.calls().begin(), kernel.calls().end(), "open");
    }
    /// The name of the renderer, which is current.
    std::string draws(bool shows) {
        const Result<DrawingGpu> gpu = DrawingGpu::choose_for(card_.file());
        if (!gpu) {
            return gpu.error().message;
        }
        EXPECT_EQ(gpu->card_memory() != nullptr, shows);
        EXPECT_NE(eglGetCurrentContext(), EGL_NO_CONTEXT);
        return gl_driver_name();
    }

    KmsCard card_;
};

TEST_F(Drawing, UsesTheCardsOwnGpuIfItCanDraw) {
    desk.card.renderer = "Mesa Intel(R) UHD Graphics";
    kernel.add_gpu({"/dev/dri/renderD128", "Mesa Intel(R) UHD Graphics", &desk.card});
    kernel.add_gpu({"/dev/dri/renderD129", "NV136", nullptr});
    EXPECT_TRUE(holds(draws(true), "UHD Graphics"));
    EXPECT_EQ(opened(), 1) << "the card's alone";
}

TEST_F(Drawing, UsesAnotherGpuForACardThatCannotDraw) {
    kernel.add_gpu({"/dev/dri/renderD128", "never asked", &desk.card});
    kernel.add_gpu({"", "has no render node", nullptr});
    kernel.add_gpu({"/dev/dri/renderD129", "llvmpipe (LLVM 15.0.6, 256 bits)", nullptr});
    kernel.add_gpu({"/dev/dri/renderD130", "V3D 4.2", nullptr});
    EXPECT_TRUE(holds(draws(false), "V3D 4.2"));
    EXPECT_EQ(opened(), 3);
}

TEST_F(Drawing, SkipsAGpuThatCannotBeOpened) {
    kernel.add_gpu({"/dev/dri/renderD129", "NV136", nullptr});
    kernel.fail_always("open", EACCES);
    EXPECT_TRUE(holds(draws(true), "llvmpipe")) << "the processor draws into the card's memory";
}

TEST_F(Drawing, FallsBackToTheProcessorInTheCardsMemory) {
    EXPECT_TRUE(holds(draws(true), "llvmpipe"));
    kernel.add_gpu({"/dev/dri/renderD129", "softpipe", nullptr});
    EXPECT_TRUE(holds(draws(true), "llvmpipe")) << "no processor is better than another";
}

TEST_F(Drawing, DrawsWithoutTheCardsMemoryIfGbmIsMissing) {
    desk.card.has_gbm = false;
    EXPECT_TRUE(holds(draws(false), "llvmpipe"));
    kernel.add_gpu({"/dev/dri/renderD129", "NV136", nullptr});
    EXPECT_TRUE(holds(draws(false), "NV136"));
}

TEST_F(Drawing, NamesThePackageToInstallWithoutEgl) {
    kernel.fail_always("eglInitialize", EINVAL);
    EXPECT_TRUE(holds(draws(false), "display: EGL does not start on the graphics card")) << draws(false);
    EXPECT_TRUE(holds(draws(false), "install libegl1")) << draws(false);
}

TEST_F(Drawing, ReportsAnInternalErrorIfTheContextIsLost) {
    EXPECT_TRUE(holds(draws(true), "llvmpipe"));
    const auto begin = std::find(kernel.calls().rbegin(), kernel.calls().rend(), "gbm_create_device").base();
    const auto steps =
        std::find(std::find(begin, kernel.calls().end(), "eglMakeCurrent") + 1, kernel.calls().end(),
                  "eglMakeCurrent") -
        begin + 2; // gbm_create_device counts too, and counting starts at 1
    kernel.fail(kernel.calls().size() + static_cast<std::size_t>(steps), EINVAL);
    const Result<DrawingGpu> gpu = DrawingGpu::choose_for(card_.file());
    ASSERT_FALSE(gpu);
    EXPECT_EQ(gpu.error().kind, ErrorKind::Internal);
    EXPECT_TRUE(holds(gpu.error().message, "cannot be made current again")) << gpu.error().message;
}

/// The picture's colour at a pixel; no symmetry maps the picture to itself.
std::array<unsigned char, 4> colour_at(int x, int y) {
    return {static_cast<unsigned char>(3 * x + 1), static_cast<unsigned char>(5 * y + 2),
            static_cast<unsigned char>(x + y), 255};
}

void paint(const CardScreen& screen) {
    std::vector<std::array<unsigned char, 4>> texels;
    for (int y = 0; y < picture_size.height; ++y) {
        for (int x = 0; x < picture_size.width; ++x) {
            texels.push_back(colour_at(x, y));
        }
    }
    glBindTexture(GL_TEXTURE_2D, screen.picture().texture());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, picture_size.width, picture_size.height, GL_RGBA,
                    GL_UNSIGNED_BYTE, texels.data());
    glFinish();
}

/// Whether the top row of framebuffer `which` is the picture's top row.
bool shows_the_picture(const ScanoutPair& pair, int which) {
    std::vector<std::byte> row(static_cast<std::size_t>(picture_size.width) * 4);
    bool same = pair.read(which, row);
    for (std::size_t k = 0; k < row.size() && same; ++k) {
        same = row[k] == static_cast<std::byte>(colour_at(static_cast<int>(k / 4), 0).at(k % 4));
    }
    return same;
}

/// `GetParam`: true: the card draws by itself (GBM); false: another GPU draws, and its pictures are copied
/// (dumb buffers).
class Scanout : public Drawing, public testing::WithParamInterface<bool> {
protected:
    Scanout() {
        desk.card.renderer = GetParam() ? "Mesa Intel(R) UHD Graphics" : "";
        kernel.add_gpu({"/dev/dri/renderD129", "NV136", nullptr});
    }
    /// The reason why two framebuffers of this size are unavailable; empty: they are available.
    std::string lacks(PixelSize size = picture_size) {
        const auto screen = CardScreen::create(card_.file(), picture_size);
        if (!screen) {
            return screen.error().message;
        }
        const auto pair = (*screen)->make_pair(size);
        return pair ? "" : pair.error().message;
    }
    std::string lacks_when_fails(const std::string& call) {
        kernel.fail_always(call, ENOMEM);
        std::string why = lacks();
        kernel.fail_always(call, 0);
        return why;
    }
};
INSTANTIATE_TEST_SUITE_P(Kms, Scanout, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "Gbm" : "Dumb"; });

TEST_P(Scanout, CopiesThePictureIntoTwoFramebuffers) {
    const std::unique_ptr<CardScreen> screen = CardScreen::create(card_.file(), picture_size).value();
    EXPECT_EQ(screen->gpu().card_memory() != nullptr, GetParam());
    paint(*screen);
    const std::unique_ptr<ScanoutPair> pair = screen->make_pair(picture_size).value();
    EXPECT_EQ(pair->size(), picture_size);
    EXPECT_FALSE(shows_the_picture(*pair, 0));
    const PixelRectangle whole{0, 0, picture_size.width, picture_size.height};
    const FramebufferId first = pair->fill(0, whole);
    EXPECT_TRUE(shows_the_picture(*pair, 0));
    EXPECT_FALSE(shows_the_picture(*pair, 1));
    const FramebufferId second = pair->fill(1, whole);
    EXPECT_TRUE(shows_the_picture(*pair, 1));
    EXPECT_NE(first, second);
    const drmModeModeInfo mode = kernel_mode(picture_size.width, picture_size.height, 60.0);
    for (const FramebufferId framebuffer : {first, second}) {
        EXPECT_EQ(desk.card.set_crtc(desk.crtcs[0], framebuffer, std::array{desk.hdmi}, &mode), 0)
            << "the card shows it";
    }
}

TEST_P(Scanout, NamesTheResourceThatTheCardLacks) {
    EXPECT_EQ(lacks(), "");
    EXPECT_EQ(lacks({32, 24}), "") << "another mode than the picture's";
    kernel.fail_always("drmModeAddFB", EINVAL);
    const std::string where = " for 64 x 40 pixels";
    if (GetParam()) {
        EXPECT_EQ(lacks_when_fails("gbm_bo_create"),
                  "the graphics card lacks memory that can be shown" + where);
        EXPECT_EQ(lacks_when_fails("drmModeAddFB2"), "the graphics card lacks a framebuffer" + where);
        EXPECT_EQ(lacks_when_fails("eglCreateImageKHR"),
                  "the graphics card lacks an EGL image of its memory" + where);
        EXPECT_EQ(lacks_when_fails("glEGLImageTargetRenderbufferStorageOES"),
                  "the graphics card lacks memory that can be drawn into" + where);
    } else {
        for (const char* call :
             {"drmModeCreateDumbBuffer", "drmModeAddFB2", "drmModeMapDumbBuffer", "mmap"}) {
            EXPECT_EQ(lacks_when_fails(call), "the graphics card has no memory" + where) << call;
        }
    }
}

TEST_P(Scanout, CopiesNothingWithoutTheSecondContext) {
    const std::unique_ptr<CardScreen> screen = CardScreen::create(card_.file(), picture_size).value();
    paint(*screen);
    const std::unique_ptr<ScanoutPair> pair = screen->make_pair(picture_size).value();
    kernel.fail_always("eglMakeCurrent", ENOMEM);
    EXPECT_NE(pair->fill(0, {0, 0, picture_size.width, picture_size.height}), 0U);
    EXPECT_FALSE(shows_the_picture(*pair, 0));
    EXPECT_EQ(screen->make_pair(picture_size).error().id,
              GetParam() ? "display.scanout_lacks" : "display.no_second_context");
    kernel.fail_always("eglMakeCurrent", 0);
    ASSERT_TRUE(screen->gpu().context().make_current());
}

/// If any one call fails once, there are either framebuffers that show the picture, or a sentence that names
/// the failure; and nothing leaks.
TEST_P(Scanout, RecoversFromOrReportsAnySingleFailedCall) {
    const auto once = [](std::size_t call, int error) {
        FakeKernel own;
        CardOnDesk table(own.add_card(card_path));
        table.card.renderer = GetParam() ? "Mesa Intel(R) UHD Graphics" : "";
        own.add_gpu({"/dev/dri/renderD129", "NV136", nullptr});
        own.fail(call, error);
        std::string wrong;
        if (const Result<KmsCard> card = KmsCard::open(card_path, {})) {
            if (const auto screen = CardScreen::create(card->file(), picture_size); !screen) {
                wrong += holds(screen.error().message, "display: ") ? "" : screen.error().message;
            } else if (const auto pair = (*screen)->make_pair(picture_size); !pair) {
                wrong += holds(pair.error().message, "the graphics card ") ? "" : pair.error().message;
            } else {
                paint(**screen);
                for (int k = 0; k < 2; ++k) { // the second picture makes up for one that was not copied
                    static_cast<void>((*pair)->fill(0, {0, 0, picture_size.width, picture_size.height}));
                }
                if (!shows_the_picture(**pair, 0)) { // the call that fails may be one of the reading's
                    wrong += shows_the_picture(**pair, 0) ? "" : "no picture; ";
                }
            }
        }
        return std::pair{own.calls(), wrong + own.alive() + own.wrongs()};
    };
    const auto [calls, undisturbed] = once(0, 0);
    ASSERT_EQ(undisturbed, "");
    for (std::size_t k = 1; k <= calls.size(); ++k) {
        const int error = FakeKernel::errors_of(calls[k - 1]).back(); // which error makes no difference here
        EXPECT_EQ(once(k, error).second, "") << "call " << k << ", " << calls[k - 1] << ": " << error;
    }
}

} // namespace
} // namespace frustumscreen::display

#include "firmware_host/display/surfaceless_display.h"

#include <GLES3/gl31.h>
#include <gtest/gtest.h>

#include <array>

namespace frustumscreen::display {
namespace {

TEST(SurfacelessDisplay, KeepsWhatWasDrawnAsSrgbCodes) {
    const auto display = SurfacelessDisplay::create(40, 20);
    ASSERT_TRUE(display) << display.error().message;
    EXPECT_EQ((*display)->width(), 40);
    EXPECT_EQ((*display)->height(), 20);
    EXPECT_EQ((*display)->buffer_age(), 0);
    glBindFramebuffer(GL_FRAMEBUFFER, (*display)->framebuffer());
    glClearColor(0.5F, 0.0F, 1.0F, 1.0F); // linear light
    glClear(GL_COLOR_BUFFER_BIT);
    const auto shown = (*display)->present(from_microseconds(77));
    ASSERT_TRUE(shown);
    EXPECT_EQ(to_microseconds(*shown), 77);
    EXPECT_EQ((*display)->buffer_age(), 1);
    std::array<unsigned char, 4> texel{};
    glReadPixels(39, 19, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, texel.data());
    // IEC 61966-2-1: 255 (1.055 0.5^(1/2.4) - 0.055) = 187.5
    EXPECT_NEAR(texel[0], 187.5, 1.0);
    EXPECT_EQ(texel[1], 0);
    EXPECT_EQ(texel[2], 255);
    EXPECT_FALSE((*display)->name().empty());
}

TEST(SurfacelessDisplay, RefusesPicturesThatTheDriverCannotHold) {
    for (const int width : {-1, 0, 1 << 20}) {
        const auto display = SurfacelessDisplay::create(width, 16);
        ASSERT_FALSE(display);
        EXPECT_EQ(display.error().kind, ErrorKind::BadConfiguration);
        EXPECT_NE(display.error().message.find(" x 16 pixels"), std::string::npos) << display.error().message;
        EXPECT_EQ(display.error().message.find('\n'), std::string::npos);
    }
}

TEST(SurfacelessDisplay, CanBeMadeAgainAfterItIsGone) {
    for (int round = 0; round < 3; ++round) {
        EXPECT_TRUE(SurfacelessDisplay::create(8, 8));
    }
}

TEST(SurfacelessDisplay, RecognizesSoftwareDriversByTheirNames) {
    // GL_RENDERER of Mesa 22.3.
    for (const std::string_view name : {"llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe"}) {
        EXPECT_TRUE(draws_on_processor(name)) << name;
    }
    for (const std::string_view name : {"V3D 4.2", "Mesa Intel(R) UHD Graphics 620 (KBL GT2)", "NVC1",
                                        "virgl (llvmpipe (LLVM 15.0.6, 256 bits))", ""}) {
        EXPECT_FALSE(draws_on_processor(name)) << name;
    }
    const auto display = SurfacelessDisplay::create(8, 8);
    ASSERT_TRUE(display);
    EXPECT_TRUE(has_gl_extension("GL_OES_EGL_image")) << "every Mesa driver has it";
    EXPECT_FALSE(has_gl_extension("GL_OES_EGL_imag"));
}

} // namespace
} // namespace frustumscreen::display

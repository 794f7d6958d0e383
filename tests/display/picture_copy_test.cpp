#include "firmware_host/display/egl_context.h"
#include "firmware_host/display/picture_copy.h"

#include <GLES3/gl31.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace frustumscreen {
namespace {

using Texel = std::array<unsigned char, 4>;

/// A screen's framebuffer: 8 bits a channel, codes as they are written.
class Screen {
public:
    explicit Screen(PixelSize size) : size_(size) {
        glGenFramebuffers(1, &framebuffer_);
        glGenRenderbuffers(1, &colour_);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glBindRenderbuffer(GL_RENDERBUFFER, colour_);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size.width, size.height);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
        glDisable(GL_SCISSOR_TEST);
        glClearColor(1.0F, 0.0F, 1.0F, 1.0F); // whatever was there before
        glClear(GL_COLOR_BUFFER_BIT);
    }
    ~Screen() {
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteRenderbuffers(1, &colour_);
    }
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    [[nodiscard]] std::vector<Texel> read() const {
        std::vector<Texel> texels(static_cast<std::size_t>(size_.width) *
                                  static_cast<std::size_t>(size_.height));
        glReadPixels(0, 0, size_.width, size_.height, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
        return texels;
    }

private:
    PixelSize size_;
    unsigned framebuffer_ = 0;
    unsigned colour_ = 0;
};

class Copying : public testing::Test {
protected:
    Copying() : drawing_(EglContext::without_screen()) {
        EXPECT_TRUE(drawing_);
        copying_ = drawing_->sharing().value();
        EXPECT_TRUE(copying_->make_current());
        copy_ = PictureCopy::create().value();
        EXPECT_TRUE(drawing_->make_current());
    }
    ~Copying() override {
        EXPECT_TRUE(copying_->make_current());
        copy_.reset();
    }

    /// Every pixel has a colour of its own; row 0 is the top row.
    static Texel colour_of(int x, int y) {
        return {static_cast<unsigned char>(x), static_cast<unsigned char>(y),
                static_cast<unsigned char>((x * 7 + y * 13) % 256), 255};
    }
    static PictureFramebuffer picture_of(int width, int height, Texel (*colour)(int, int) = colour_of) {
        PictureFramebuffer picture = PictureFramebuffer::create(width, height).value();
        std::vector<Texel> texels;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                texels.push_back(colour(x, y));
            }
        }
        glBindTexture(GL_TEXTURE_2D, picture.texture());
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
        glFinish();
        return picture;
    }
    std::vector<Texel> copied(const PictureFramebuffer& picture, PixelSize size, TopRow top,
                              std::optional<PixelPlace> part = std::nullopt) {
        EXPECT_TRUE(copying_->make_current());
        std::vector<Texel> texels;
        {
            const Screen screen(size);
            copy_->draw(picture, size, top,
                        part.value_or(PixelPlace{0, 0, picture.width(), picture.height()}));
            EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
            texels = screen.read();
        }
        EXPECT_TRUE(drawing_->make_current());
        return texels;
    }

    Result<EglContext> drawing_;
    std::optional<EglContext> copying_;
    std::optional<PictureCopy> copy_;
};

TEST_F(Copying, OfTheSameSizeEveryCodeArrivesAsItIsAndTheTopRowFirst) {
    const PictureFramebuffer picture = picture_of(256, 256);
    const std::vector<Texel> screen = copied(picture, {256, 256}, TopRow::First);
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            ASSERT_EQ(screen[static_cast<std::size_t>(256 * y + x)], colour_of(x, y)) << x << ", " << y;
        }
    }
}

TEST_F(Copying, InAWindowTheTopRowIsTheLast) {
    const PictureFramebuffer picture = picture_of(64, 40);
    const std::vector<Texel> screen = copied(picture, {64, 40}, TopRow::Last);
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 64; ++x) {
            ASSERT_EQ(screen[static_cast<std::size_t>(64 * y + x)], colour_of(x, 39 - y)) << x << ", " << y;
        }
    }
}

TEST_F(Copying, AnotherShapeHasBlackAroundIt) {
    // 64 x 40 in 128 x 100: 128 x 80, ten black rows above and below.
    const PictureFramebuffer picture = picture_of(64, 40, [](int, int) { return Texel{200, 100, 50, 255}; });
    for (const TopRow top : {TopRow::First, TopRow::Last}) {
        const std::vector<Texel> screen = copied(picture, {128, 100}, top);
        for (int y = 0; y < 100; ++y) {
            const bool inside = y >= 10 && y < 90;
            for (int x = 0; x < 128; ++x) {
                const Texel& texel = screen[static_cast<std::size_t>(128 * y + x)];
                EXPECT_NEAR(texel[0], inside ? 200 : 0, 1) << x << ", " << y;
                EXPECT_NEAR(texel[1], inside ? 100 : 0, 1);
                EXPECT_NEAR(texel[2], inside ? 50 : 0, 1);
            }
        }
    }
}

TEST_F(Copying, APartIsWhereItIsInTheWholePictureAndTheRestStays) {
    const PictureFramebuffer picture = picture_of(64, 40);
    for (const PixelSize size : {PixelSize{64, 40}, {128, 100}, {50, 30}}) {
        for (const TopRow top : {TopRow::First, TopRow::Last}) {
            const std::vector<Texel> whole = copied(picture, size, top);
            const PixelPlace part{10, 4, 20, 16};
            const std::vector<Texel> some = copied(picture, size, top, part);
            const PixelPlace place = letterbox({64, 40}, size);
            const PixelPlace there = part_on_screen(part, {64, 40}, place);
            int inside = 0;
            for (int row = 0; row < size.height; ++row) {
                const int y = top == TopRow::First ? row : size.height - 1 - row;
                for (int x = 0; x < size.width; ++x) {
                    const bool in = x >= there.x && x < there.x + there.width && y >= there.y &&
                                    y < there.y + there.height;
                    const auto at = static_cast<std::size_t>(size.width * row + x);
                    ASSERT_EQ(some[at], in ? whole[at] : (Texel{255, 0, 255, 255})) << x << ", " << y;
                    inside += in ? 1 : 0;
                }
            }
            EXPECT_GE(inside * 64 * 40, 20 * 16 * place.width * place.height);
        }
    }
}

TEST_F(Copying, ScalesInLinearLight) {
    // Black and white columns, halved: half the light of white is code 187.5, not 127.5 (IEC 61966-2-1).
    const PictureFramebuffer picture = picture_of(128, 64, [](int x, int) {
        const auto code = static_cast<unsigned char>(x % 2 == 0 ? 0 : 255);
        return Texel{code, code, code, 255};
    });
    const std::vector<Texel> screen = copied(picture, {64, 32}, TopRow::First);
    for (const Texel& texel : screen) {
        EXPECT_NEAR(texel[0], 187.5, 1.0);
    }
}

TEST_F(Copying, LeavesTheRenderersStateAlone) {
    const PictureFramebuffer picture = picture_of(16, 16);
    glBindFramebuffer(GL_FRAMEBUFFER, picture.name());
    glViewport(1, 2, 3, 4);
    glEnable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glBindTexture(GL_TEXTURE_2D, picture.texture());
    copied(picture, {16, 16}, TopRow::First);
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    EXPECT_EQ(viewport, (std::array<GLint, 4>{1, 2, 3, 4}));
    EXPECT_TRUE(glIsEnabled(GL_BLEND) && glIsEnabled(GL_DEPTH_TEST));
    GLint bound = 0;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    EXPECT_EQ(static_cast<unsigned>(bound), picture.name());
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    EXPECT_EQ(static_cast<unsigned>(bound), picture.texture());
}

TEST(Letterbox, IsAsLargeAsItFitsAndCentred) {
    EXPECT_EQ(letterbox({1280, 800}, {1280, 800}), (PixelPlace{0, 0, 1280, 800}));
    EXPECT_EQ(letterbox({1280, 800}, {1920, 1080}), (PixelPlace{96, 0, 1728, 1080}));
    EXPECT_EQ(letterbox({1280, 800}, {1024, 768}), (PixelPlace{0, 64, 1024, 640}));
    EXPECT_EQ(letterbox({8192, 1}, {64, 8192}), (PixelPlace{0, 4095, 64, 1}));
    for (int width = 1; width < 60; ++width) {
        for (int height = 1; height < 60; ++height) {
            const PixelPlace place = letterbox({width, height}, {48, 30});
            EXPECT_TRUE(place.width == 48 || place.height == 30);
            EXPECT_TRUE(place.x >= 0 && place.y >= 0 && place.x + place.width <= 48 &&
                        place.y + place.height <= 30);
            EXPECT_LE(std::abs(std::int64_t{place.width} * height - std::int64_t{place.height} * width),
                      std::max(width, height))
                << width << " x " << height;
        }
    }
}

} // namespace
} // namespace frustumscreen

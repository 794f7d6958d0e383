// A picture, a screen's framebuffer and the copy between them, without a real screen.
#pragma once

#include "firmware_host/display/egl_context.h"
#include "firmware_host/display/picture_copy.h"

#include <GLES3/gl31.h>
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <vector>

namespace frustumscreen::display {

using Texel = std::array<unsigned char, 4>;

/// A screen's framebuffer: 8 bits per channel, codes stored unchanged.
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
        glClearColor(1.0F, 0.0F, 1.0F, 1.0F); // stands for earlier contents
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

    /// Every pixel has a unique colour; row 0 is the top row.
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
    /// `copy`: none: that of one picture.
    std::vector<Texel> copied(const PictureFramebuffer& picture, PixelSize size, TopRow top,
                              std::optional<PixelRectangle> part = std::nullopt,
                              const PictureCopy* copy = nullptr) {
        EXPECT_TRUE(copying_->make_current());
        std::vector<Texel> texels;
        {
            const Screen screen(size);
            const PixelRectangle whole{0, 0, picture.width(), picture.height()};
            drawn_ = (copy != nullptr ? *copy : *copy_).draw(picture, size, top, part.value_or(whole));
            EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
            texels = screen.read();
        }
        EXPECT_TRUE(drawing_->make_current());
        return texels;
    }

    Result<EglContext> drawing_;
    std::optional<EglContext> copying_;
    std::optional<PictureCopy> copy_;
    PixelRectangle drawn_; ///< as returned by the last copy
};

} // namespace frustumscreen::display

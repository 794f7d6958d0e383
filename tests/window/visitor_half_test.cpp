// The visitor's half of the window against the visitor's view, which casts a ray for every pixel.
#include "app/programs/window/help_picture.h"
#include "app/programs/window/visitor_half.h"

#include <GLES3/gl31.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace frustumscreen::window {
namespace {

constexpr int width = 640;
constexpr int height = 400;

/// Bands and a bright frame, so that a picture out of place is seen.
image::Image8 bands() {
    image::Image8 picture(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto code =
                static_cast<std::uint8_t>(128.0 + 100.0 * std::sin(0.08 * x) * std::cos(0.11 * y));
            picture.at(x, y) = {code, static_cast<std::uint8_t>(x * 255 / width), 60, 255};
        }
    }
    return picture;
}

class VisitorHalfTest : public testing::Test {
protected:
    void SetUp() override {
        ::setenv("SDL_VIDEODRIVER", "offscreen", 1);
        settings_.projector.pinhole = {width, height, 960.0, 960.0, 320.0, 200.0};
        settings_.eye.default_m = {-0.2, -0.5, 0.45};
        visitor_.emplace(settings_);
        WindowSetUp set_up;
        set_up.width = width;
        set_up.height = height;
        set_up.eye_m = settings_.eye.default_m;
        set_up.table_from_picture = [](const glm::dvec2&) { return std::nullopt; };
        set_up.see = [this](const tracker::PoseSample&, const glm::dvec3& eye_m, PixelSize half,
                            SeenSurfaces& seen) {
            half_ = half;
            visitor_->see(pose_, eye_m, half, seen);
        };
        Result<WindowHelp> help = programs::help_picture();
        ASSERT_TRUE(help) << help.error().message;
        EXPECT_EQ(help->rgba.size(), 4U * static_cast<std::size_t>(help->size.width * help->size.height));
        set_up.help = std::move(*help);
        Result<Window> opened = open_window(set_up);
        ASSERT_TRUE(opened) << opened.error().message;
        window_ = std::move(*opened);
    }
    /// Presents the picture and reads the window's right half, row 0 at the top.
    image::Image8 shown(const image::Image8& picture) {
        GLuint texture = 0;
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                     picture.texels.data());
        GLuint source = 0;
        glGenFramebuffers(1, &source);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, source);
        glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, window_.display->framebuffer());
        glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        EXPECT_TRUE(window_.display->present({}));
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        image::Image8 half(half_.width, half_.height);
        glReadPixels(half_.width, 0, half.width, half.height, GL_RGBA, GL_UNSIGNED_BYTE, half.texels.data());
        for (int y = 0; y < half.height / 2; ++y) {
            for (int x = 0; x < half.width; ++x) {
                std::swap(half.at(x, y), half.at(x, half.height - 1 - y));
            }
        }
        return half;
    }

    settings::Settings settings_;
    std::optional<programs::VisitorHalf> visitor_;
    tracker::PoseSample pose_{
        {}, tracker::prop_station, {0.05, -0.02, 0.0}, glm::angleAxis(0.5, glm::dvec3(0, 0, 1)), true};
    PixelSize half_;
    Window window_;
};

TEST_F(VisitorHalfTest, MatchesTheRayCastPicture) {
    const image::Image8 picture = bands();
    const image::Image8 half = shown(picture);
    if (const char* const file = std::getenv("KEEP_WINDOW_PICTURE")) {
        ASSERT_TRUE(write_file(file, image::encode_png(half)));
    }
    const simulation::VisitorScene scene{settings_.projector.pinhole,
                                         settings_.projector.table_from_projector,
                                         settings::make_prop(settings_.prop),
                                         {pose_.rotation, pose_.position_m},
                                         settings_.eye.default_m,
                                         {settings_.table.width_m, settings_.table.depth_m}};
    const image::Image8 truth = simulation::visitor_view(
        scene, picture, visitor_->camera(settings_.eye.default_m, half_), {true, 1, false});
    int differs = 0;
    for (std::size_t k = 0; k < truth.texels.size(); ++k) {
        const glm::ivec3 apart = glm::abs(glm::ivec3(half.texels[k]) - glm::ivec3(truth.texels[k]));
        differs += std::max({apart.r, apart.g, apart.b}) > 10 ? 1 : 0;
    }
    // The prop's outline, and the ray cast's soft shadow at its foot, stand in one of the two alone.
    EXPECT_LT(differs, 0.03 * static_cast<double>(truth.texels.size()));
    EXPECT_GT(std::count_if(truth.texels.begin(), truth.texels.end(),
                            [](const auto& texel) { return texel.r > 90; }),
              truth.texels.size() / 8);
}

TEST_F(VisitorHalfTest, FindsThePlaceOnTheTableUnderAPixel) {
    const glm::dvec3 eye = settings_.eye.default_m;
    const PixelSize half{width, height};
    const simulation::VisitorCamera camera = visitor_->camera(eye, half);
    const glm::dvec3 point(0.12, -0.07, 0.0);
    const auto pixel = camera.pinhole.pixel(camera.table_from_camera.inverse().point(point));
    ASSERT_TRUE(pixel);
    const auto found = visitor_->on_table(*pixel, eye, half);
    ASSERT_TRUE(found);
    EXPECT_NEAR(glm::distance(*found, glm::dvec2(point)), 0.0, 1e-9);
    EXPECT_FALSE(visitor_->on_table({10.0, -5000.0}, eye, half));
}

} // namespace
} // namespace frustumscreen::window

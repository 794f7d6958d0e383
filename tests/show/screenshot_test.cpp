// The hand-over of the presented picture from the render thread to a requesting thread.
#include "app/render/probe.h"
#include "app/show/screenshot.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/base/comes_true.h"

#include <GLES3/gl31.h>
#include <gtest/gtest.h>

#include <atomic>
#include <future>

namespace frustumscreen::show {
namespace {

class ScreenshotTest : public ::testing::Test {
protected:
    void SetUp() override {
        Result<std::unique_ptr<display::SurfacelessDisplay>> made =
            display::SurfacelessDisplay::create(32, 16);
        ASSERT_TRUE(made) << made.error().message;
        display = std::move(*made);
    }
    /// Fills the picture with one colour that has the same code in linear light and in sRGB: off or full.
    void draw(bool red, bool green, bool blue) const {
        glBindFramebuffer(GL_FRAMEBUFFER, display->framebuffer());
        glClearColor(red ? 1.0F : 0.0F, green ? 1.0F : 0.0F, blue ? 1.0F : 0.0F, 1.0F);
        glClear(GL_COLOR_BUFFER_BIT);
        ASSERT_TRUE(display->present(monotonic_now()));
    }
    /// Serves until a request on another thread is answered. After some seconds the request is withdrawn, and made
    /// again.
    [[nodiscard]] Result<image::Image8> asked() {
        std::future<Result<image::Image8>> answer =
            std::async(std::launch::async, [this]() -> Result<image::Image8> {
                Result<const image::Image8*> taken = nullptr;
                static_cast<void>(comes_true([&] {
                    taken = screenshot.take(std::stop_token());
                    return taken.has_value();
                }));
                return taken ? Result<image::Image8>(**taken) : tl::unexpected<Error>(taken.error());
            });
        while (answer.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
            screenshot.serve(*display);
        }
        return answer.get();
    }

    std::unique_ptr<display::SurfacelessDisplay> display;
    Screenshot screenshot{32, 16};
};

TEST_F(ScreenshotTest, ShowsTheLastPresentedPictureWithoutTheWatchdogCode) {
    const MonotonicTime start = monotonic_now();
    draw(true, false, true);
    const Result<image::Image8> first = asked();
    ASSERT_TRUE(first) << first.error().message;
    EXPECT_EQ(first->at(0, 0), glm::u8vec4(255, 0, 255, 255));
    EXPECT_EQ(first->at(31, 15), glm::u8vec4(255, 0, 255, 255));
    draw(false, false, false);
    ASSERT_TRUE(render::write_probe(display->framebuffer(), 77, {}));
    ASSERT_EQ(render::read_probe(display->framebuffer()), std::uint8_t{77});
    const Result<image::Image8> second = asked();
    ASSERT_TRUE(second) << second.error().message;
    for (const glm::u8vec4& texel : second->texels) {
        ASSERT_EQ(texel, glm::u8vec4(0, 0, 0, 255));
    }
    EXPECT_GE(monotonic_now() - start, Screenshot::between_pictures);
}

/// A display whose picture cannot be read until the test releases it.
class HeldDisplay : public display::Display {
public:
    explicit HeldDisplay(display::Display& held) : held_(held) {}
    [[nodiscard]] int width() const override { return held_.width(); }
    [[nodiscard]] int height() const override { return held_.height(); }
    [[nodiscard]] unsigned framebuffer() const override {
        may_go_.wait(false);
        return held_.framebuffer();
    }
    [[nodiscard]] int buffer_age() const override { return held_.buffer_age(); }
    [[nodiscard]] Result<MonotonicTime> present(MonotonicTime now) override { return held_.present(now); }
    [[nodiscard]] std::string name() const override { return held_.name(); }
    void release() {
        may_go_ = true;
        may_go_.notify_all();
    }

private:
    display::Display& held_;
    std::atomic<bool> may_go_ = false;
};

TEST_F(ScreenshotTest, ALateCopyDoesNotAnswerTheNextRequest) {
    draw(true, false, false);
    HeldDisplay held(*display);
    std::future<bool> answered = std::async(std::launch::async, [&] {
        const bool was = screenshot.take(std::stop_token()).has_value();
        held.release();
        return was;
    });
    while (answered.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
        screenshot.serve(held); // takes the request, and hangs until it is given up
    }
    EXPECT_FALSE(answered.get());
    draw(false, true, false);
    const Result<image::Image8> later = asked();
    ASSERT_TRUE(later);
    EXPECT_EQ(later->at(5, 5), glm::u8vec4(0, 255, 0, 255)) << "the picture of the copy that came too late";
}

TEST_F(ScreenshotTest, AWithdrawnRequestDoesNotYieldAnOldPicture) {
    draw(true, true, true);
    screenshot.serve(*display); // without a request
    const Result<const image::Image8*> none = screenshot.take(std::stop_token());
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message,
              "the exhibit gives no picture; it hangs, is ending, or shows the staff what its camera sees");
    screenshot.serve(*display); // the request was withdrawn
    draw(false, true, false);
    const Result<image::Image8> later = asked();
    ASSERT_TRUE(later);
    EXPECT_EQ(later->at(5, 5), glm::u8vec4(0, 255, 0, 255));
}

} // namespace
} // namespace frustumscreen::show

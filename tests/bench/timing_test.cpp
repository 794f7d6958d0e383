#include "app/bench/measures/timing.h"
#include "firmware_host/display/surfaceless_display.h"
#include "firmware_host/gl/gl_program.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen::bench {
namespace {

/// A picture that keeps the driver busy; records whether the previous one was finished when the next began.
class Heavy final : public Technique {
public:
    explicit Heavy(std::vector<const Technique*>& log) : log_(log) {
        Result<gl::GlProgram> program = gl::make_program("", R"(
void main() { gl_Position = vec4(float(gl_VertexID % 2) * 4.0 - 1.0, float(gl_VertexID / 2) * 4.0 - 1.0, 0.0, 1.0); }
)",
                                                         R"(
out vec4 result;
void main() {
    float sum = gl_FragCoord.x;
    for (int k = 0; k < 100; ++k) {
        sum = sin(sum);
    }
    result = vec4(sum);
}
)");
        EXPECT_TRUE(program) << program.error().message;
        program_ = std::move(*program);
    }
    ~Heavy() override { glDeleteSync(fence_); }
    [[nodiscard]] std::string name() const override { return "heavy"; }
    void draw(const BenchPose& pose) override {
        log_.push_back(this);
        eyes_.push_back(pose.eye_m.x);
        if (fence_ != nullptr) {
            GLint state = 0;
            glGetSynciv(fence_, GL_SYNC_STATUS, 1, nullptr, &state);
            unfinished_ += state == GL_SIGNALED ? 0 : 1;
            glDeleteSync(fence_);
        }
        glUseProgram(program_.get());
        glBindVertexArray(no_attributes_.get());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    }
    [[nodiscard]] Result<image::ImageFloat> hit_points(const BenchPose&) override {
        return image::ImageFloat();
    }

    [[nodiscard]] int unfinished() const { return unfinished_; }
    [[nodiscard]] const std::vector<double>& eyes() const { return eyes_; }

private:
    std::vector<const Technique*>& log_;
    gl::GlProgram program_;
    gl::GlVertexArray no_attributes_ = gl::GlVertexArray::generate();
    GLsync fence_ = nullptr;
    int unfinished_ = 0;
    std::vector<double> eyes_;
};

class Timing : public ::testing::Test {
protected:
    void SetUp() override {
        Result<std::unique_ptr<display::SurfacelessDisplay>> display =
            display::SurfacelessDisplay::create(320, 200);
        ASSERT_TRUE(display) << display.error().message;
        display_ = std::move(*display);
        glBindFramebuffer(GL_FRAMEBUFFER, display_->framebuffer());
        glViewport(0, 0, 320, 200);
    }
    std::unique_ptr<display::SurfacelessDisplay> display_;
    std::vector<const Technique*> log_;
};

std::vector<BenchPose> three_poses() {
    std::vector<BenchPose> poses(3);
    for (std::size_t k = 0; k < poses.size(); ++k) {
        poses[k].eye_m = {static_cast<double>(k), 0.0, 0.0};
    }
    return poses;
}

TEST_F(Timing, EachDrawIsFinishedBeforeTheNextBegins) {
    Heavy heavy(log_);
    heavy.draw({});
    heavy.draw({}); // no caller waits for the first
    ASSERT_GT(heavy.unfinished(), 0)
        << "this driver draws at once, so this test cannot see a missing glFinish";
    glFinish();
    Heavy a(log_);
    Heavy b(log_);
    const std::vector<Technique*> both = {&a, &b};
    (void)time_interleaved(both, three_poses(), {4, 2}, [](double) {});
    EXPECT_EQ(a.unfinished() + b.unfinished(), 0);
}

TEST_F(Timing, EachTechniqueDrawsEachPoseOnceARound) {
    Heavy a(log_);
    Heavy b(log_);
    const std::vector<Technique*> both = {&a, &b};
    constexpr int rounds = 20;
    constexpr int warm_up = 2;
    double last = 0.0;
    const std::vector<FrameTimes> times =
        time_interleaved(both, three_poses(), {rounds, warm_up}, [&last](double done) {
            EXPECT_GT(done, last);
            last = done;
        });
    EXPECT_EQ(last, 1.0);
    ASSERT_EQ(times.size(), 2U);
    for (const Heavy* one : {&a, &b}) {
        EXPECT_EQ(one->eyes().size(), std::size_t{warm_up + 3 * rounds});
        for (const double eye : {1.0, 2.0}) {
            EXPECT_EQ(std::count(one->eyes().begin(), one->eyes().end(), eye), rounds);
        }
    }
    for (const FrameTimes& one : times) {
        EXPECT_EQ(one.wall_ms.size(), std::size_t{3 * rounds});
        EXPECT_EQ(one.cpu_ms.size(), std::size_t{3 * rounds});
        EXPECT_GT(*std::min_element(one.wall_ms.begin(), one.wall_ms.end()), 0.0);
    }
    // Neither always follows the other: of 60 pairs in a shuffled order, far from all begin with the same
    // one.
    int first = 0;
    for (std::size_t k = 2 * warm_up; k < log_.size(); k += 2) {
        EXPECT_NE(log_[k], log_[k + 1]);
        first += log_[k] == &a ? 1 : 0;
    }
    EXPECT_GT(first, 15);
    EXPECT_LT(first, 45);
}

TEST(SpreadOfTimes, IsTheMedianAndTheOuterTenths) {
    std::vector<double> values;
    for (int k = 100; k >= 0; --k) {
        values.push_back(k);
    }
    const Spread spread = spread_of(values);
    EXPECT_NEAR(spread.median, 50.0, 1e-12);
    EXPECT_NEAR(spread.p10, 10.0, 1e-12);
    EXPECT_NEAR(spread.p90, 90.0, 1e-12);
}

} // namespace
} // namespace frustumscreen::bench

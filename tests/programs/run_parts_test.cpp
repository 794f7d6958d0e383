// The parts of a run: the error screen, the meaning of its end, and its output.

#include "app/programs/frustumscreen/run_end.h"
#include "app/programs/frustumscreen/run_output.h"
#include "app/programs/frustumscreen/run_show.h"
#include "app/render/read_back.h"
#include "app/simulation/visitor_view.h"
#include "firmware_host/base/json.h"
#include "firmware_host/display/surfaceless_display.h"
#include "firmware_host/sound/wav_sound.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace frustumscreen::programs {
namespace {

namespace fs = std::filesystem;
using std::chrono::minutes;
using std::chrono::seconds;

Result<show::LoopResult> lasted(Nanoseconds length) {
    show::LoopResult result;
    result.status.uptime_s = to_seconds(length);
    return result;
}
const Error no_pack{ErrorKind::BadConfiguration, "test.no_pack", "there is no pack"};
const Error no_display{ErrorKind::DeviceLost, "test.no_display", "the display is gone"};
const Result<show::LoopResult> failed = tl::unexpected<Error>(no_display);

TEST(RunEnd, RunWithAShowEndsAsDone) {
    for (const Nanoseconds length : {Nanoseconds(0), Nanoseconds(minutes(600))}) {
        const RunEnd end = end_of_run(lasted(length), {}, false);
        EXPECT_EQ(end.why, RunEnd::Why::Done);
        EXPECT_FALSE(end.error);
    }
}

TEST(RunEnd, ErrorScreenFailsAfterAMinute) {
    EXPECT_EQ(end_of_run(lasted(seconds(59)), no_pack, false).why, RunEnd::Why::Done)
        << "it was told to stop";
    for (const Nanoseconds length : {Nanoseconds(seconds(60)), Nanoseconds(seconds(61))}) {
        const RunEnd end = end_of_run(lasted(length), no_pack, false);
        EXPECT_EQ(end.why, RunEnd::Why::Failed);
        EXPECT_EQ(end.error.value_or(no_display).message, no_pack.message);
    }
}

TEST(RunEnd, InstalledSetEndsTheErrorScreenWithoutFailure) {
    for (const Nanoseconds length : {Nanoseconds(seconds(1)), Nanoseconds(minutes(2))}) {
        EXPECT_EQ(end_of_run(lasted(length), no_pack, true).why, RunEnd::Why::SetInstalled);
    }
}

TEST(RunEnd, FailedLoopReportsItsOwnError) {
    for (const auto& error_screen : {std::optional<Error>(), std::optional(no_pack)}) {
        for (const bool set_came : {false, true}) {
            const RunEnd end = end_of_run(failed, error_screen, set_came);
            EXPECT_EQ(end.why, RunEnd::Why::Failed);
            EXPECT_EQ(end.error.value_or(no_pack).message, no_display.message);
        }
    }
}

class RunShow : public ::testing::Test {
protected:
    void SetUp() override {
        ::unsetenv("JOURNAL_STREAM");
        settings.projector.pinhole.width = width;
        settings.projector.pinhole.height = height;
        auto made = display::SurfacelessDisplay::create(width, height);
        ASSERT_TRUE(made) << made.error().message;
        display = std::move(*made);
    }
    [[nodiscard]] image::Image8 picture_of(show::Show& show) const {
        const render::DrawResult drawn =
            show.draw(MonotonicTime(seconds(1)), tracking::TrackedState{},
                      {display->framebuffer(), display->buffer_age()}, render::Redraw::Everything);
        EXPECT_TRUE(drawn.drawn);
        return render::read_colour(display->framebuffer(), width, height);
    }
    [[nodiscard]] std::unique_ptr<show::Show> error_screen_for(const std::string& message) {
        ::testing::internal::CaptureStderr();
        Result<std::unique_ptr<show::Show>> error_screen = make_error_screen(
            settings, service::Journal("test"), {ErrorKind::BadInput, "test.excuse", message});
        said = ::testing::internal::GetCapturedStderr();
        EXPECT_TRUE(error_screen);
        return error_screen ? std::move(*error_screen) : nullptr;
    }

    static constexpr int width = 320, height = 200;
    settings::Settings settings;
    std::unique_ptr<display::SurfacelessDisplay> display;
    std::string said;
};

TEST_F(RunShow, ErrorScreenShowsItsErrorInTheJournalAndOnTheTable) {
    const std::unique_ptr<show::Show> cat = error_screen_for("no cat");
    ASSERT_NE(cat, nullptr);
    EXPECT_NE(said.find("no cat"), std::string::npos) << said;
    EXPECT_EQ(cat->state().state, exhibit::State::Fault) << "the watchdog is to see that it is no artifact";
    EXPECT_FALSE(cat->sleeps());
    const image::Image8 of_cat = picture_of(*cat);
    EXPECT_TRUE(std::any_of(of_cat.texels.begin(), of_cat.texels.end(),
                            [](const glm::u8vec4& texel) { return texel.x > 0; }));
    const std::unique_ptr<show::Show> dog = error_screen_for("no dog");
    ASSERT_NE(dog, nullptr);
    EXPECT_NE(picture_of(*dog).texels, of_cat.texels) << "its words are in the picture";
}

TEST_F(RunShow, TheAlignmentPatternNeedsNoPack) {
    RunRequest request;
    request.pattern = true;
    const auto show = make_show(request, settings, scene::DevicePlan{}, *display, MonotonicTime{});
    ASSERT_TRUE(show) << show.error().message;
    EXPECT_EQ((*show)->state().state, exhibit::State::Staff);
    EXPECT_NE(picture_of(**show).texels, picture_of(*error_screen_for("no cat")).texels);
}

TEST_F(RunShow, FailsAndNamesAMissingPack) {
    RunRequest request;
    request.show.packs = {"no-such.fspack"};
    ::testing::internal::CaptureStderr();
    const auto show = make_show(request, settings, scene::DevicePlan{}, *display, MonotonicTime{});
    ::testing::internal::GetCapturedStderr();
    ASSERT_FALSE(show);
    EXPECT_NE(show.error().message.find("no-such.fspack"), std::string::npos) << show.error().message;
}

class RunOutput : public WithTemporaryFolder {
protected:
    void SetUp() override {
        for (int k = 0; k < 2; ++k) {
            show::Still still;
            still.picture = image::Image8(4, 3);
            std::fill(still.picture.texels.begin(), still.picture.texels.end(),
                      glm::u8vec4(10 * k, 20, 30, 255));
            still.tracked_state.table_from_prop.translation = {0.125 * k, 0.25, 0.5};
            still.time = MonotonicTime(seconds(k));
            result.stills.push_back(still);
            result.rows.emplace_back();
        }
        std::ofstream(folder / simulation::visitor_cameras_name) << "of an earlier call of render";
    }
    [[nodiscard]] std::size_t lines_of(const char* file) const {
        std::ifstream text(folder / file);
        return static_cast<std::size_t>(std::count(std::istreambuf_iterator<char>(text), {}, '\n'));
    }

    show::LoopResult result;
};

TEST_F(RunOutput, ContainsPicturesPosesFramesAndSound) {
    const sound::WavSound sound{MonotonicTime{}};
    ASSERT_TRUE(write_output(folder, result, &sound));
    for (std::size_t k = 0; k < 2; ++k) {
        const Result<Bytes> png = read_file(folder / (k == 0 ? "frame_00000.png" : "frame_00001.png"));
        ASSERT_TRUE(png) << png.error().message;
        EXPECT_EQ(image::decode_png8(*png).value().texels, result.stills[k].picture.texels);
    }
    EXPECT_EQ(lines_of("poses.csv"), 1U + 2 * 2) << "the prop and the head";
    EXPECT_EQ(lines_of("frames.csv"), 1U + 2);
    EXPECT_TRUE(fs::exists(folder / "sound.wav"));
    EXPECT_FALSE(fs::exists(folder / simulation::visitor_cameras_name));
}

TEST_F(RunOutput, HasNoSoundFileForASilentRun) {
    ASSERT_TRUE(write_output(folder, result, nullptr));
    EXPECT_FALSE(fs::exists(folder / "sound.wav"));
}

TEST_F(RunOutput, NamesAFileThatCannotBeWritten) {
    const sound::WavSound sound{MonotonicTime{}};
    for (const char* name : {"frame_00001.png", "poses.csv", "frames.csv", "sound.wav"}) {
        fs::create_directories(folder / name / "in the way");
        const Result<void> written = write_output(folder, result, &sound);
        ASSERT_FALSE(written) << name;
        EXPECT_NE(written.error().message.find((folder / name).string()), std::string::npos)
            << written.error().message;
        fs::remove_all(folder / name);
    }
}

TEST_F(RunOutput, ReportIsTextOrJson) {
    result.status.frames = 1234;
    result.status.frame_ms = {2.0, 3.0, 5.0};
    const auto reported = [this](const RunRequest& request) {
        ::testing::internal::CaptureStdout();
        report(request, result);
        return ::testing::internal::GetCapturedStdout();
    };
    RunRequest request;
    EXPECT_EQ(reported(request).find("1234 frames in "), 0U) << reported(request);
    EXPECT_EQ(reported(request).find("changes of artifact"), std::string::npos);
    request.changes = 7;
    request.out = folder;
    EXPECT_NE(reported(request).find("7 changes of artifact"), std::string::npos) << reported(request);
    EXPECT_NE(reported(request).find("p99/p50 2.50"), std::string::npos) << reported(request);
    EXPECT_NE(reported(request).find("2 pictures in " + folder.string()), std::string::npos);
    request.json = true;
    const nlohmann::json status = nlohmann::json::parse(reported(request), nullptr, false);
    ASSERT_TRUE(status.is_object());
    EXPECT_EQ(status.at("frames"), 1234);
}

} // namespace
} // namespace frustumscreen::programs

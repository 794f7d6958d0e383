// The watchdog is fed by what the projector shows, not by what was drawn for it.

#include "app/render/probe.h"
#include "app/show/run_watch.h"
#include "tests/service/notify_socket.h"

#include <gtest/gtest.h>

namespace frustumscreen::show {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A projector that shows a code given by the test.
class FakeProjector final : public display::Display {
public:
    std::uint8_t code = 0;
    bool is_settled = true;
    std::optional<MonotonicTime> promise;

    [[nodiscard]] bool settled() const override { return is_settled; }
    [[nodiscard]] std::optional<MonotonicTime> alive_until() const override { return promise; }
    [[nodiscard]] int width() const override { return 320; }
    [[nodiscard]] int height() const override { return 200; }
    [[nodiscard]] unsigned framebuffer() const override { return 0; }
    [[nodiscard]] int buffer_age() const override { return 1; }
    [[nodiscard]] Result<MonotonicTime> present(MonotonicTime now) override { return now; }
    [[nodiscard]] std::string name() const override { return "fake"; }
    [[nodiscard]] bool read_shown(std::span<std::byte> rgba) const override {
        for (std::size_t k = 0; k < rgba.size() / 4; ++k) { // grey of code 1 or 2: probe.h
            const auto grey = static_cast<std::byte>(1U + ((code >> k) & 1U));
            rgba[4 * k] = rgba[4 * k + 1] = rgba[4 * k + 2] = grey;
            rgba[4 * k + 3] = std::byte{255};
        }
        return true;
    }
};

class RunWatchTest : public ::testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(socket.bound());
        ::setenv("NOTIFY_SOCKET", socket.path().c_str(), 1);
        ::setenv("WATCHDOG_USEC", "6000000", 1);
        ::unsetenv("WATCHDOG_PID");
        manager.emplace();
        watch.emplace(*manager, journal);
        watch->begin(now, false, nowhere);
    }
    void TearDown() override {
        ::unsetenv("NOTIFY_SOCKET");
        ::unsetenv("WATCHDOG_USEC");
    }
    /// Presents at 60 Hz for `length`; returns how often the watchdog was fed.
    int meals_in(seconds length, bool shows_another) {
        int meals = 0;
        for (const MonotonicTime end = now + length; now < end; now += milliseconds(16)) {
            projector.code = static_cast<std::uint8_t>(projector.code + (shows_another ? 1 : 0));
            watch->presented(now, projector, true);
            watch->look(now, projector, inputs);
            while (const std::optional<std::string> message = socket.receive()) {
                meals += *message == "WATCHDOG=1" ? 1 : 0;
                ready += *message == "READY=1" ? 1 : 0;
            }
        }
        return meals;
    }

    StatusFile nowhere{{.status_file = {}}};
    service::NotifySocket socket;
    std::optional<service::ServiceManager> manager;
    service::Journal journal{"frustumscreen"};
    std::optional<RunWatch> watch;
    FakeProjector projector;
    Inputs inputs;
    MonotonicTime now{seconds(100)};
    int ready = 0;
};

TEST_F(RunWatchTest, IsReadyOnlyWhenThePictureIsOn) {
    projector.is_settled = false;
    meals_in(seconds(1), true);
    EXPECT_EQ(ready, 0);
    projector.is_settled = true;
    meals_in(seconds(1), true);
    EXPECT_EQ(ready, 1);
}

TEST_F(RunWatchTest, StopsFeedingWhenTheDisplayThreadHangs) {
    projector.promise = now + seconds(5);
    EXPECT_GE(meals_in(seconds(5), true), 4);
    EXPECT_LE(meals_in(seconds(5), true), 1);
}

TEST_F(RunWatchTest, FeedsWhileThePictureChangesAndElseLogsTheReason) {
    const int meals = meals_in(seconds(10), true);
    EXPECT_GE(meals, 9);
    EXPECT_LE(meals, 11);
    EXPECT_EQ(ready, 1);
    ::testing::internal::CaptureStderr();
    (void)meals_in(seconds(4), false); // drawn and presented, but the projector keeps one picture
    EXPECT_EQ(meals_in(seconds(10), false), 0);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(),
              "frustumscreen: watchdog: not fed: the picture that is presented is not the one that was "
              "drawn\n"); // once
    EXPECT_GE(meals_in(seconds(10), true), 9);
}

TEST_F(RunWatchTest, LogsWhenTheLibraryDiskHangsAndAnswersAgain) {
    RunStatus status;
    ::testing::internal::CaptureStderr();
    watch->note(status);
    status.library_hangs = true;
    watch->note(status);
    watch->note(status);
    status.library_hangs = false;
    watch->note(status);
    EXPECT_EQ(
        ::testing::internal::GetCapturedStderr(),
        "frustumscreen: set: the library's disk does not answer; no other set can come until it answers\n"
        "frustumscreen: set: the library's disk answers again\n");
}

TEST_F(RunWatchTest, LogsEachChangeOnce) {
    RunStatus status;
    status.artifact = "Cat";
    status.language = "en";
    status.level = "level0";
    status.tracker = Sentence("the tracker is running");
    ::testing::internal::CaptureStderr();
    watch->note(status);
    watch->note(status);
    status.tracker = Sentence("no tracker is connected");
    watch->note(status);
    status.level = "level1"; // has no line of its own
    watch->note(status);
    status.sound = Sentence("its sound goes to default");
    watch->note(status);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "frustumscreen: shows Cat (en, level0)\n"
                                                        "frustumscreen: tracker: the tracker is running\n"
                                                        "frustumscreen: tracker: no tracker is connected\n"
                                                        "frustumscreen: sound: its sound goes to default\n");
    EXPECT_EQ(socket.receive(), "STATUS=the tracker is running; shows Cat (en, level0)");
    EXPECT_EQ(socket.receive(), "STATUS=no tracker is connected; shows Cat (en, level0)");
    EXPECT_EQ(socket.receive(), "STATUS=no tracker is connected; shows Cat (en, level1)");
    EXPECT_EQ(socket.receive(),
              "STATUS=no tracker is connected; its sound goes to default; shows Cat (en, level1)");
    EXPECT_EQ(socket.receive(), std::nullopt);
}

} // namespace
} // namespace frustumscreen::show

// When the loop ends by itself.

#include "app/counts/day_counts.h"
#include "app/counts/visit_book.h"
#include "app/show/run_loop.h"
#include "firmware_host/base/file.h"
#include "tests/base/temporary_folder.h"
#include "tests/display/no_display.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen::show {
namespace {

using std::chrono::seconds;

/// Draws nothing.
class DarkShow : public Show {
public:
    void step(MonotonicTime now, std::span<const settings::Command> /*commands*/,
              const tracking::TrackedState& /*on_table*/) override {
        now_ = now;
    }
    [[nodiscard]] render::DrawResult draw(MonotonicTime /*now*/, const tracking::TrackedState& /*on_table*/,
                                          const render::RenderTarget& /*target*/,
                                          render::Redraw /*redraw*/) override {
        return {};
    }

protected:
    MonotonicTime now_;
};

/// Stays in State::Fault from `fault_from` to `fault_until`.
class FaultyShow final : public DarkShow {
public:
    [[nodiscard]] ShowState state() const override {
        ShowState state;
        state.state = now_ >= fault_from && now_ < fault_until ? exhibit::State::Fault : exhibit::State::View;
        return state;
    }
    MonotonicTime fault_from, fault_until;
};

/// Runs on a clock that advances by one frame.
Result<LoopResult> run_fast(Show& show, Inputs& inputs, Nanoseconds length, MonotonicTime start,
                            counts::VisitBook* visits = nullptr) {
    LoopOptions options;
    options.visits = visits;
    options.length = length;
    options.fast = true;
    display::NoDisplay display;
    StatusFile no_file{{.status_file = {}}};
    service::ServiceManager manager;
    const service::Journal journal("test");
    RunWatch watch(manager, journal);
    return run_loop(settings::Settings{}, display, inputs, show, options, no_file, watch, start);
}

Result<LoopResult> run_with(Nanoseconds from, Nanoseconds until) {
    const MonotonicTime start = monotonic_now();
    FaultyShow show;
    show.fault_from = start + from;
    show.fault_until = start + until;
    Inputs inputs;
    return run_fast(show, inputs, seconds(200), start);
}

/// In use from the 10th second to the 30th; at rest from the 50th on.
class UsedShow final : public DarkShow {
public:
    explicit UsedShow(MonotonicTime start) : start_(start) {}
    [[nodiscard]] ShowState state() const override {
        const Nanoseconds run = now_ - start_;
        ShowState state;
        state.state =
            run < seconds(10) || run >= seconds(50) ? exhibit::State::Attract : exhibit::State::View;
        state.artifact = "Amphora";
        state.language = "en";
        if (run >= seconds(10)) {
            state.used = start_ + std::min<Nanoseconds>(run, seconds(30));
        }
        return state;
    }

private:
    MonotonicTime start_;
};

/// No visitor until `comes`; records the drift marks.
class QuietShow final : public DarkShow {
public:
    void set_mark(const std::optional<drift::ShownMark>& mark) override {
        while_quiet += mark && now_ < comes ? 1 : 0;
        while_used += mark && now_ > comes ? 1 : 0;
    }
    [[nodiscard]] ShowState state() const override {
        ShowState state;
        state.state = now_ < comes ? exhibit::State::Attract : exhibit::State::View;
        return state;
    }
    MonotonicTime comes;
    int while_quiet = 0, while_used = 0;
};

TEST(RunLoop, ShowsDriftMarksOnlyWhileNobodyIsThere) {
    const MonotonicTime start = monotonic_now();
    QuietShow show;
    show.comes = start + seconds(62);
    Inputs inputs;
    inputs.drift = std::make_unique<drift::DriftWatch>(
        drift::DriftSetUp{{{-0.3, 0.2}, {0.3, -0.2}, {0.3, 0.2}, {-0.3, -0.2}}, {}, {}});
    const Result<LoopResult> run = run_fast(show, inputs, seconds(150), start);
    ASSERT_TRUE(run) << run.error().message;
    EXPECT_NEAR(show.while_quiet, 4 * 30, 8) << "four marks, half a second each, at 60 pictures a second";
    EXPECT_EQ(show.while_used, 0) << "the next set had hardly begun";
    EXPECT_EQ(run->status.camera_for, "the picture's place");
    EXPECT_NE(run->status.drift.view().find("the camera records where the calibrated picture lies"),
              std::string_view::npos);
    EXPECT_FALSE(run->status.drifted);
}

/// Draws something new in every third frame.
class TimedShow final : public Show {
public:
    void step(MonotonicTime /*now*/, std::span<const settings::Command> /*commands*/,
              const tracking::TrackedState& /*on_table*/) override {}
    [[nodiscard]] render::DrawResult draw(MonotonicTime now, const tracking::TrackedState& /*on_table*/,
                                          const render::RenderTarget& /*target*/,
                                          render::Redraw /*redraw*/) override {
        render::DrawResult result;
        result.drawn = ++frames % 3 == 0;
        if (result.drawn) {
            result.redrawn = {0, 0, 64, 40};
            drawn.push_back(now);
        }
        return result;
    }
    void record_time(MonotonicTime now, double ms) override {
        timed.push_back(now);
        min_ms = std::min(min_ms, ms);
    }
    [[nodiscard]] ShowState state() const override { return {}; }

    int frames = 0;
    std::vector<MonotonicTime> drawn, timed;
    double min_ms = 1.0;
};

TEST(RunLoop, ReportsTheTimeOfEachDrawnFrameToTheShow) {
    const MonotonicTime start = monotonic_now();
    TimedShow show;
    Inputs inputs;
    const Result<LoopResult> run = run_fast(show, inputs, seconds(2), start);
    ASSERT_TRUE(run) << run.error().message;
    EXPECT_GT(show.drawn.size(), 30U);
    EXPECT_EQ(show.timed, show.drawn);
    EXPECT_GT(show.min_ms, 0.0);
}

TEST(RunLoop, EndsIfNothingCanBeShownForAMinute) {
    const Result<LoopResult> ended = run_with(seconds(10), seconds(200));
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().kind, ErrorKind::BadConfiguration);
}

TEST(RunLoop, ContinuesIfArtifactsReturnWithinAMinute) {
    const Result<LoopResult> run = run_with(seconds(10), seconds(69));
    ASSERT_TRUE(run) << run.error().message;
    EXPECT_NEAR(run->status.uptime_s.value_or(0.0), 200.0, 0.1);
}

class CountedRun : public WithTemporaryFolder {};

/// The picture's time is simulated, that of the visit book's thread is not.
TEST_F(CountedRun, CountsVisits) {
    {
        counts::VisitBook visits(folder, [](std::chrono::sys_seconds) { return seconds(0); });
        const MonotonicTime start = monotonic_now();
        UsedShow show(start);
        Inputs inputs;
        const Result<LoopResult> result = run_fast(show, inputs, seconds(100), start, &visits);
        ASSERT_TRUE(result) << result.error().message;
        EXPECT_TRUE(result->status.visits);
    }
    std::uint64_t count = 0;
    double length_s = 0.0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const Result<Bytes> bytes = read_file(entry.path());
        ASSERT_TRUE(bytes);
        const Result<counts::DayCounts> day = counts::parse_day_counts(as_text(*bytes));
        ASSERT_TRUE(day) << day.error().message;
        count += day->all().visits;
        length_s += 1e-3 * static_cast<double>(day->artifacts.at("Amphora").ms);
    }
    EXPECT_EQ(count, 1U);
    EXPECT_NEAR(length_s, 40.0, 0.2) << "from the first touch until it rests";
}

} // namespace
} // namespace frustumscreen::show

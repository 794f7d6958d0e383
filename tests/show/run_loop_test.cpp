// When the loop ends by itself.

#include "app/show/run_loop.h"

#include <gtest/gtest.h>

namespace frustumscreen {
namespace {

using std::chrono::seconds;

class NoDisplay final : public Display {
public:
    [[nodiscard]] int width() const override { return 64; }
    [[nodiscard]] int height() const override { return 40; }
    [[nodiscard]] unsigned framebuffer() const override { return 0; }
    [[nodiscard]] int buffer_age() const override { return 1; }
    [[nodiscard]] Result<MonotonicTime> present(MonotonicTime now) override { return now; }
    [[nodiscard]] std::string name() const override { return "none"; }
};

/// Is in State::Fault from `fault_from` to `fault_until`.
class FaultyShow final : public Show {
public:
    void step(MonotonicTime now, std::span<const Command> /*commands*/,
              const Situation& /*on_table*/) override {
        now_ = now;
    }
    [[nodiscard]] DrawResult draw(MonotonicTime /*now*/, const Situation& /*on_table*/,
                                  const RenderTarget& /*target*/, Redraw /*redraw*/) override {
        return {};
    }
    [[nodiscard]] ShowState state() const override {
        ShowState state;
        state.state = now_ >= fault_from && now_ < fault_until ? State::Fault : State::View;
        return state;
    }
    MonotonicTime fault_from, fault_until;

private:
    MonotonicTime now_;
};

Result<LoopResult> run_with(Nanoseconds from, Nanoseconds until) {
    const MonotonicTime start = monotonic_now();
    FaultyShow show;
    show.fault_from = start + from;
    show.fault_until = start + until;
    LoopOptions options;
    options.length = seconds(200);
    options.fast = true;
    NoDisplay display;
    Inputs inputs;
    StatusFile no_file{std::filesystem::path{}};
    ServiceManager manager;
    const Journal journal("test");
    RunWatch watch(manager, journal);
    return run_loop(Settings{}, display, inputs, show, options, no_file, watch, start);
}

TEST(RunLoop, EndsWhereNothingCanBeShownForAMinute) {
    const Result<LoopResult> ended = run_with(seconds(10), seconds(200));
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().kind, ErrorKind::BadConfiguration);
}

TEST(RunLoop, GoesOnWhereSomethingComesBack) {
    const Result<LoopResult> run = run_with(seconds(10), seconds(69));
    ASSERT_TRUE(run) << run.error().message;
    EXPECT_NEAR(run->status.uptime_s, 200.0, 0.1);
}

} // namespace
} // namespace frustumscreen

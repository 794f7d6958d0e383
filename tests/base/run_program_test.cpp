// Running other programs: how each way of ending is reported. Voices are tested in tests/texts.
#include "firmware_host/base/run_program.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>

namespace frustumscreen {
namespace {

using namespace std::chrono_literals;

TEST(FollowProgram, ReportsStatusSignalOutputAndStandardError) {
    ProgramLimits limits;
    limits.complaint_bytes = 9;
    const Result<ProgramEnd> ended =
        follow_program({"sh", "-c", "cat; echo complains at length >&2; exit 3"}, "in", limits);
    ASSERT_TRUE(ended) << ended.error().message;
    EXPECT_EQ(ended->how, ProgramEnd::How::ByItself);
    EXPECT_EQ(ended->status, 3);
    EXPECT_EQ(as_text(ended->output), "in");
    EXPECT_EQ(ended->complaint, "complains");
    EXPECT_EQ(follow_program({"sh", "-c", "kill -SEGV $$"}, "", limits)->status, -SIGSEGV);
    EXPECT_FALSE(follow_program({"/nowhere/program"}, "", limits));
}

TEST(FollowProgram, KillsTheProgramWhenGivenUp) {
    ProgramLimits limits;
    limits.time = 100s;
    std::atomic<int> asked{0};
    limits.given_up = [&] { return ++asked == 3; };
    EXPECT_EQ(follow_program({"sleep", "1000"}, "", limits)->how, ProgramEnd::How::GivenUp);
    EXPECT_EQ(asked, 3);
}

TEST(FollowProgram, ProgramInheritsNoBlockedSignals) {
    sigset_t held;
    sigset_t before;
    sigemptyset(&held);
    sigaddset(&held, SIGTERM);
    ASSERT_EQ(::pthread_sigmask(SIG_BLOCK, &held, &before), 0);
    const Result<ProgramEnd> ended = follow_program({"sh", "-c", "kill -TERM $$; echo still here"}, "", {});
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    ASSERT_TRUE(ended);
    EXPECT_EQ(ended->status, -SIGTERM) << as_text(ended->output);
}

} // namespace
} // namespace frustumscreen

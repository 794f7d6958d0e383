// The wait of a run for its display, on a clock that advances only during the wait.

#include "app/programs/frustumscreen/wait_for_display.h"
#include "tests/display/no_display.h"
#include "tests/service/notify_socket.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

namespace frustumscreen::programs {
namespace {

using std::chrono::seconds;

/// A machine whose display responds as the test specifies.
struct Machine {
    /// Nothing if the display is available.
    std::function<std::optional<Error>(Nanoseconds since_start)> trouble;
    MonotonicTime time = MonotonicTime(seconds(1000));
    int looks = 0, hotplugs = 0, waits = 0;
    std::function<void()> in_a_wait = [] {};

    class Waiting final : public display::Hotplug {
    public:
        explicit Waiting(Machine& machine) : machine_(machine) {}
        [[nodiscard]] bool wait(Nanoseconds at_most) override {
            ++machine_.waits;
            machine_.time += at_most;
            machine_.in_a_wait();
            return false;
        }
        void wake() override {}

    private:
        Machine& machine_;
    };

    DisplaySearch search() {
        return {[this, start = time]() -> Result<std::unique_ptr<display::Display>> {
                    ++looks;
                    if (const std::optional<Error> error = trouble(time - start)) {
                        return tl::unexpected<Error>(*error);
                    }
                    return std::make_unique<display::NoDisplay>();
                },
                [this] {
                    ++hotplugs;
                    return std::make_unique<Waiting>(*this);
                },
                [this] { return time; }};
    }
};

const Error no_card{ErrorKind::DeviceLost, "test.no_card", "there is no card"};
const Error no_permission{ErrorKind::BadConfiguration, "test.no_permission", "this user may not open it"};

class WaitForDisplay : public ::testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(socket.bound());
        ::unsetenv("JOURNAL_STREAM");
        ::setenv("NOTIFY_SOCKET", socket.path().c_str(), 1);
        machine.in_a_wait = [this] { hear(); }; // the socket holds only a few messages
    }
    void TearDown() override { ::unsetenv("NOTIFY_SOCKET"); }
    [[nodiscard]] Result<std::unique_ptr<display::Display>> waited() {
        service::ServiceManager manager;
        ::testing::internal::CaptureStderr();
        Result<std::unique_ptr<display::Display>> display =
            wait_for_display(machine.search(), stop_signals, manager, service::Journal("test"));
        said = ::testing::internal::GetCapturedStderr();
        return display;
    }
    void hear() {
        while (const std::optional<std::string> message = socket.receive()) {
            heard.push_back(*message);
        }
    }
    [[nodiscard]] int times_said(const Error& error) const {
        int times = 0;
        for (std::size_t at = 0; (at = said.find(error.message, at)) != std::string::npos; ++at) {
            ++times;
        }
        return times;
    }

    service::NotifySocket socket;
    service::StopSignals stop_signals;
    Machine machine;
    std::string said;
    std::vector<std::string> heard; ///< messages to the service manager during the wait
};

TEST_F(WaitForDisplay, TakesAnAvailableDisplayAtOnce) {
    machine.trouble = [](Nanoseconds) { return std::nullopt; };
    const auto display = waited();
    ASSERT_TRUE(display);
    EXPECT_EQ((*display)->name(), "none");
    EXPECT_EQ(machine.hotplugs, 0);
    EXPECT_EQ(socket.receive(), std::nullopt);
    EXPECT_EQ(said, "");
}

TEST_F(WaitForDisplay, FailsAtOnceWithoutAService) {
    ::unsetenv("NOTIFY_SOCKET");
    machine.trouble = [](Nanoseconds) { return no_card; };
    const auto display = waited();
    ASSERT_FALSE(display);
    EXPECT_EQ(display.error().message, no_card.message);
    EXPECT_EQ(machine.looks, 1);
    EXPECT_EQ(machine.hotplugs, 0);
    EXPECT_EQ(said, "") << "the program says it";
}

TEST_F(WaitForDisplay, WaitsForAMissingCardWithoutALimit) {
    machine.trouble = [](Nanoseconds since) {
        return since < seconds(600) ? std::optional(no_card) : std::nullopt;
    };
    ASSERT_TRUE(waited());
    EXPECT_EQ(machine.looks, 601);
    EXPECT_EQ(machine.hotplugs, 1);
    EXPECT_EQ(times_said(no_card), 1);
}

TEST_F(WaitForDisplay, ReportsTheReasonAndExtendsTheTimeoutAtEachTry) {
    machine.trouble = [](Nanoseconds since) {
        return since < seconds(3) ? std::optional(no_card) : std::nullopt;
    };
    ASSERT_TRUE(waited());
    const std::string more_time = "EXTEND_TIMEOUT_USEC=10000000"; // as sd_notify(3) has it
    EXPECT_EQ(heard,
              (std::vector<std::string>{"STATUS=" + no_card.message, more_time, more_time, more_time}));
}

TEST_F(WaitForDisplay, WaitsForAnUnusableCardWhileBooting) {
    machine.trouble = [](Nanoseconds since) {
        return since < longest_boot ? std::optional(no_permission) : std::nullopt;
    };
    EXPECT_TRUE(waited());
    EXPECT_EQ(times_said(no_permission), 1);
}

TEST_F(WaitForDisplay, FailsForAnUnusableCardAfterTheLongestBoot) {
    machine.trouble = [](Nanoseconds) { return no_permission; };
    const auto display = waited();
    ASSERT_FALSE(display);
    EXPECT_EQ(display.error().kind, no_permission.kind);
    EXPECT_EQ(display.error().message, no_permission.message);
    EXPECT_EQ(machine.waits, longest_boot / seconds(1));
}

TEST_F(WaitForDisplay, LogsEachNewReasonOnce) {
    machine.trouble = [](Nanoseconds since) -> std::optional<Error> {
        if (since >= seconds(20)) {
            return std::nullopt;
        }
        return since < seconds(10) ? no_card : no_permission;
    };
    ASSERT_TRUE(waited());
    EXPECT_EQ(times_said(no_card), 1);
    EXPECT_EQ(times_said(no_permission), 1);
}

TEST_F(WaitForDisplay, StopSignalKillsTheProcessOnlyWhileWaiting) {
    machine.trouble = [](Nanoseconds) { return no_card; };
    machine.in_a_wait = [] { // as a service manager: to the process, of which another thread takes it
        ::kill(::getpid(), SIGTERM);
        ::pause();
    };
    service::ServiceManager manager;
    EXPECT_EXIT(static_cast<void>(
                    wait_for_display(machine.search(), stop_signals, manager, service::Journal("test"))),
                ::testing::KilledBySignal(SIGTERM), no_card.message);
    machine.in_a_wait = [] {};
    machine.trouble = [](Nanoseconds since) {
        return since < seconds(2) ? std::optional(no_card) : std::nullopt;
    };
    ASSERT_TRUE(waited());
    ::raise(SIGTERM);
    EXPECT_TRUE(stop_signals.received());
}

} // namespace
} // namespace frustumscreen::programs

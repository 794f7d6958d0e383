// `frustumscreen run` as seen by a service manager: ready, fed, starved, stopped.

#include "tests/base/comes_true.h"
#include "tests/folders.h"
#include "tests/programs/hung_thread.h"
#include "tests/programs/kiosk_folder.h"
#include "tests/service/notify_socket.h"

#include <fmt/format.h>
#include <sys/ptrace.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace frustumscreen::synthetic {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using std::chrono::seconds;

/// A service manager, which reads at all times: the exhibit would wait for one that lets ten messages lie.
class ReadingManager {
public:
    [[nodiscard]] std::string path() const { return socket_.path(); }
    /// Whether a message that begins with `beginning` was sent by now; forgets it, and those before it.
    [[nodiscard]] bool was_told(const std::string& beginning) {
        const std::lock_guard lock(mutex_);
        read();
        while (!messages_.empty()) {
            const std::string message = std::move(messages_.front());
            messages_.pop_front();
            if (message.starts_with(beginning)) {
                return true;
            }
        }
        return false;
    }
    void forget() {
        const std::lock_guard lock(mutex_);
        read();
        messages_.clear();
    }

private:
    void read() {
        while (std::optional<std::string> message = socket_.receive()) {
            messages_.push_back(std::move(*message));
        }
    }

    service::NotifySocket socket_;
    std::mutex mutex_; ///< for the messages, and so that they are read in their order
    std::deque<std::string> messages_;
    std::jthread reader_{[this](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            {
                const std::lock_guard lock(mutex_);
                read();
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }}; ///< last: it uses all members above
};

/// The exhibit under a service manager whose watchdog must be fed every three seconds.
class RunService : public KioskFolder {
protected:
    void TearDown() override {
        if (process > 0) {
            ::kill(process, SIGKILL);
            ::waitpid(process, nullptr, 0);
        }
        KioskFolder::TearDown();
    }
    void start(const std::string& more = {}, const std::string& tracker = "replay",
               std::vector<std::string> options = {"--headless"}) {
        write_settings(tracker, more);
        const std::string config = folder / "kiosk.toml";
        options.insert(options.begin(), {"frustumscreen", "run", "--config", config});
        std::vector<char*> arguments;
        for (std::string& option : options) {
            arguments.push_back(option.data());
        }
        arguments.push_back(nullptr);
        const std::string program = bin_dir() + "/frustumscreen";
        process = ::fork();
        ASSERT_GE(process, 0);
        if (process == 0) {
            ::setenv("NOTIFY_SOCKET", manager.path().c_str(), 1);
            ::setenv("WATCHDOG_USEC", "3000000", 1);
            ::unsetenv("WATCHDOG_PID");
            ::setenv("ASAN_OPTIONS", "detect_leaks=0", 0);
            const std::string errors = folder / "err.txt";
            std::freopen(errors.c_str(), "w", stderr);
            std::freopen("/dev/null", "w", stdout);
            if (user) {
                static_cast<void>(::setgid(*user) + ::setuid(*user));
            }
            ::execv(program.c_str(), arguments.data());
            ::_exit(127);
        }
    }
    /// Waits for a message that begins with `beginning`.
    bool hears(const std::string& beginning) {
        return comes_true([&] { return manager.was_told(beginning); });
    }
    /// Waits until the watchdog is fed after the call.
    bool is_fed() {
        manager.forget();
        return hears("WATCHDOG=1");
    }
    /// True if the watchdog is not fed for `length` from the call.
    bool starves_for(seconds length) {
        manager.forget();
        std::this_thread::sleep_for(length);
        return !manager.was_told("WATCHDOG=1");
    }
    std::string errors() const { return text("err.txt"); }
    /// Waits until a file in the folder contains the words.
    bool comes(const char* name, const std::string& words) const {
        return comes_true([&] { return text(name).find(words) != std::string::npos; });
    }
    /// Waits for the end and returns the exit status; the negative number of a signal that ended it.
    int ending() {
        int status = 0;
        ::waitpid(std::exchange(process, 0), &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

    ReadingManager manager;
    std::optional<uid_t> user; ///< user of the exhibit; nothing: that of the test
    pid_t process = 0;
};

TEST_F(RunService, ReportsReadyAndStatusFeedsTheWatchdogAndStops) {
    start();
    ASSERT_TRUE(hears("READY=1")) << errors();
    EXPECT_TRUE(hears("STATUS=poses come from a file; no tracker is used; shows Rings (en, level0)"));
    EXPECT_TRUE(hears("WATCHDOG=1"));
    EXPECT_TRUE(hears("WATCHDOG=1")); // at rest too
    EXPECT_TRUE(hears("WATCHDOG=1"));
    const auto told = Clock::now();
    ::kill(process, SIGTERM);
    EXPECT_TRUE(hears("STOPPING=1"));
    EXPECT_EQ(ending(), 0);
    RecordProperty("stop_ms", static_cast<int>((Clock::now() - told) / std::chrono::milliseconds(1)));
    EXPECT_NE(errors().find("frustumscreen: shows Rings (en, level0)\n"), std::string::npos) << errors();
}

TEST_F(RunService, ReportsAMissingPanelAndKeepsFeedingTheWatchdog) {
    start("[panel]\nkind = \"gpio\"\nchip = \"no-such-chip\"\nlines = [\"1\"]\n");
    ASSERT_TRUE(hears("READY=1")) << errors();
    ASSERT_TRUE(
        hears("STATUS=poses come from a file; no tracker is used; the buttons' GPIO chip no-such-chip"))
        << errors();
    EXPECT_TRUE(is_fed());
    EXPECT_NE(errors().find("frustumscreen: panel: the buttons' GPIO chip no-such-chip"), std::string::npos);
    ::kill(process, SIGTERM);
    EXPECT_EQ(ending(), 0);
}

TEST_F(RunService, DoesNotFeedTheWatchdogWhileStopped) {
    start();
    ASSERT_TRUE(hears("WATCHDOG=1")) << errors();
    ::kill(process, SIGSTOP);
    int status = 0;
    ::waitpid(process, &status, WUNTRACED);
    EXPECT_TRUE(starves_for(seconds(4)));
    ::kill(process, SIGKILL); // as a service manager would
    EXPECT_EQ(ending(), -SIGKILL);
}

TEST_F(RunService, DoesNotFeedTheWatchdogWhileADeviceHangsAndStillStops) {
    start("", "usb");
    ASSERT_TRUE(hears("WATCHDOG=1")) << errors();
    const std::optional<pid_t> tracker = programs::thread_named(process, "tracker");
    ASSERT_TRUE(tracker);
    if (!programs::hang(*tracker)) {
        GTEST_SKIP() << "this machine allows no tracing";
    }
    EXPECT_TRUE(comes("err.txt", "watchdog: not fed: a device's thread hangs")) << errors();
    EXPECT_TRUE(starves_for(seconds(2)));
    ::kill(process, SIGTERM);
    ::waitpid(*tracker, nullptr, __WALL); // the tracer receives each thread's end first
    EXPECT_EQ(ending(), 0);               // although the thread could not be joined
    EXPECT_NE(errors().find("did not stop in time; ended at once"), std::string::npos) << errors();
}

TEST_F(RunService, WaitsForAMissingGraphicsCard) {
    start("[display]\nkind = \"kms\"\ncard = \"no-such-card\"\n", "replay", {});
    for (int look = 0; look < 2; ++look) { // it keeps asking for more time
        ASSERT_TRUE(hears("EXTEND_TIMEOUT_USEC=")) << errors();
    }
    EXPECT_EQ(errors(), "frustumscreen: display: /dev/dri/no-such-card cannot be opened: No such file or "
                        "directory; is it the card's name, and is its driver loaded?\n");
    ::kill(process, SIGTERM);
    EXPECT_EQ(ending(), -SIGTERM);
}

TEST_F(RunService, WaitsForACardThatItsUserMayNotOpenYet) {
    constexpr uid_t nobody = 65534;
    const fs::path card = folder / "card";
    std::ofstream(card).put('\n');
    fs::permissions(card, fs::perms::none);
    fs::permissions(folder, fs::perms::all);
    if (::geteuid() == 0) {
        user = nobody;
        fs::permissions(manager.path(), fs::perms::all);
    }
    start("[display]\nkind = \"kms\"\ncard = \"" + card.string() + "\"\n", "replay", {});
    for (int look = 0; look < 2; ++look) {
        ASSERT_TRUE(hears("EXTEND_TIMEOUT_USEC=")) << errors();
    }
    EXPECT_EQ(errors(), "frustumscreen: display: " + card.string() +
                            " cannot be opened: Permission denied; this user must be in the group video\n");
    fs::permissions(card, fs::perms::all); // udev has set the permissions; the file still is no card
    EXPECT_TRUE(comes("err.txt", "has no connectors")) << errors();
    ::kill(process, SIGTERM);
    EXPECT_EQ(ending(), -SIGTERM);
}

TEST_F(RunService, ReportsAFailedRecordingAndKeepsRunning) {
    start("", "usb",
          {"--headless", "--record", folder / "no-such-folder/fault.packets", "--status-file",
           folder / "status.json"});
    ASSERT_TRUE(hears("READY=1")) << errors();
    EXPECT_TRUE(comes("err.txt", "frustumscreen: recording: nothing is recorded: ")) << errors();
    EXPECT_TRUE(comes("status.json", "\"recording\": \"nothing is recorded: "));
    EXPECT_TRUE(is_fed());
    ::kill(process, SIGTERM);
    EXPECT_EQ(ending(), 0);
}

TEST_F(RunService, ReportsAHungRenderThreadAndItsRecovery) {
    start("", "replay", {"--headless", "--status-file", folder / "status.json"});
    ASSERT_TRUE(hears("WATCHDOG=1")) << errors();
    ASSERT_TRUE(comes("status.json", "\"health\": \"well\"")) << text("status.json");
    if (!programs::hang(process)) {
        GTEST_SKIP() << "this machine allows no tracing";
    }
    EXPECT_TRUE(comes("err.txt", "watchdog: the picture hangs: the exhibit was silent for 4 s, while it "))
        << errors();
    EXPECT_TRUE(comes("status.json", "\"health\": \"hangs\""));
    ::ptrace(PTRACE_DETACH, process, nullptr, nullptr);
    EXPECT_TRUE(comes("err.txt", "watchdog: the exhibit responds again")) << errors();
    EXPECT_TRUE(comes("status.json", "\"health\": \"well\""));
    ::kill(process, SIGTERM);
    EXPECT_EQ(ending(), 0);
}

TEST_F(RunService, StaffGetTheProjectedPictureAndTheStatus) {
    const auto run = [this](const std::string& arguments) {
        return shell(fmt::format("'{}/frustumscreen' {} 2>>program.txt", bin_dir(), arguments));
    };
    ASSERT_EQ(run("run --config kiosk.toml --headless --fast --seconds 20 --stills 20 --out out >said.txt"),
              0)
        << text("program.txt");
    std::vector<std::string> stills;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / "out")) {
        if (entry.path().extension() == ".png") {
            stills.push_back(text("out" / entry.path().filename()));
        }
    }
    start("", "replay",
          {"--headless", "--status-file", folder / "status.json", "--staff-socket", folder / "staff.sock"});
    ASSERT_TRUE(comes("status.json", "\"artifact\": \"Rings\"")) << errors();
    const std::string ask = "status --status-file status.json --watchdog-file none --staff-socket staff.sock "
                            "--screenshot shot.png >said.txt";
    // The first ones may show a fade, and a machine that stands still may cost a question its answer.
    const bool same = comes_true([&] {
        return run(ask) == 0 && std::find(stills.begin(), stills.end(), text("shot.png")) != stills.end();
    });
    EXPECT_TRUE(same) << stills.size() << text("program.txt") << text("said.txt");
    const std::string said = text("said.txt");
    EXPECT_TRUE(said.starts_with("The exhibit runs and is well.\n")) << said;
    EXPECT_NE(said.find("on the screen  \"Rings\" (en), for "), std::string::npos) << said;
    EXPECT_NE(said.find("tracker        poses come from a file"), std::string::npos) << said;
    ::kill(process, SIGTERM);
    EXPECT_EQ(ending(), 0) << errors();
    EXPECT_EQ(run(ask), 1);
    EXPECT_NE(text("program.txt").find("no exhibit listens there"), std::string::npos);
}

TEST_F(RunService, KeepsRunningWithoutTheStaffSocket) {
    start("", "replay", {"--headless", "--staff-socket", folder / "no-such-folder/staff.sock"});
    ASSERT_TRUE(hears("READY=1")) << errors();
    EXPECT_TRUE(comes("err.txt", "the staff's socket cannot be made: No such file or directory")) << errors();
    EXPECT_TRUE(is_fed());
    ::kill(process, SIGTERM);
    EXPECT_EQ(ending(), 0);
}

TEST_F(RunService, ShowsAnErrorWithoutAPackAndStops) {
    fs::remove(folder / "rings.fspack");
    start();
    ASSERT_TRUE(hears("READY=1")) << errors();
    EXPECT_TRUE(is_fed());
    EXPECT_NE(errors().find("be shown"), std::string::npos) << errors();
    ::kill(process, SIGTERM);
    EXPECT_EQ(ending(), 0);
}

TEST_F(RunService, ExitsAtOnceForANewlyInstalledSetWithoutAPack) {
    fs::remove(folder / "rings.fspack");
    fs::create_directory(folder / "library");
    start("library = \"library\"\n");
    ASSERT_TRUE(hears("READY=1")) << errors();
    ASSERT_TRUE(is_fed());
    std::ofstream(folder / "library/set.txt.new") << "of a stick";
    fs::rename(folder / "library/set.txt.new", folder / "library/set.txt");
    EXPECT_EQ(ending(), 0) << "after its minute it would be 1";
    EXPECT_NE(errors().find("a set of packs was installed"), std::string::npos) << errors();
}

TEST_F(RunService, StopsInTheMiddleOfLoading) {
    start();
    ::kill(process, SIGTERM);
    int status = 0;
    ::waitpid(std::exchange(process, 0), &status, 0);
    // Both are clean for a service manager, and nothing is half done.
    EXPECT_TRUE((WIFEXITED(status) && WEXITSTATUS(status) == 0) ||
                (WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM));
}

} // namespace
} // namespace frustumscreen::synthetic

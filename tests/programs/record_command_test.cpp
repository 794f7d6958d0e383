// `frustumscreen record` and `frustumscreen-poses convert`, without a device: a recording is made in memory.

#include "firmware_host/base/file.h"
#include "firmware_host/tracker/packet_replay.h"
#include "firmware_host/tracker/pose_file.h"
#include "tests/base/told.h"
#include "tests/folders.h"
#include "tests/programs/hung_thread.h"
#include "tests/programs/program_folder.h"
#include "tests/tracker/wire_bytes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace frustumscreen::programs {
namespace {

namespace fs = std::filesystem;

/// One second of a HID tracker at 100 Hz that moves along x by 1 mm a sample.
Bytes recording() {
    Bytes file;
    tracker::append_packet_header(file);
    const auto put = [&](tracker::PacketKind kind, int ms, std::span<const std::byte> payload) {
        tracker::append_packet(file, {kind, from_microseconds(1000 * (90'000 + ms)), payload});
    };
    put(tracker::PacketKind::Opened, 0, tracker::OpenedDevice{tracker::UsbTrackerModel::Hid, {}}.bytes());
    put(tracker::PacketKind::Received, 1, wire::hid_info());
    for (int k = 0; k < 100; ++k) {
        wire::HidPose pose;
        pose.counter = static_cast<std::uint32_t>(k);
        pose.time_us = static_cast<std::uint32_t>(10'000 * k);
        pose.position = {100 * k, 0, 0};
        pose.quaternion = {32767, 0, 0, 0};
        put(tracker::PacketKind::Received, 10 + 10 * k, wire::hid_pose(pose));
    }
    return file;
}

class RecordCommand : public ProgramFolder {
protected:
    void settings(const std::string& tracker) const { put("kiosk.toml", "[tracker]\n" + tracker); }
    [[nodiscard]] std::vector<tracker::PoseSample> poses(const std::string& file) const {
        const auto parsed = tracker::parse_poses(text(file), file, tracker::PoseOrder::PropAscends);
        EXPECT_TRUE(parsed) << (parsed ? "" : parsed.error().message);
        return parsed ? *parsed : std::vector<tracker::PoseSample>();
    }
    /// Records while the tracker's thread hangs, until stopped; nothing if this machine does not allow that.
    [[nodiscard]] std::optional<int> stopped_while_the_device_hangs(std::vector<const char*> more) const {
        const std::string program = bin_dir() + "/frustumscreen";
        const pid_t process = ::fork();
        if (process == 0) {
            fs::current_path(folder);
            ::setenv("ASAN_OPTIONS", "detect_leaks=0", 0);
            std::freopen("out.txt", "w", stdout);
            std::freopen("err.txt", "w", stderr);
            std::vector<const char*> all{"frustumscreen", "record", "--config", "kiosk.toml"};
            all.insert(all.end(), more.begin(), more.end());
            all.push_back(nullptr);
            ::execv(program.c_str(), const_cast<char**>(all.data()));
            ::_exit(127);
        }
        const std::optional<pid_t> tracker = thread_named(process, "tracker");
        EXPECT_TRUE(tracker);
        const bool hangs = tracker && hang(*tracker);
        ::kill(process, hangs ? SIGTERM : SIGKILL);
        // It ends even on a slow machine; a process that cannot be stopped is not waited for.
        siginfo_t ended{};
        for (int look = 0; hangs && look < 3000 && ended.si_pid == 0; ++look) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            ::waitid(P_PID, static_cast<id_t>(*tracker), &ended, WEXITED | WNOHANG | WNOWAIT | __WALL);
        }
        EXPECT_TRUE(!hangs || ended.si_pid != 0) << "it cannot be stopped";
        ::kill(process, SIGKILL);
        int status = 0;
        if (hangs) {
            ::waitpid(*tracker, nullptr, __WALL); // the tracer receives each thread's end first
        }
        ::waitpid(process, &status, 0);
        return hangs ? std::optional(WIFEXITED(status) ? WEXITSTATUS(status) : -1) : std::nullopt;
    }
};

TEST_F(RecordCommand, WritesTheTrackersPosesAsAPoseFile) {
    settings("kind = \"simulated\"\n");
    ASSERT_EQ(run("frustumscreen record --config kiosk.toml --seconds 0.3 -o poses.csv"), 0)
        << text("err.txt");
    EXPECT_GT(poses("poses.csv").size(), 20U);
    EXPECT_NE(text("out.txt").find("poses.csv: "), std::string::npos);
}

TEST_F(RecordCommand, ReplaysARecordingInTableCoordinates) {
    ASSERT_TRUE(write_file(folder / "fault.rec", recording()));
    settings("kind = \"replay\"\nposes = \"fault.rec\"\nreplay_speed = 10.0\n"
             "table_from_tracker = [1,0,0,0, 0,-1,0,0, 0,0,-1,0, 0.25,0,0.125,1]\n");
    ASSERT_EQ(run("frustumscreen record --config kiosk.toml --seconds 0.5 -o poses.csv"), 0)
        << text("err.txt");
    const std::vector<tracker::PoseSample> found = poses("poses.csv");
    ASSERT_EQ(found.size(), 100U);
    for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_LT(
            glm::distance(found[k].position_m, glm::dvec3(0.25 + 0.001 * static_cast<double>(k), 0, 0.125)),
            1e-12);
        EXPECT_NEAR(std::abs(found[k].rotation.x), 1.0, 1e-12);
    }
    EXPECT_NEAR(to_seconds(found.back().time - found.front().time), 0.099, 2e-6);
    EXPECT_NE(text("poses.csv").find("# table_from_tracker = [1, 0, 0, 0, 0, -1"), std::string::npos);
}

TEST_F(RecordCommand, ConvertsATruncatedRecordingUpToItsCut) {
    const Bytes whole = recording();
    const std::span<const std::byte> cut(whole.data(), whole.size() - 1);
    ASSERT_TRUE(write_file(folder / "fault.rec", cut));
    ASSERT_EQ(run("frustumscreen-poses convert fault.rec -o poses.csv"), 0) << text("err.txt");
    const std::vector<tracker::PoseSample> found = poses("poses.csv");
    ASSERT_EQ(found.size(), 99U);
    EXPECT_EQ(to_microseconds(found.front().time), 10'000);
    EXPECT_EQ(to_microseconds(found.back().time), 990'000);
    EXPECT_LT(glm::distance(found.back().position_m, glm::dvec3(0.098, 0, 0)), 1e-12);
    EXPECT_NE(text("out.txt").find("53 bytes behind a cut"), std::string::npos) << text("out.txt");
}

TEST_F(RecordCommand, NeverReplacesItsInputRecording) {
    const Bytes whole = recording();
    ASSERT_TRUE(write_file(folder / "fault.rec", whole));
    settings("kind = \"replay\"\nposes = \"fault.rec\"\n");
    for (const char* command :
         {"frustumscreen-poses convert fault.rec -o ./fault.rec",
          "frustumscreen record --config kiosk.toml --seconds 0.1 -o ./fault.rec",
          "frustumscreen record --raw --config kiosk.toml --seconds 0.1 -o ./fault.rec"}) {
        EXPECT_EQ(run(command), 1) << command;
        EXPECT_NE(text("err.txt").find("would replace the input"), std::string::npos) << text("err.txt");
        EXPECT_TRUE(read_file(folder / "fault.rec") == whole) << command;
    }
}

TEST_F(RecordCommand, RefusesToRecordATrackerWithoutPackets) {
    settings("kind = \"simulated\"\n");
    for (const std::string command :
         {"record --seconds 1 --raw -o raw", "run --headless --seconds 1 --pattern --record raw"}) {
        EXPECT_EQ(run("frustumscreen " + command + " --config kiosk.toml"), 1);
        EXPECT_TRUE(test::tells(text("err.txt"),
                                {"\"simulated\"", "\"usb\" and \"spacemouse\"", "[record.no_packets]\n"}));
    }
    EXPECT_FALSE(fs::exists(folder / "raw"));
}

TEST_F(RecordCommand, WritesAValidPacketFileWithoutADevice) {
    settings("kind = \"spacemouse\"\n");
    ASSERT_EQ(run("frustumscreen record --config kiosk.toml --seconds 0.3 --raw -o raw"), 0)
        << text("err.txt");
    const Bytes file = *read_file(folder / "raw");
    EXPECT_TRUE(tracker::is_packet_recording(file));
    EXPECT_EQ(run("frustumscreen record --config kiosk.toml --seconds 0.1 -o none.csv"), 1);
    EXPECT_NE(text("err.txt").find("no pose came"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder / "none.csv"));
}

TEST_F(RecordCommand, StopsWithoutLossWhileTheDeviceHangs) {
    settings("kind = \"usb\"\n");
    const std::optional<int> status = stopped_while_the_device_hangs({"--raw", "-o", "raw"});
    if (!status) {
        GTEST_SKIP() << "this machine allows no tracing";
    }
    EXPECT_EQ(*status, 0);
    EXPECT_NE(text("err.txt").find("did not stop in time; ended at once"), std::string::npos)
        << text("err.txt");
    EXPECT_NE(text("out.txt").find(" packets, 0 dropped"), std::string::npos);
    const Bytes file = *read_file(folder / "raw");
    Result<tracker::PacketReader> reader = tracker::PacketReader::open(file, "raw");
    ASSERT_TRUE(reader);
    std::size_t packets = 0;
    while (reader->next()) {
        ++packets;
    }
    EXPECT_EQ(reader->left(), 0U);
    EXPECT_EQ(text("out.txt").find(fmt::format("raw: {} packets", packets)), 0U) << text("out.txt");

    EXPECT_EQ(stopped_while_the_device_hangs({"-o", "none.csv"}), 1); // and prints the reason
    EXPECT_NE(text("err.txt").find("no pose came"), std::string::npos) << text("err.txt");
}

} // namespace
} // namespace frustumscreen::programs

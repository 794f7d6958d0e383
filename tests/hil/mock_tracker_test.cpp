/// The exhibit's tracker driver against the mocked trackers, as bytes over a socket: its samples were sent, each
/// misbehaviour is named, and it recovers. Waits for events, not for times.

#include "firmware_host/base/time.h"
#include "firmware_host/tracker/pose_file.h"
#include "firmware_host/tracker/usb_tracker_driver.h"
#include "tests/base/temporary_folder.h"
#include "tests/hil/mock_process.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <thread>

namespace frustumscreen::tests {
namespace {

struct Device {
    std::string name; ///< on the mock's command line
    tracker::UsbTrackerModel model = tracker::UsbTrackerModel::Viper;
    double position_tolerance_m = 1e-6;
    double rotation_tolerance = 1e-6;
};
const std::vector<Device> devices{
    {"viper", tracker::UsbTrackerModel::Viper},
    {"patriot", tracker::UsbTrackerModel::Patriot},
    {"liberty-hs", tracker::UsbTrackerModel::Liberty},
    {"hid", tracker::UsbTrackerModel::Hid, 1e-5},
};

constexpr int rows = 3600;
constexpr double rows_per_metre = 8192.0;

/// The pose of a row; each row and station has a different one.
tracker::PoseSample row_pose(int row, int station) {
    tracker::PoseSample pose;
    pose.time = from_microseconds(row * 1'000'000LL / 240);
    pose.station = station;
    pose.position_m = {row / rows_per_metre - 0.5, row % 64 / 64.0, 0.25 * station};
    pose.rotation = glm::angleAxis(0.01 * row + station, glm::normalize(glm::dvec3(1.0, -2.0, 0.5)));
    return pose;
}

/// The mock, which plays rows, and the driver connected to it; every sample, converted to the table's frame, is
/// compared with its row.
class Bench {
public:
    explicit Bench(const Device& device, const std::vector<std::string>& more = {},
                   const glm::dmat4& table_from_tracker = glm::dmat4(1.0))
        : device_(device), table_from_tracker_(table_from_tracker),
          mock_(arguments(more), (folder_.path() / "control").string()),
          driver_(make_socket_bus((folder_.path() / "tracker").string(), device.model), {}, monotonic_now) {}

    void tell(const std::string& command) {
        SCOPED_TRACE(command);
        EXPECT_NE(mock_.tell(command).find("\"ok\": true"), std::string::npos);
    }
    /// Steps until `holds` returns true; returns false after two minutes.
    bool until(const std::function<bool()>& holds) {
        const MonotonicTime end = monotonic_now() + std::chrono::minutes(2);
        while (!holds()) {
            if (monotonic_now() > end) {
                return false;
            }
            step();
        }
        return true;
    }
    bool until_state(tracker::UsbTrackerState state) {
        return until([&] { return driver_.state() == state; });
    }
    /// Waits until the driver streams and new poses of both stations have come.
    bool until_streaming() {
        const std::map<int, int> before = good_;
        return until([&] {
            return driver_.state() == tracker::UsbTrackerState::Streaming &&
                   good_[tracker::prop_station] > before_of(before, 1) + 5 &&
                   good_[tracker::head_station] > before_of(before, 2) + 5;
        });
    }
    [[nodiscard]] tracker::TrackerCounts counts() const { return driver_.counts(); }
    [[nodiscard]] const std::vector<tracker::PoseSample>& samples() const { return samples_; }

    /// Checks that the mock's log has each good sample as a whole row. The mock still writes, so an incomplete last row
    /// is ignored.
    void check_against_log() const {
        std::string log = text_of((folder_.path() / "log").string());
        log.resize(log.rfind('\n') + 1);
        const auto sent = tracker::parse_poses(log, "log");
        ASSERT_TRUE(sent) << sent.error().message;
        std::map<std::pair<int, int>, bool> rows_sent;
        for (const tracker::PoseSample& pose : *sent) {
            rows_sent[{pose.station, row_of(pose)}] = true;
        }
        for (const tracker::PoseSample& sample : samples_) {
            EXPECT_TRUE(!sample.ok || rows_sent.contains({sample.station, row_of(sample)}));
        }
    }

private:
    static int before_of(const std::map<int, int>& counts, int station) {
        const auto found = counts.find(station);
        return found == counts.end() ? 0 : found->second;
    }
    static int row_of(const tracker::PoseSample& pose) {
        return static_cast<int>(std::lround((pose.position_m.x + 0.5) * rows_per_metre));
    }
    std::vector<std::string> arguments(const std::vector<std::string>& more) const {
        std::vector<tracker::PoseSample> poses;
        for (int row = 0; row < rows; ++row) {
            poses.push_back(row_pose(row, tracker::prop_station));
            poses.push_back(row_pose(row, tracker::head_station));
        }
        std::ofstream((folder_.path() / "poses.csv").string()) << tracker::write_poses(poses);
        std::vector<std::string> all{"--device",
                                     device_.name,
                                     "--socket",
                                     (folder_.path() / "tracker").string(),
                                     "--poses",
                                     (folder_.path() / "poses.csv").string(),
                                     "--loop",
                                     "--log",
                                     (folder_.path() / "log").string()};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    void step() {
        const std::size_t before = samples_.size();
        const Nanoseconds rest = driver_.step(samples_);
        for (std::size_t k = before; k < samples_.size(); ++k) {
            check(samples_[k]);
        }
        if (rest > Nanoseconds::zero()) {
            std::this_thread::sleep_for(rest);
        }
    }
    void check(tracker::PoseSample& sample) {
        MonotonicTime& last = last_time_[sample.station];
        EXPECT_LE(last, sample.time);
        last = sample.time;
        if (!sample.ok) {
            return;
        }
        ++good_[sample.station];
        sample.position_m = glm::dvec3(table_from_tracker_ * glm::dvec4(sample.position_m, 1.0));
        sample.rotation = glm::quat_cast(table_from_tracker_) * sample.rotation;
        const tracker::PoseSample expected = row_pose(row_of(sample), sample.station);
        EXPECT_LT(glm::distance(sample.position_m, expected.position_m), device_.position_tolerance_m);
        EXPECT_GT(std::abs(glm::dot(sample.rotation, expected.rotation)), 1.0 - device_.rotation_tolerance);
    }

    Device device_;
    glm::dmat4 table_from_tracker_;
    TemporaryFolder folder_;
    MockProcess mock_;
    tracker::UsbTrackerDriver driver_;
    std::vector<tracker::PoseSample> samples_;
    std::map<int, int> good_; ///< samples by station
    std::map<int, MonotonicTime> last_time_;
};

/// Runs each device in a thread and a bench of its own, since most of the time is waiting.
void with_each(const std::vector<Device>& which, const std::function<void(const Device&)>& test) {
    std::vector<std::jthread> threads;
    threads.reserve(which.size());
    for (const Device& device : which) {
        threads.emplace_back([&] {
            SCOPED_TRACE(device.name);
            test(device);
        });
    }
}

TEST(MockTracker, DeliversPosesExactlyAndInOrder) {
    with_each(devices, [](const Device& device) {
        Bench bench(device);
        ASSERT_TRUE(bench.until_streaming());
        ASSERT_TRUE(bench.until([&] { return bench.samples().size() > 200; }));
        EXPECT_EQ(bench.counts().broken + bench.counts().duplicated + bench.counts().reordered, 0U);
        bench.check_against_log();
    });
}

TEST(MockTracker, ReportsPosesInTheTrackersFrame) {
    with_each(devices, [](const Device& device) {
        // A third of a turn about (1, 1, 1): X to Y, Y to Z, Z to X.
        const glm::dmat4 table_from_tracker{{0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}, {0.5, -0.25, 0.125, 1}};
        const std::string numbers = "[0, 1, 0, 0,  0, 0, 1, 0,  1, 0, 0, 0,  0.5, -0.25, 0.125, 1]";
        Bench bench(device, {"--table-from-tracker", numbers}, table_from_tracker);
        ASSERT_TRUE(bench.until_streaming());
        bench.check_against_log();
    });
}

TEST(MockTracker, CountsLostBrokenDoubledAndLateFrames) {
    with_each(devices, [](const Device& device) {
        Bench bench(device);
        ASSERT_TRUE(bench.until_streaming());
        using Count = std::uint64_t tracker::TrackerCounts::*;
        const std::vector<std::pair<std::string, Count>> faults{
            {"drop", &tracker::TrackerCounts::lost},
            {"corrupt", &tracker::TrackerCounts::broken},
            {"duplicate", &tracker::TrackerCounts::duplicated},
            {"reorder", &tracker::TrackerCounts::reordered}};
        for (const auto& [fault, count] : faults) {
            SCOPED_TRACE(fault);
            const std::uint64_t before = bench.counts().*count;
            bench.tell(fault + " 0.3");
            EXPECT_TRUE(bench.until([&, &c = count] { return bench.counts().*c > before + 5; }));
            bench.tell(fault + " off");
            EXPECT_TRUE(bench.until_streaming());
        }
        bench.check_against_log();
    });
}

TEST(MockTracker, ReportsFaultsAndRecovers) {
    with_each(devices, [](const Device& device) {
        const bool says_that_it_boots =
            device.model == tracker::UsbTrackerModel::Viper || device.model == tracker::UsbTrackerModel::Hid;
        const std::vector<std::pair<std::string, tracker::UsbTrackerState>> faults{
            {"stall", tracker::UsbTrackerState::Silent},
            {"hang", tracker::UsbTrackerState::Silent},
            {"unplug", tracker::UsbTrackerState::NotConnected},
            // A PATRIOT has no checksum, so this frame counts as a broken one.
            {"nan",
             says_that_it_boots ? tracker::UsbTrackerState::PosesUnusable : tracker::UsbTrackerState::Silent},
            {"sensor-missing", tracker::UsbTrackerState::SensorMissing},
            {"distortion 200", tracker::UsbTrackerState::MetalNear},
            {"wrong-units", tracker::UsbTrackerState::WrongUnits},
            {"slow-boot",
             says_that_it_boots ? tracker::UsbTrackerState::Booting : tracker::UsbTrackerState::SetUpRefused},
        };
        Bench bench(device);
        ASSERT_TRUE(bench.until_streaming());
        for (const auto& [fault, state] : faults) {
            SCOPED_TRACE(fault);
            bench.tell(fault);
            EXPECT_TRUE(bench.until_state(state));
            bench.tell(fault.substr(0, fault.find(' ')) + " off");
            EXPECT_TRUE(bench.until_streaming());
        }
        bench.check_against_log();
    });
}

TEST(MockTracker, RetriesARejectedSetUp) {
    with_each(devices, [](const Device& device) {
        Bench bench(device, {"--at", "0s nak"});
        EXPECT_TRUE(bench.until_state(tracker::UsbTrackerState::SetUpRefused));
        bench.tell("nak off");
        EXPECT_TRUE(bench.until_streaming());
    });
}

/// A fault of one kind of device, and the state that must be reported.
struct Said {
    const Device& device;
    std::string fault;
    tracker::UsbTrackerState state;
};

void with_each(const std::vector<Said>& which, const std::function<void(const Said&)>& test) {
    std::vector<std::jthread> threads;
    threads.reserve(which.size());
    for (const Said& said : which) {
        threads.emplace_back([&] {
            SCOPED_TRACE(said.device.name + " " + said.fault);
            test(said);
        });
    }
}

TEST(MockTracker, WarnsAboutAViperWithAnotherSetUp) {
    const Device& viper = devices[0];
    with_each({{viper, "filter-stays", tracker::UsbTrackerState::FilterStaysOn},
               {viper, "warn", tracker::UsbTrackerState::SetUpDoubtful},
               {viper, "nak-questions", tracker::UsbTrackerState::SetUpDoubtful}},
              [](const Said& said) {
                  Bench bench(said.device, {"--at", "0s " + said.fault});
                  EXPECT_TRUE(bench.until_state(said.state));
                  EXPECT_TRUE(bench.until([&] { return bench.samples().size() > 20; }));
                  bench.tell(said.fault + " off");
                  bench.tell("unplug 300ms");
                  EXPECT_TRUE(bench.until_streaming());
                  bench.check_against_log();
              });
}

TEST(MockTracker, ReportsAWrongRateAStoppedClockAndAnInternalFault) {
    const Device& viper = devices[0];
    const Device& patriot = devices[1];
    const Device& hid = devices[3];
    with_each({{viper, "rate 30", tracker::UsbTrackerState::PosesLate},
               {viper, "rate 8000", tracker::UsbTrackerState::PosesLate},
               {viper, "built-in-test", tracker::UsbTrackerState::DeviceFault},
               {patriot, "clock-stands", tracker::UsbTrackerState::PosesLate},
               {hid, "clock-stands", tracker::UsbTrackerState::PosesLate},
               {hid, "built-in-test", tracker::UsbTrackerState::DeviceFault}},
              [](const Said& said) {
                  Bench bench(said.device);
                  ASSERT_TRUE(bench.until_streaming());
                  bench.tell(said.fault);
                  EXPECT_TRUE(bench.until_state(said.state));
                  bench.tell(said.fault.substr(0, said.fault.find(' ')) + " off");
                  EXPECT_TRUE(bench.until_streaming());
                  bench.check_against_log();
              });
}

TEST(MockTracker, SurvivesStormsWithoutInventingPoses) {
    with_each(devices, [](const Device& device) {
        Bench bench(device);
        ASSERT_TRUE(bench.until_streaming());
        bench.tell("replug 33 3s"); // about a hundred replugs
        EXPECT_TRUE(bench.until_state(tracker::UsbTrackerState::NotConnected));
        EXPECT_TRUE(bench.until_streaming());
        using Count = std::uint64_t tracker::TrackerCounts::*;
        const std::vector<std::pair<std::string, Count>> storms{
            {"burst 64", &tracker::TrackerCounts::duplicated},
            {"false-preambles", &tracker::TrackerCounts::broken}};
        for (const auto& [storm, count] : storms) {
            SCOPED_TRACE(storm);
            const std::uint64_t before = bench.counts().*count;
            bench.tell(storm);
            EXPECT_TRUE(bench.until([&, &c = count] { return bench.counts().*c > before + 20; }));
            EXPECT_TRUE(bench.until_streaming()); // in the meantime
            bench.tell(storm.substr(0, storm.find(' ')) + " off");
            EXPECT_TRUE(bench.until_streaming());
        }
        bench.check_against_log();
    });
}

TEST(MockTracker, NeverReportsPositionsThatAreNotNumbers) {
    with_each(devices, [](const Device& device) {
        Bench bench(device);
        ASSERT_TRUE(bench.until_streaming());
        const tracker::TrackerCounts before = bench.counts();
        bench.tell("nan");
        EXPECT_TRUE(bench.until([&] {
            return bench.counts().unusable > before.unusable + 5 || bench.counts().broken > before.broken + 5;
        }));
        bench.tell("good");
        EXPECT_TRUE(bench.until_streaming());
        bench.check_against_log();
    });
}

} // namespace
} // namespace frustumscreen::tests

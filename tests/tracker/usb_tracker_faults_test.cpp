// Faults that a tracker reports, wrong rates, and failures while another tracker is waiting.

#include "tests/tracker/driver_bench.h"

#include <algorithm>

namespace frustumscreen::tracker {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(UsbTrackerFaults, ReportsWarningsAndRefusalsInSetUpAndStillStreams) {
    for (const FakeAnswers manner :
         {FakeAnswers::WarnsOfSettings, FakeAnswers::WarnsOfQuestions, FakeAnswers::RefusesQuestions}) {
        Bench bench(UsbTrackerModel::Viper);
        bench.device.manner = manner;
        ASSERT_TRUE(bench.until_streaming(seconds(2)));
        bench.run(seconds(1));
        EXPECT_EQ(bench.state(), UsbTrackerState::SetUpDoubtful);
        EXPECT_GT(bench.samples.size(), 200U);
    }
}

TEST(UsbTrackerFaults, ReportsASystemFaultAndKeepsThePoses) {
    Bench bench(UsbTrackerModel::Viper);
    ASSERT_TRUE(bench.until_streaming(seconds(2)));
    bench.device.fault = 3;
    bench.run(seconds(1));
    EXPECT_EQ(bench.state(), UsbTrackerState::DeviceFault);
    EXPECT_TRUE(bench.samples.back().ok);
    EXPECT_EQ(bench.counts().unusable, 0U);
    bench.device.fault = 0;
    bench.run(seconds(1));
    EXPECT_EQ(bench.state(), UsbTrackerState::Streaming);
}

TEST(UsbTrackerFaults, ReportsAFaultOfAHidTracker) {
    Bench bench(UsbTrackerModel::Hid);
    ASSERT_TRUE(bench.until_streaming(seconds(2)));
    bench.device.fault = 1;
    bench.run(seconds(1));
    EXPECT_EQ(bench.state(), UsbTrackerState::DeviceFault);
    EXPECT_FALSE(bench.samples.back().ok); // reported with each pose here
}

TEST(UsbTrackerFaults, ReportsAFailedSelfTestInSetUp) {
    Bench bench(UsbTrackerModel::Viper);
    bench.device.manner = FakeAnswers::FailsItsTest;
    bench.run(seconds(10));
    EXPECT_EQ(bench.state(), UsbTrackerState::DeviceFault);
    bench.device.manner = FakeAnswers::Plain;
    EXPECT_TRUE(bench.until_streaming(seconds(2)));
}

/// The greatest age of a pose on arrival, over this time.
Nanoseconds oldest_over(Bench& bench, Nanoseconds length) {
    const MonotonicTime end = bench.device.now + length;
    Nanoseconds oldest{0};
    while (bench.device.now < end) {
        const std::size_t before = bench.samples.size();
        bench.run(Nanoseconds(1));
        if (bench.samples.size() > before) {
            oldest = std::max(oldest, bench.device.now - bench.samples.back().time);
        }
    }
    return oldest;
}

TEST(UsbTrackerFaults, ReportsASlowDeviceAndKeepsPosesFresh) {
    for (const UsbTrackerModel model : models) {
        for (const double slower : {1.06, 1.5, 4.0, 30.0}) {
            Bench bench(model);
            bench.device.slower = slower;
            ASSERT_TRUE(bench.until_streaming(seconds(3)));
            bench.run(seconds(20)); // the rate error of 6 % shows after a few seconds
            EXPECT_EQ(bench.state(), UsbTrackerState::PosesLate) << slower;
            EXPECT_LT(oldest_over(bench, seconds(10)), milliseconds(5)) << slower;
            bench.device.slower = 1.0;
            bench.run(seconds(15));
            EXPECT_EQ(bench.state(), UsbTrackerState::Streaming) << slower;
        }
    }
}

TEST(UsbTrackerFaults, ReportsLatePosesWithinASecond) {
    for (const UsbTrackerModel model : models) {
        Bench bench(model);
        bench.device.slower = 4.0;
        ASSERT_TRUE(bench.until_streaming(seconds(2)));
        EXPECT_LT(oldest_over(bench, seconds(1)), seconds(1));
        EXPECT_EQ(bench.state(), UsbTrackerState::PosesLate);
    }
}

TEST(UsbTrackerFaults, ReportsAStoppedClockAndKeepsPosesFresh) {
    for (const UsbTrackerModel model : {UsbTrackerModel::Patriot, UsbTrackerModel::Hid}) {
        Bench bench(model);
        ASSERT_TRUE(bench.until_streaming(seconds(2)));
        bench.run(seconds(10));
        bench.device.clock_stands = true;
        bench.run(seconds(5));
        EXPECT_EQ(bench.state(), UsbTrackerState::PosesLate);
        EXPECT_LT(oldest_over(bench, seconds(5)), milliseconds(5));
        EXPECT_LT(bench.counts().clock_restarts, 5U);
        bench.device.clock_stands = false;
        bench.run(seconds(15));
        EXPECT_EQ(bench.state(), UsbTrackerState::Streaming);
    }
}

TEST(UsbTrackerFaults, OneHertzDeviceIsNotStaleBetweenSamples) {
    for (const UsbTrackerModel model : models) {
        Bench bench(model);
        const std::uint32_t every = model == UsbTrackerModel::Patriot ? 60 : 120;
        bench.device.mischief = [&](wire::Wire frame) {
            return bench.device.counter % every == 0 ? std::vector<wire::Wire>{std::move(frame)}
                                                     : std::vector<wire::Wire>{};
        };
        ASSERT_TRUE(bench.until_streaming(seconds(4)));
        bench.run(milliseconds(1500)); // its second sample
        const std::size_t before = bench.samples.size();
        for (const MonotonicTime end = bench.device.now + seconds(20); bench.device.now < end;) {
            bench.run(milliseconds(10));
            ASSERT_EQ(bench.state(), UsbTrackerState::Streaming);
        }
        EXPECT_NEAR(static_cast<double>(bench.samples.size() - before), 2 * 20, 2.0);
    }
}

TEST(UsbTrackerFaults, CountsAccumulateOverConnections) {
    for (const UsbTrackerModel model : models) {
        Bench bench(model);
        for (int round = 0; round < 3; ++round) {
            ASSERT_TRUE(bench.until_streaming(seconds(2)));
            bench.device.counter += 10;
            bench.run(seconds(1));
            bench.device.plugged = false;
            bench.device.restart();
            bench.run(seconds(1));
            bench.device.plugged = true;
        }
        EXPECT_EQ(bench.counts().connections, 3U);
        const std::uint64_t sensors = model == UsbTrackerModel::Viper ? 2 : 1; // per frame
        EXPECT_EQ(sensors * bench.counts().frames, bench.samples.size());
        EXPECT_GE(bench.counts().lost, 3 * 2 * 10U);
    }
}

/// Several trackers on one clock, each with its own place.
class CrowdedBus final : public UsbBus {
public:
    explicit CrowdedBus(std::vector<FakeUsbTracker>& devices) : devices_(devices) {}
    [[nodiscard]] tl::expected<FoundTracker, UsbTrackerState>
    find(std::span<const std::string> but_not) override {
        for (std::size_t k = 0; k < devices_.size(); ++k) {
            FakeUsbTracker& device = devices_[k];
            const std::string place = std::to_string(k);
            if (device.plugged && std::ranges::find(but_not, place) == but_not.end()) {
                opened.push_back(k);
                return FoundTracker{std::make_unique<FakeTransport>(device), device.model, place};
            }
        }
        return tl::unexpected(UsbTrackerState::NotConnected);
    }
    std::vector<std::size_t> opened;

private:
    std::vector<FakeUsbTracker>& devices_;
};

class Crowd {
public:
    explicit Crowd(std::size_t count) : devices(count), driver_(make_bus(), {}, [this] { return now(); }) {}

    /// Runs until one streams; returns the number of devices that were opened meanwhile.
    std::optional<std::size_t> until_streaming() {
        const std::size_t before = bus_->opened.size();
        const MonotonicTime end = now() + seconds(60);
        while (!is_streaming(driver_.state()) && now() < end) {
            step();
        }
        return is_streaming(driver_.state()) ? std::optional(bus_->opened.size() - before) : std::nullopt;
    }
    void run(Nanoseconds length) {
        for (const MonotonicTime end = now() + length; now() < end;) {
            step();
        }
    }
    [[nodiscard]] std::size_t open_device() const { return bus_->opened.back(); }

    std::vector<FakeUsbTracker> devices;

private:
    std::unique_ptr<UsbBus> make_bus() {
        auto bus = std::make_unique<CrowdedBus>(devices);
        bus_ = bus.get();
        return bus;
    }
    [[nodiscard]] MonotonicTime now() const {
        MonotonicTime latest{};
        for (const FakeUsbTracker& device : devices) {
            latest = std::max(latest, device.now);
        }
        return latest;
    }
    void step() {
        const Nanoseconds rest = driver_.step(samples_);
        const MonotonicTime after = now() + rest;
        for (FakeUsbTracker& device : devices) {
            device.now = after;
        }
    }
    CrowdedBus* bus_ = nullptr;
    UsbTrackerDriver driver_;
    std::vector<PoseSample> samples_;
};

TEST(UsbTrackerFaults, UsesTheSecondTrackerWhenTheFirstIsDead) {
    const std::vector<std::function<void(FakeUsbTracker&)>> ways_to_be_dead{
        [](FakeUsbTracker& device) { device.deaf = true; },
        [](FakeUsbTracker& device) { device.mute = true; },
        [](FakeUsbTracker& device) { device.keeps_inches = true; },
    };
    for (const auto& kill : ways_to_be_dead) {
        Crowd crowd(2);
        kill(crowd.devices[0]);
        const std::optional<std::size_t> opened = crowd.until_streaming();
        ASSERT_TRUE(opened);
        EXPECT_EQ(*opened, 2U);
        EXPECT_EQ(crowd.open_device(), 1U);
        crowd.run(seconds(10));
        EXPECT_EQ(crowd.open_device(), 1U); // and it stays open
        FakeUsbTracker& first = crowd.devices[0];
        first.deaf = first.mute = first.keeps_inches = false;
        crowd.devices[1].plugged = false;
        crowd.run(seconds(1));
        ASSERT_TRUE(crowd.until_streaming());
        EXPECT_EQ(crowd.open_device(), 0U); // working again, and used
    }
}

TEST(UsbTrackerFaults, TriesEveryTrackerBeforeRetryingOne) {
    for (const std::size_t count : {2U, 3U, 5U}) {
        Crowd crowd(count);
        for (std::size_t k = 0; k + 1 < count; ++k) {
            crowd.devices[k].deaf = true;
        }
        EXPECT_EQ(crowd.until_streaming(), std::optional(count)) << count;
        EXPECT_EQ(crowd.open_device(), count - 1);
    }
}

} // namespace
} // namespace frustumscreen::tracker

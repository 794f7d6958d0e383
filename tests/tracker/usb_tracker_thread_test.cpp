#include "firmware_host/tracker/usb_tracker.h"
#include "tests/tracker/wire_bytes.h"

#include <gtest/gtest.h>

#include <random>

namespace frustumscreen::tracker {
namespace {

/// A device on the machine's real clock that appears and disappears; lives on the tracker's thread alone.
class RestlessTransport final : public UsbTransport {
public:
    RestlessTransport(std::uint32_t seed, std::uint32_t& counter) : engine_(seed), counter_(counter) {}

    [[nodiscard]] Result<std::size_t> read(std::span<std::byte> buffer, Nanoseconds) override {
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        if (engine_() % 2000 == 0) {
            return fail(ErrorKind::DeviceLost, "test.device", "unplugged");
        }
        wire::Wire bytes = std::exchange(reply_, {});
        if (bytes.empty() && streaming_) {
            bytes = wire::viper_frame(++counter_, {wire::Pose{}, wire::Pose{2}});
        }
        std::copy(bytes.begin(), bytes.end(), buffer.begin());
        return bytes.size();
    }
    [[nodiscard]] Result<void> write(std::span<const std::byte> bytes, Nanoseconds) override {
        const auto command = static_cast<std::uint32_t>(bytes[12]);
        const auto action = static_cast<std::uint32_t>(bytes[16]);
        if (action == 0) {
            set_.assign(bytes.begin() + 28, bytes.end() - 4);
        }
        streaming_ = command == 19 && action == 0;
        reply_ = wire::viper_reply(command, 3, action == 1 ? set_ : wire::Wire{});
        return {};
    }
    void close() override {}

private:
    std::mt19937 engine_;
    std::uint32_t& counter_;
    wire::Wire set_;
    wire::Wire reply_;
    bool streaming_ = false;
};

class RestlessBus final : public UsbBus {
public:
    explicit RestlessBus(std::atomic<int>& found) : found_(found) {}
    [[nodiscard]] tl::expected<FoundTracker, UsbTrackerState>
    find(std::span<const std::string> /*but_not*/) override {
        if (++searches_ % 3 == 2) {
            return tl::unexpected(UsbTrackerState::NotConnected);
        }
        ++found_;
        return FoundTracker{
            std::make_unique<RestlessTransport>(searches_, counter_), UsbTrackerModel::Viper, {}};
    }

private:
    std::atomic<int>& found_;
    std::uint32_t searches_ = 0;
    std::uint32_t counter_ = 0;
};

/// A search that ends when the test lets it.
struct LongSearch {
    std::atomic<bool> begun{false};
    std::atomic<bool> may_end{false};
};
class SlowBus final : public UsbBus {
public:
    explicit SlowBus(LongSearch& search) : search_(search) {}
    [[nodiscard]] tl::expected<FoundTracker, UsbTrackerState>
    find(std::span<const std::string> /*but_not*/) override {
        search_.begun = true;
        search_.begun.notify_all();
        search_.may_end.wait(false);
        return tl::unexpected(UsbTrackerState::NoPermission);
    }

private:
    LongSearch& search_;
};

TEST(UsbTracker, PollsAcrossReconnections) {
    std::atomic<int> found{0};
    UsbTracker tracker(std::make_unique<RestlessBus>(found), {});
    EXPECT_FALSE(tracker.reports_table_frame());
    std::vector<PoseSample> samples;
    MonotonicTime last{};
    int followed = 0; // number of connections from which poses came
    int heard = 0;
    TrackerCounts counts;
    while (followed < 3) {
        samples.clear();
        const MonotonicTime now = monotonic_now();
        const int finds = found;
        EXPECT_TRUE(tracker.poll(now, samples));
        EXPECT_FALSE(tracker.state().empty());
        EXPECT_GE(tracker.counts().frames, counts.frames);
        counts = tracker.counts();
        for (const PoseSample& sample : samples) {
            EXPECT_GE(sample.time, last);
            EXPECT_LE(sample.time, now);
            EXPECT_EQ(sample.position_m, glm::dvec3(0.25, -0.5, 1.0));
            last = sample.time;
        }
        if (!samples.empty() && finds > std::exchange(heard, finds)) {
            ++followed;
        }
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    EXPECT_GE(counts.connections, 2U);
    EXPECT_GT(counts.frames, 0U);
}

TEST(UsbTracker, SlowDeviceCallBlocksNoPoll) {
    LongSearch search;
    UsbTracker tracker(std::make_unique<SlowBus>(search), {});
    std::vector<PoseSample> samples;
    search.begun.wait(false);
    for (int k = 0; k < 2; ++k) { // a poll that waited for the search would never return
        EXPECT_TRUE(tracker.poll(monotonic_now(), samples));
    }
    search.may_end = true;
    search.may_end.notify_all();
    EXPECT_TRUE(samples.empty());
}

} // namespace
} // namespace frustumscreen::tracker

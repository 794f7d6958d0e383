#include "firmware_host/tracker/usb_ids.h"
#include "tests/tracker/driver_bench.h"

#include <algorithm>
#include <limits>
#include <random>

namespace frustumscreen::tracker {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(UsbTrackerDriver, SetsUpAndReturnsTheSentPoses) {
    for (const UsbTrackerModel model : models) {
        Bench bench(model);
        ASSERT_TRUE(bench.until_streaming(seconds(2)));
        bench.run(seconds(5));
        EXPECT_EQ(bench.state(), UsbTrackerState::Streaming);
        const double rate = model == UsbTrackerModel::Patriot ? 60.0 : 120.0;
        EXPECT_NEAR(static_cast<double>(bench.samples.size()), 2 * 5 * rate, 6.0);
        EXPECT_LT(bench.device.now - bench.samples.back().time, milliseconds(18));
        EXPECT_EQ(bench.counts().lost + bench.counts().duplicated + bench.counts().reordered, 0U);
        EXPECT_EQ(bench.counts().broken + bench.counts().unusable + bench.counts().implausible, 0U);
        EXPECT_LT(glm::distance(bench.samples.back().rotation * glm::dvec3(1, 0, 0),
                                glm::dquat(0.5, 0.5, -0.5, 0.5) * glm::dvec3(1, 0, 0)),
                  1e-12);
    }
}

TEST(UsbTrackerDriver, ViperStreamsOnlyAfterEverySettingIsReadBack) {
    Bench bench(UsbTrackerModel::Viper);
    ASSERT_TRUE(bench.until_streaming(seconds(2)));
    constexpr std::uint32_t set = 0;
    constexpr std::uint32_t get = 1;
    const std::vector<std::uint32_t> expected{19 * 16 + 2,  20 * 16 + get, 7 * 16 + set, 7 * 16 + get,
                                              0 * 16 + set, 0 * 16 + get,  1 * 16 + set, 1 * 16 + get,
                                              1 * 16 + get, 6 * 16 + set,  6 * 16 + get, 19 * 16 + set};
    EXPECT_EQ(bench.device.commands, expected);
    EXPECT_EQ(bench.device.settings[7], wire::from_hex("03000000 02000000"));
    EXPECT_EQ(bench.device.settings[0], wire::from_hex("00000000 0000803F 00000000 00000000"));
    EXPECT_EQ(bench.device.settings[1], wire::Wire(20)); // level 0 means no filter
    EXPECT_EQ(bench.device.settings[6], wire::from_hex("02000000"));
}

TEST(UsbTrackerDriver, SendsAllSettingsToAPatriotBeforeStreaming) {
    Bench bench(UsbTrackerModel::Patriot);
    ASSERT_TRUE(bench.until_streaming(seconds(2)));
    EXPECT_EQ(bench.device.text, "PF0\r\x16\rU1\rU\rH*,1.0000,0.0000,0.0000\rX0,1,0,0\rY0,1,0,0\r"
                                 "O*,8,9,11,3,7\r@B0\rF1\rC\r");
}

TEST(UsbTrackerDriver, SetsUpADeviceThatAlreadyStreams) {
    for (const UsbTrackerModel model : models) {
        Bench bench(model);
        bench.device.streaming = true;
        bench.device.position_units = model == UsbTrackerModel::Viper ? 0 : 3;
        const auto good = [&](wire::Wire frame) { // inches until the units are set
            bench.device.position_units = bench.device.settings[7].empty() ? 0 : 3;
            return std::vector<wire::Wire>{std::move(frame)};
        };
        if (model == UsbTrackerModel::Viper) {
            bench.device.mischief = good;
        }
        EXPECT_TRUE(bench.until_streaming(seconds(2)));
    }
}

TEST(UsbTrackerDriver, ADeviceThatKeepsInchesNeverStreams) {
    for (const UsbTrackerModel model : models) {
        Bench bench(model);
        bench.device.keeps_inches = true;
        bench.run(seconds(10));
        EXPECT_TRUE(bench.samples.empty());
        EXPECT_EQ(bench.state(), UsbTrackerState::WrongUnits);
        bench.device.keeps_inches = false;
        EXPECT_TRUE(bench.until_streaming(seconds(2)));
    }
}

TEST(UsbTrackerDriver, ResetsUnitsThatChangeAndDiscardsTheirPoses) {
    Bench bench(UsbTrackerModel::Viper);
    ASSERT_TRUE(bench.until_streaming(seconds(2)));
    bench.device.commands.clear();
    bench.device.position_units = 2;
    bench.run(milliseconds(100));
    const std::size_t before = bench.samples.size();
    bench.run(seconds(1));
    EXPECT_EQ(bench.samples.size(), before);
    EXPECT_FALSE(is_streaming(bench.state()));
    EXPECT_FALSE(bench.device.commands.empty());
    bench.device.position_units = 3;
    EXPECT_TRUE(bench.until_streaming(seconds(2)));
}

TEST(UsbTrackerDriver, WaitsForABootingDeviceAndReportsIt) {
    for (const UsbTrackerModel model : {UsbTrackerModel::Viper, UsbTrackerModel::Hid}) {
        Bench bench(model);
        bench.device.boots_until = bench.device.now + seconds(8);
        bench.run(milliseconds(7900));
        EXPECT_EQ(bench.state(), UsbTrackerState::Booting);
        EXPECT_TRUE(bench.until_streaming(seconds(2)));
    }
}

TEST(UsbTrackerDriver, RetriesADeviceUntilItAnswers) {
    for (const UsbTrackerModel model : models) {
        Bench bench(model);
        bench.device.deaf = true;
        bench.run(seconds(20));
        EXPECT_EQ(bench.state(), UsbTrackerState::SetUpRefused);
        bench.device.deaf = false;
        EXPECT_TRUE(bench.until_streaming(seconds(2)));
    }
}

TEST(UsbTrackerDriver, ReportsAFilterThatStaysOnAndStillStreams) {
    for (const FakeFilter filter :
         {FakeFilter::Refuses, FakeFilter::SaysNothing, FakeFilter::StaysOn, FakeFilter::TurnStaysOn}) {
        Bench bench(UsbTrackerModel::Viper);
        bench.device.filter = filter;
        ASSERT_TRUE(bench.until_streaming(seconds(2)));
        bench.run(seconds(1));
        EXPECT_EQ(bench.state(), UsbTrackerState::FilterStaysOn);
        EXPECT_NE(sentence_of(bench.state()).find("filter"), std::string_view::npos);
        EXPECT_GT(bench.samples.size(), 200U);
        bench.device.connectors = {2}; // the worse fault is reported first
        bench.run(seconds(1));
        EXPECT_EQ(bench.state(), UsbTrackerState::SensorMissing);
        bench.device.connectors = {1, 2};
        bench.device.filter = FakeFilter::Obeys;
        bench.device.unplug_after_calls = 0;
        bench.run(seconds(1));
        bench.device.plugged = true;
        bench.run(seconds(2));
        EXPECT_EQ(bench.state(), UsbTrackerState::Streaming);
    }
}

TEST(UsbTrackerDriver, RepeatsAnUnansweredFilterQuery) {
    Bench bench(UsbTrackerModel::Viper);
    bench.device.filter = FakeFilter::SaysNothing;
    bench.run(milliseconds(800)); // one answer is overdue
    bench.device.filter = FakeFilter::Obeys;
    ASSERT_TRUE(bench.until_streaming(seconds(2)));
    bench.run(seconds(1));
    EXPECT_EQ(bench.state(), UsbTrackerState::Streaming);
}

TEST(UsbTrackerDriver, LateAnswersDelaySetUpWithoutAUnitsError) {
    for (const Nanoseconds late : {milliseconds(150), milliseconds(250), milliseconds(450)}) {
        Bench bench(UsbTrackerModel::Viper);
        bench.device.answers_after = late;
        ASSERT_TRUE(bench.until_streaming(13 * late + seconds(1))) << late.count();
        EXPECT_EQ(bench.state(), UsbTrackerState::Streaming);
    }
    Bench bench(UsbTrackerModel::Viper);
    bench.device.answers_after = milliseconds(700); // later than the driver allows
    for (int k = 0; k < 2000; ++k) {
        bench.run(milliseconds(10));
        ASSERT_NE(bench.state(), UsbTrackerState::WrongUnits);
    }
    EXPECT_EQ(bench.state(), UsbTrackerState::SetUpRefused);
}

/// The cable is unplugged at every single read and write of set-up and streaming, and plugged in three
/// seconds later.
TEST(UsbTrackerDriver, ReconnectsAfterUnpluggingAtAnyCall) {
    for (const UsbTrackerModel model : models) {
        for (int calls = 0; calls < 120; ++calls) {
            Bench bench(model);
            bench.device.unplug_after_calls = calls;
            bench.run(seconds(5));
            ASSERT_EQ(bench.state(), UsbTrackerState::NotConnected) << calls;
            bench.device.plugged = true;
            const std::optional<Nanoseconds> took = bench.until_streaming(seconds(2));
            ASSERT_TRUE(took) << calls;
            EXPECT_LT(*took, seconds(1)) << calls;
        }
    }
}

TEST(UsbTrackerDriver, ReportsASilentDeviceAndRecovers) {
    for (const UsbTrackerModel model : models) {
        for (const Nanoseconds length : {Nanoseconds(milliseconds(400)), Nanoseconds(seconds(10))}) {
            Bench bench(model);
            ASSERT_TRUE(bench.until_streaming(seconds(2)));
            bench.run(milliseconds(100)); // its rate is known
            bench.device.mute = true;
            bench.run(length);
            EXPECT_EQ(bench.state(), UsbTrackerState::Silent);
            EXPECT_TRUE(hangs(bench.state()));
            bench.device.mute = false;
            EXPECT_TRUE(bench.until_streaming(seconds(2)));
            bench.run(seconds(1));
            EXPECT_EQ(bench.state(), UsbTrackerState::Streaming);
        }
    }
}

TEST(UsbTrackerDriver, ReportsWhyADeviceCannotBeUsed) {
    const std::vector<std::pair<UsbTrackerState, std::string>> cases{
        {UsbTrackerState::NotConnected, "no tracker is connected"},
        {UsbTrackerState::NoPermission, "may not open it"},
        {UsbTrackerState::FirmwareNotLoaded, "firmware is not loaded"},
        {UsbTrackerState::InUse, "another program"},
    };
    for (const auto& [state, words] : cases) {
        Bench bench(UsbTrackerModel::Viper);
        bench.device.plugged = false;
        bench.device.in_the_way = state;
        bench.run(seconds(1));
        EXPECT_EQ(bench.state(), state);
        EXPECT_NE(sentence_of(bench.state()).find(words), std::string_view::npos);
    }
}

TEST(UsbTrackerDriver, KnowsTheDevicesByTheirIds) {
    EXPECT_EQ(known_tracker(0x0f44, 0xbf01)->model, UsbTrackerModel::Viper);
    EXPECT_TRUE(known_tracker(0x0f44, 0xef12)->firmware_loaded);
    EXPECT_FALSE(known_tracker(0x0f44, 0xef11)->firmware_loaded);
    EXPECT_EQ(known_tracker(0x0f44, 0xff20)->model, UsbTrackerModel::Liberty);
    EXPECT_FALSE(known_tracker(0x0f44, 0x0001));
    EXPECT_FALSE(known_tracker(0x10c4, 0xbf01));
}

TEST(UsbTrackerDriver, ReportsMetalAndAMissingSensor) {
    for (const UsbTrackerModel model : models) {
        Bench bench(model);
        ASSERT_TRUE(bench.until_streaming(seconds(2)));
        bench.device.distortion = 200;
        bench.run(seconds(1));
        EXPECT_EQ(bench.state(), UsbTrackerState::MetalNear);
        EXPECT_FALSE(hangs(bench.state()));
        EXPECT_EQ(health_of(bench.state()), TrackerHealth::MetalNear);
        bench.device.distortion = 0;
        bench.run(seconds(1));
        EXPECT_EQ(bench.state(), UsbTrackerState::Streaming);
        bench.device.connectors = {2};
        bench.run(seconds(1));
        EXPECT_EQ(bench.state(), UsbTrackerState::SensorMissing);
        bench.device.connectors = {1, 2};
        bench.run(seconds(1));
        EXPECT_EQ(bench.state(), UsbTrackerState::Streaming);
    }
}

TEST(UsbTrackerDriver, CountsLostDuplicateAndLateFramesAndReturnsNoneTwice) {
    for (const UsbTrackerModel model : models) {
        Bench bench(model);
        bench.device.connectors = {1};
        std::mt19937 engine(9);
        std::uint64_t lost = 0;
        std::uint64_t doubled = 0;
        std::optional<wire::Wire> held;
        std::uint64_t late = 0;
        bench.device.mischief = [&](wire::Wire frame) -> std::vector<wire::Wire> {
            if (held) { // sent after its successor
                ++late;
                const wire::Wire before = *std::exchange(held, std::nullopt);
                return {frame, before};
            }
            switch (engine() % 12) {
            case 0:
                ++lost;
                return {};
            case 1:
                ++doubled;
                return {frame, frame};
            case 2:
                held = frame;
                return {};
            default:
                return {frame};
            }
        };
        bench.run(seconds(20));
        EXPECT_EQ(bench.state(), UsbTrackerState::Streaming);
        EXPECT_NEAR(static_cast<double>(bench.counts().lost), static_cast<double>(lost + late), 2.0);
        EXPECT_EQ(bench.counts().duplicated, doubled);
        EXPECT_EQ(bench.counts().reordered, late);
        for (std::size_t k = 1; k < bench.samples.size(); ++k) {
            EXPECT_LT(bench.samples[k - 1].time, bench.samples[k].time);
            EXPECT_NE(bench.samples[k - 1].position_m, bench.samples[k].position_m);
        }
    }
}

TEST(UsbTrackerDriver, CorruptedStreamYieldsOnlyPosesThatWereSent) {
    Bench bench(UsbTrackerModel::Viper);
    std::mt19937 engine(10);
    bench.device.mischief = [&](wire::Wire frame) -> std::vector<wire::Wire> {
        const std::size_t at = engine() % frame.size();
        switch (engine() % 6) {
        case 0:
            frame[at] ^= static_cast<std::byte>(1U << engine() % 8);
            return {frame};
        case 1:
            frame.resize(at);
            return {frame};
        case 2: { // split over two transfers
            const auto middle = frame.begin() + static_cast<std::ptrdiff_t>(at);
            return {wire::Wire(frame.begin(), middle), wire::Wire(middle, frame.end())};
        }
        case 3:
            return {wire::from_hex("565052 00FFFF 5650"), frame};
        default:
            return {frame};
        }
    };
    bench.run(seconds(60)); // every sample is compared with the sent ones
    EXPECT_TRUE(is_streaming(bench.state()));
    EXPECT_GT(bench.samples.size(), 2U * 60U * 120U / 3U);
    EXPECT_GT(bench.counts().broken, 1000U);
}

TEST(UsbTrackerDriver, MarksAndCountsInvalidPoses) {
    Bench bench(UsbTrackerModel::Viper);
    bench.device.mischief = [&](const wire::Wire&) -> std::vector<wire::Wire> {
        wire::Pose pose;
        pose.position[1] = std::numeric_limits<float>::quiet_NaN();
        return {wire::viper_frame(bench.device.counter, {pose})};
    };
    bench.run(seconds(2));
    ASSERT_GT(bench.samples.size(), 100U);
    for (const PoseSample& sample : bench.samples) {
        EXPECT_FALSE(sample.ok);
        EXPECT_EQ(sample.position_m, glm::dvec3(0.0));
    }
    EXPECT_EQ(bench.counts().unusable, bench.samples.size());
}

TEST(UsbTrackerDriver, AcceptsACounterThatRestarts) {
    for (const UsbTrackerModel model : models) {
        Bench bench(model);
        ASSERT_TRUE(bench.until_streaming(seconds(2)));
        bench.run(seconds(3));
        bench.device.counter = 0;
        bench.run(seconds(1));
        const std::size_t before = bench.samples.size();
        bench.run(seconds(1));
        EXPECT_GT(bench.samples.size(), before + 100);
    }
}

TEST(UsbTrackerDriver, AcceptsARestartedCounterWithLostOrDuplicateFrames) {
    const auto lost = [](std::uint32_t every) {
        return [=](const wire::Wire& frame, std::uint32_t number) {
            return number % every == 0 ? std::vector<wire::Wire>{} : std::vector<wire::Wire>{frame};
        };
    };
    const auto doubled = [](const wire::Wire& frame, std::uint32_t) {
        return std::vector<wire::Wire>{frame, frame};
    };
    using Way = std::function<std::vector<wire::Wire>(const wire::Wire&, std::uint32_t)>;
    for (const UsbTrackerModel model : models) {
        for (const Way& way : {Way(lost(2)), Way(lost(5)), Way(doubled)}) {
            Bench bench(model);
            bench.device.mischief = [&](const wire::Wire& frame) { return way(frame, bench.device.counter); };
            ASSERT_TRUE(bench.until_streaming(seconds(2)));
            bench.run(seconds(60));
            const TrackerCounts before = bench.counts();
            bench.device.counter = 0;
            bench.run(seconds(1));
            EXPECT_EQ(bench.state(), UsbTrackerState::Streaming);
            EXPECT_GT(bench.counts().frames, before.frames + 20); // and the device was not dropped because of
                                                                  // it
        }
    }
}

TEST(UsbTrackerDriver, ReopensAStreamWithoutAnyUsableFrame) {
    for (const UsbTrackerModel model : {UsbTrackerModel::Viper, UsbTrackerModel::Patriot}) {
        Bench bench(model);
        ASSERT_TRUE(bench.until_streaming(seconds(2)));
        bench.device.commands.clear();
        bench.device.text.clear();
        bench.device.mischief = [&](wire::Wire frame) {
            bench.device.counter += 5000; // far from the previous counter each time
            return std::vector<wire::Wire>{std::move(frame)};
        };
        bench.run(seconds(5));
        EXPECT_NE(bench.state(), UsbTrackerState::Streaming);
        constexpr std::uint32_t who_am_i = 20 * 16 + 1;
        EXPECT_TRUE(model == UsbTrackerModel::Viper
                        ? std::ranges::find(bench.device.commands, who_am_i) != bench.device.commands.end()
                        : bench.device.text.find('\x16') != std::string::npos);
        bench.device.mischief = {};
        EXPECT_TRUE(bench.until_streaming(seconds(2)));
    }
}

} // namespace
} // namespace frustumscreen::tracker

// The driver against bytes made with headers of other projects: the bytes that it sends, the bytes that it
// parses, and a whole set-up with a device made of fixtures alone.

#include "firmware_host/tracker/patriot_codec.h"
#include "firmware_host/tracker/viper_session.h"
#include "tests/tracker/fixture.h"

namespace frustumscreen::tracker {
namespace {

const wire::Fixture viper("viper.txt");
const wire::Fixture liberty("liberty.txt");
const glm::dquat turned(0.5, 0.5, -0.5, 0.5);

DeviceFrame viper_frame(const std::string& name) {
    const wire::Wire bytes = viper[name];
    const ViperStep step = parse_viper(bytes);
    EXPECT_EQ(step.consumed, bytes.size()) << name;
    const auto* frame = std::get_if<DeviceFrame>(&step.message);
    EXPECT_NE(frame, nullptr) << name;
    return frame != nullptr ? *frame : DeviceFrame{};
}

TEST(ViperFixtures, PosesMatchTheHeader) {
    EXPECT_EQ(viper_frame("pose.none").count, 0U);
    const DeviceFrame one = viper_frame("pose.one");
    ASSERT_EQ(one.count, 1U);
    EXPECT_EQ(one.counter, 2U);
    EXPECT_EQ(one.sensors[0].sensor, 1);
    EXPECT_EQ(one.sensors[0].position_m, glm::dvec3(0.25, -0.5, 1.0));
    EXPECT_EQ(one.sensors[0].rotation, turned);
    EXPECT_TRUE(one.sensors[0].usable && one.units_as_set && !one.fault);
    const DeviceFrame two = viper_frame("pose.two.distorted");
    ASSERT_EQ(two.count, 2U);
    EXPECT_EQ(two.sensors[0].position_m, glm::dvec3(0.0, 2.0, -0.125));
    EXPECT_EQ(two.sensors[1].sensor, 2);
    EXPECT_EQ(two.sensors[1].distortion, 200);
    const DeviceFrame all = viper_frame("pose.sixteen");
    ASSERT_EQ(all.count, 16U);
    for (std::size_t k = 0; k < all.count; ++k) {
        const auto number = static_cast<double>(k);
        EXPECT_EQ(all.sensors[k].sensor, static_cast<int>(k) + 1);
        EXPECT_EQ(all.sensors[k].position_m, glm::dvec3(number / 16.0, -0.5, number / 32.0));
        EXPECT_TRUE(all.sensors[k].usable);
    }
}

TEST(ViperFixtures, SystemFaultLeavesThePoseUsable) {
    const DeviceFrame frame = viper_frame("pose.built_in_test");
    EXPECT_TRUE(frame.fault);
    EXPECT_TRUE(frame.sensors[0].usable);
}

TEST(ViperFixtures, PosesInOtherUnitsAreNotUsable) {
    for (const std::string name : {"pose.centimetres", "pose.inches_degrees", "pose.acceleration"}) {
        const DeviceFrame frame = viper_frame(name);
        EXPECT_FALSE(frame.units_as_set) << name;
        EXPECT_FALSE(frame.sensors[0].usable) << name;
    }
    EXPECT_FALSE(viper_frame("pose.virtual").sensors[0].usable);
    const DeviceFrame buttons = viper_frame("pose.buttons");
    EXPECT_TRUE(buttons.sensors[0].usable);
    EXPECT_EQ(buttons.sensors[0].distortion, 0);
}

/// A VIPER made of fixtures alone: one answer to each command that our session may send, in this order.
struct Exchange {
    std::string command;
    std::string answer;
};
using Talk = std::vector<Exchange>;
const Talk set_up{
    {"host.stop", "answer.continuous"},
    {"host.whoami", "answer.whoami"},
    {"host.units.set", "answer.units.set"},
    {"host.units.get", "answer.units.get"},
    {"host.hemisphere.set", "answer.hemisphere.set"},
    {"host.hemisphere.get", "answer.hemisphere.get"},
    {"host.filter.set", "answer.filter.set"},
    {"host.filter.get.orientation", "answer.filter.get"},
    {"host.filter.get.position", "answer.filter.get"},
    {"host.frame_rate.set", "answer.frame_rate.set"},
    {"host.frame_rate.get", "answer.frame_rate.get"},
    {"host.start", "answer.continuous"},
};

Talk changed(const Talk& talk, const std::string& command, const std::string& answer) {
    Talk other = talk;
    for (Exchange& exchange : other) {
        exchange.answer = exchange.command == command ? answer : exchange.answer;
    }
    return other;
}

/// The state after the exchange and the frames, a tenth of a second apart.
UsbTrackerState state_after(const Talk& talk, const std::vector<std::string>& frames,
                            std::vector<PoseSample>& samples) {
    ViperSession session(UsbTrackerSetUp{});
    MonotonicTime now = from_microseconds(1'000'000);
    for (const Exchange& exchange : talk) {
        now += std::chrono::milliseconds(1);
        const std::span<const std::byte> sent = session.due(now);
        EXPECT_EQ(wire::Wire(sent.begin(), sent.end()), viper[exchange.command]) << exchange.command;
        session.receive(viper[exchange.answer], now, samples);
    }
    for (const std::string& frame : frames) {
        now += std::chrono::milliseconds(100);
        EXPECT_TRUE(session.due(now).empty()) << frame;
        session.receive(viper[frame], now, samples);
    }
    return session.state(now);
}

TEST(ViperFixtures, SetsUpAndStreams) {
    std::vector<PoseSample> samples;
    EXPECT_EQ(state_after(set_up, {"pose.none", "pose.one"}, samples), UsbTrackerState::Streaming);
    ASSERT_EQ(samples.size(), 1U);
    EXPECT_EQ(samples[0].position_m, glm::dvec3(0.25, -0.5, 1.0));
    EXPECT_EQ(samples[0].rotation, turned);
    EXPECT_TRUE(samples[0].ok);
}

TEST(ViperFixtures, ReportsWarningsRefusalsAndFaultsAndStillStreams) {
    const std::vector<std::pair<Talk, UsbTrackerState>> cases{
        {changed(set_up, "host.hemisphere.set", "warning.hemisphere.set"), UsbTrackerState::SetUpDoubtful},
        {changed(set_up, "host.hemisphere.get", "nak.hemisphere"), UsbTrackerState::SetUpDoubtful},
        {changed(set_up, "host.filter.get.position", "nak.filter"), UsbTrackerState::SetUpDoubtful},
        {changed(set_up, "host.filter.get.position", "answer.filter.get.medium"),
         UsbTrackerState::FilterStaysOn},
    };
    for (const auto& [talk, state] : cases) {
        std::vector<PoseSample> samples;
        EXPECT_EQ(state_after(talk, {"pose.one"}, samples), state);
        EXPECT_EQ(samples.size(), 1U);
    }
    std::vector<PoseSample> samples;
    EXPECT_EQ(state_after(set_up, {"pose.built_in_test"}, samples), UsbTrackerState::DeviceFault);
    ASSERT_EQ(samples.size(), 1U);
    EXPECT_TRUE(samples[0].ok);
}

TEST(ViperFixtures, ReportsBootingAndAFailedSelfTestDuringSetUp) {
    const auto cut = [](const std::string& answer) {
        Talk talk(set_up.begin(), set_up.begin() + 3);
        talk.back().answer = answer;
        return talk;
    };
    std::vector<PoseSample> samples;
    EXPECT_EQ(state_after(cut("nak.booting"), {}, samples), UsbTrackerState::Booting);
    EXPECT_EQ(state_after(cut("nak.built_in_test"), {}, samples), UsbTrackerState::DeviceFault);
}

TEST(LibertyFixtures, FramesMatchTheHeader) {
    struct Case {
        std::string name;
        int sensor;
        glm::dvec3 position_m;
        int distortion;
    };
    for (const Case& expected : {Case{"pose.liberty", 1, {0.25, -0.5, 1.0}, 0},
                                 Case{"pose.liberty.second_sensor", 2, {0.0625, 0.0, -0.125}, 0},
                                 Case{"pose.patriot", 1, {0.25, -0.5, 1.0}, 0},
                                 Case{"pose.patriot.distorted", 1, {0.25, -0.5, 1.0}, 200}}) {
        const wire::Wire bytes = liberty[expected.name];
        const PatriotStep step = parse_patriot(bytes);
        const auto* frame = std::get_if<DeviceFrame>(&step.message);
        ASSERT_NE(frame, nullptr) << expected.name;
        EXPECT_EQ(step.consumed, bytes.size());
        EXPECT_EQ(frame->sensors[0].sensor, expected.sensor);
        EXPECT_LT(glm::distance(frame->sensors[0].position_m, expected.position_m), 1e-12);
        EXPECT_EQ(frame->sensors[0].rotation, turned);
        EXPECT_EQ(frame->sensors[0].distortion, expected.distortion);
        EXPECT_EQ(frame->tick, expected.distortion == 0 ? 1500U : 1516U);
        EXPECT_TRUE(frame->sensors[0].usable);
    }
}

} // namespace
} // namespace frustumscreen::tracker

#include "app/show/device_intake.h"
#include "firmware_host/camera/camera_state.h"
#include "firmware_host/tracker/usb_tracker_state.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <set>
#include <string_view>
#include <utility>

namespace frustumscreen::show {
namespace {

using std::chrono::milliseconds;

/// Answers each poll with these samples, and every other poll with an error as well.
class FalteringTracker final : public tracker::Tracker {
public:
    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<tracker::PoseSample>& samples) override {
        tracker::PoseSample sample;
        sample.time = now;
        sample.position_m = {0.1, 0.2, 0.0};
        samples.push_back(sample);
        sample.station = tracker::head_station;
        sample.position_m = {0.0, -0.5, 0.6};
        samples.push_back(sample);
        return ++polls_ % 2 == 0 ? fail(ErrorKind::DeviceLost, "test.device", "unplugged") : Result<void>();
    }
    [[nodiscard]] std::string name() const override { return "faltering"; }
    [[nodiscard]] bool reports_table_frame() const override { return true; }

private:
    int polls_ = 0;
};

class OnePress final : public panel::Panel {
public:
    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<panel::PanelEvent>& events) override {
        if (std::exchange(left_, false)) {
            events.push_back({now, 1, panel::PressKind::Press});
            events.push_back({now, 1, panel::PressKind::LongPress});
            events.push_back({now, 0, panel::PressKind::Chord});
            events.push_back({now, 0, panel::PressKind::LongPress});
        }
        return {};
    }
    [[nodiscard]] std::string name() const override { return "one press"; }

private:
    bool left_ = true;
};

TEST(DeviceIntake, TurnsPressesAndChordsIntoCommandsOfOneFrame) {
    Inputs inputs;
    inputs.panel = std::make_unique<OnePress>();
    DeviceIntake intake(settings::Settings{}, inputs);
    intake.poll(MonotonicTime{});
    EXPECT_EQ(intake.commands(), (std::vector{settings::Command::NextArtifact, settings::Command::HoldOther,
                                              settings::Command::StaffMode, settings::Command::HoldFirst}));
    intake.poll(MonotonicTime{} + milliseconds(16));
    EXPECT_TRUE(intake.commands().empty());
}

TEST(DeviceIntake, PropIsKnownWithoutATracker) {
    Inputs inputs;
    DeviceIntake intake(settings::Settings{}, inputs);
    intake.poll(MonotonicTime{});
    EXPECT_TRUE(intake.tracked_state_at(MonotonicTime{}).prop_known);
}

/// Two eyes for stereo alone: a fixed viewer has both from the first picture, and a head that a tracker could report none before it
/// is known.
TEST(DeviceIntake, SeparatesTheEyesInStereoUnlessTheHeadIsStillUnknown) {
    struct Case {
        settings::Stereo stereo;
        settings::TrackerKind tracker;
        bool tracked;
        double apart;
    };
    using settings::Stereo;
    using settings::TrackerKind;
    for (const Case& is : {Case{Stereo::Off, TrackerKind::None, false, 0.0},
                           Case{Stereo::Anaglyph, TrackerKind::None, false, 1.0},
                           Case{Stereo::Anaglyph, TrackerKind::None, true, 1.0},
                           Case{Stereo::Anaglyph, TrackerKind::Usb, false, 1.0},
                           Case{Stereo::Anaglyph, TrackerKind::Usb, true, 0.0}}) {
        settings::Settings settings;
        settings.eye.stereo = is.stereo;
        settings.tracker.kind = is.tracker;
        settings.eye.tracked = is.tracked;
        Inputs inputs;
        DeviceIntake intake(settings, inputs);
        intake.poll(MonotonicTime{});
        EXPECT_EQ(intake.tracked_state_at(MonotonicTime{}).eyes_apart, is.apart)
            << static_cast<int>(is.tracker);
    }
}

/// A frustum on the table is followed by the table's filter alone; whatever a hand lifts also by the hand's.
TEST(DeviceIntake, FiltersThePropsPoseByItsKindOfMotion) {
    class Lifted final : public tracker::Tracker {
    public:
        [[nodiscard]] static tracker::PoseSample at(MonotonicTime now) {
            tracker::PoseSample sample;
            sample.time = now;
            sample.position_m = {0.0, 0.0, 0.2 + 0.1 * std::sin(3.0 * to_seconds(now.time_since_epoch()))};
            return sample;
        }
        [[nodiscard]] Result<void> poll(MonotonicTime now,
                                        std::vector<tracker::PoseSample>& samples) override {
            samples.push_back(at(now));
            return {};
        }
        [[nodiscard]] std::string name() const override { return "lifted"; }
        [[nodiscard]] bool reports_table_frame() const override { return true; }
    };
    settings::Settings in_hand;
    in_hand.prop.zone = settings::PropZone::Hand;
    settings::Settings cube;
    cube.prop = settings::cube_settings(0.1);
    cube.prop.zone = settings::PropZone::Table;
    using tracking::PropMotion;
    for (const auto& [settings, motion] :
         {std::pair(settings::Settings{}, PropMotion::OnTable), std::pair(in_hand, PropMotion::InHand),
          std::pair(cube, PropMotion::InHand)}) {
        Inputs inputs;
        inputs.tracker = std::make_unique<tracking::RegisteredTracker>(std::make_unique<Lifted>(),
                                                                       geometry::Registration{});
        DeviceIntake intake(settings, inputs);
        tracking::LiveTrackedState same(settings.eye.default_m, 0.5 * settings.prop.height_m, {}, motion);
        for (int k = 0; k < 100; ++k) {
            const MonotonicTime now(milliseconds(16 * k));
            intake.poll(now);
            same.take(Lifted::at(now));
            const MonotonicTime lit = now + milliseconds(30);
            ASSERT_EQ(intake.tracked_state_at(lit).table_from_prop.translation,
                      same.at(lit).table_from_prop.translation)
                << name_of(settings.prop.kind) << ' ' << k;
        }
    }
}

/// A simulated visitor's head may rest without trembling, and wears the glasses all the same; a recorded one that does has put them
/// down.
TEST(DeviceIntake, KeepsStereoForAStillSimulatedHead) {
    class StillHead final : public tracker::Tracker {
    public:
        [[nodiscard]] Result<void> poll(MonotonicTime now,
                                        std::vector<tracker::PoseSample>& samples) override {
            samples.push_back(
                {.time = now, .station = tracker::head_station, .position_m = {0.1, -0.5, 0.4}});
            return {};
        }
        [[nodiscard]] std::string name() const override { return "still"; }
        [[nodiscard]] std::string_view state() const override { return "the head rests"; }
    };
    for (const auto& [kind, apart] :
         {std::pair{settings::TrackerKind::Simulated, 1.0}, {settings::TrackerKind::Replay, 0.0}}) {
        settings::Settings settings;
        settings.eye.stereo = settings::Stereo::TopBottom;
        settings.tracker.kind = kind;
        Inputs inputs;
        inputs.tracker = std::make_unique<tracking::RegisteredTracker>(std::make_unique<StillHead>(),
                                                                       geometry::Registration{});
        DeviceIntake intake(settings, inputs);
        tracking::TrackedState state;
        for (MonotonicTime now{}; now < MonotonicTime(std::chrono::seconds(10)); now += milliseconds(16)) {
            intake.poll(now);
            state = intake.tracked_state_at(now);
        }
        EXPECT_EQ(state.eyes_apart, apart);
    }
}

class MissingPanel final : public panel::Panel {
public:
    [[nodiscard]] Result<void> poll(MonotonicTime /*now*/,
                                    std::vector<panel::PanelEvent>& /*events*/) override {
        return {};
    }
    [[nodiscard]] std::string name() const override { return "missing"; }
    [[nodiscard]] std::string_view state() const override { return "it is not there"; }
    [[nodiscard]] DeviceCondition condition() const override { return {DeviceHealth::Away, "panel.missing"}; }
};

TEST(DeviceIntake, ReportsUnusableDevices) {
    Inputs inputs;
    inputs.panel = std::make_unique<MissingPanel>();
    inputs.tracker = std::make_unique<tracking::RegisteredTracker>(std::make_unique<FalteringTracker>(),
                                                                   geometry::Registration{});
    DeviceIntake intake(settings::Settings{}, inputs);
    RunStatus status;
    intake.tell({}, status);
    EXPECT_EQ(status.devices.panel.ok, false);
    EXPECT_EQ(status.devices.panel.id, "panel.missing");
    EXPECT_EQ(status.panel.view(), "it is not there");
    EXPECT_FALSE(status.devices.tracker.ok) << "it stands in for one";
    EXPECT_FALSE(status.devices.sound.ok) << "there is none";
}

/// Each state has its own id, and counts as away if the device's own health says that it delivers nothing.
template <typename State, typename Health>
void expect_conditions(State last, std::string_view subject, Health away) {
    std::set<std::string_view> ids;
    for (int k = 0; k <= static_cast<int>(last); ++k) {
        const auto state = static_cast<State>(k);
        const DeviceCondition condition = condition_of(state);
        EXPECT_TRUE(condition.id.view().starts_with(subject)) << condition.id.view();
        EXPECT_TRUE(ids.insert(condition.id).second) << condition.id.view();
        EXPECT_EQ(condition.health == DeviceHealth::Away, health_of(state) == away) << sentence_of(state);
        EXPECT_FALSE(sentence_of(state).empty());
    }
}

TEST(DeviceIntake, EveryTrackerAndCameraStateHasItsId) {
    expect_conditions(tracker::UsbTrackerState::MetalNear, "tracker.", tracker::TrackerHealth::Away);
    expect_conditions(camera::CameraState::Silent, "camera.", camera::CameraHealth::Away);
    EXPECT_EQ(tracker::condition_of(tracker::UsbTrackerState::Streaming).health, DeviceHealth::Well);
    EXPECT_EQ(tracker::condition_of(tracker::UsbTrackerState::MetalNear).health, DeviceHealth::Impaired);
    EXPECT_EQ(camera::condition_of(camera::CameraState::Running).health, DeviceHealth::Well);
    EXPECT_EQ(camera::condition_of(camera::CameraState::Dark).health, DeviceHealth::Impaired);
}

TEST(DeviceIntake, CountsErrorsAndKeepsTheSamplesBeforeThem) {
    for (const bool followed : {true, false}) {
        settings::Settings settings;
        settings.eye.tracked = followed;
        Inputs inputs;
        inputs.tracker = std::make_unique<tracking::RegisteredTracker>(std::make_unique<FalteringTracker>(),
                                                                       geometry::Registration{});
        DeviceIntake intake(settings, inputs);
        MonotonicTime now{};
        for (int k = 0; k < 60; ++k, now += milliseconds(16)) {
            intake.poll(now);
        }
        const tracking::TrackedState tracked_state = intake.tracked_state_at(now);
        EXPECT_NEAR(tracked_state.table_from_prop.translation.x, 0.1, 1e-6);
        EXPECT_EQ(tracked_state.head_known, followed) << "a fixed viewer's head is not asked for";
        RunStatus status;
        intake.tell(tracked_state, status);
        EXPECT_EQ(status.device_errors, 30U);
        EXPECT_EQ(status.prop_by, "tracker");
        EXPECT_EQ(status.eye_by, followed ? "sensor" : "settings");
    }
}

} // namespace
} // namespace frustumscreen::show

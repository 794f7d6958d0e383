/// Polls the devices of a run once a frame: turns poses and heads into the situation, button presses into commands.
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  the render thread. `poll` and `tracked_state_at` allocate nothing.
/// Errors   a failing device is counted, and polled again in the next frame.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/settings/settings.h"
#include "app/show/inputs.h"
#include "app/show/run_report.h"
#include "app/tracking/live_tracked_state.h"
#include "app/tracking/signal_meter.h"
#include "app/tracking/tracked_state.h"

#include <cstdint>
#include <string>
#include <vector>

namespace frustumscreen::show {

/// The uses of the camera, in words; empty: none.
[[nodiscard]] std::string camera_uses(const Inputs& inputs);

class DeviceIntake {
public:
    DeviceIntake(const settings::Settings& settings, Inputs& inputs);

    /// Polls every device once.
    void poll(MonotonicTime now);
    /// The commands of this frame.
    [[nodiscard]] const std::vector<settings::Command>& commands() const { return commands_; }
    void drop_commands() { commands_.clear(); }
    /// Prop, eye and tracker at the time at which the picture is lit.
    [[nodiscard]] tracking::TrackedState tracked_state_at(MonotonicTime lit);
    /// The tracker's signal of the prop's sensor and of the head's.
    [[nodiscard]] const tracking::SignalMeter& prop_signal() const { return prop_signal_; }
    [[nodiscard]] const tracking::SignalMeter& head_signal() const { return head_signal_; }
    /// The devices' part of the status. `shown`: the situation of the latest picture.
    void tell(const tracking::TrackedState& shown, RunStatus& status) const;

private:
    void take_poses(MonotonicTime now);
    [[nodiscard]] tracker::TrackerHealth tracker_health() const;
    void tell_of_camera(RunStatus& status) const;

    Inputs& inputs_;
    bool head_is_followed_;
    bool looks_for_drift_;
    tracking::LiveTrackedState tracked_state_;
    tracking::SignalMeter prop_signal_, head_signal_;
    std::uint64_t errors_ = 0;
    std::vector<tracker::PoseSample> samples_; ///< `samples_` to `events_`: of this frame
    std::vector<tracking::UncertainPose> tag_poses_, lamp_poses_;
    std::vector<tracking::SeenHead> heads_;
    std::vector<panel::PanelEvent> events_;
    std::vector<settings::Command> commands_;
};

} // namespace frustumscreen::show

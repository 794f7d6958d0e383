#include "app/show/device_intake.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen::show {

namespace {

std::optional<settings::Command> command_of(const panel::PanelEvent& event) {
    switch (event.kind) {
    case panel::PressKind::Press:
        return settings::command_of_button(event.button);
    case panel::PressKind::LongPress:
        return event.button == 0 ? settings::Command::HoldFirst
               : event.button == settings::button_of(settings::Command::Window)
                   ? settings::Command::HoldWindow
                   : settings::Command::HoldOther;
    case panel::PressKind::Chord:
        return settings::Command::StaffMode;
    default:
        return std::nullopt;
    }
}

/// The sentence is empty if there is no camera.
DeviceState camera_state(const Inputs& inputs) {
    if (!inputs.camera) {
        return {};
    }
    const camera::CameraState state = inputs.camera->state();
    const bool is_well = camera::health_of(state) == camera::CameraHealth::Well;
    if (is_well && inputs.tags && !inputs.tags->trouble().empty()) {
        return {{DeviceHealth::Impaired, "camera.no_tags"}, Sentence(inputs.tags->trouble())};
    }
    if (is_well && inputs.visitor && !inputs.visitor->trouble().empty()) {
        return {{DeviceHealth::Impaired, "camera.no_visitor"}, Sentence(inputs.visitor->trouble())};
    }
    return {camera::condition_of(state), Sentence(camera::sentence_of(state))};
}

/// `device`: null if not configured.
status::DeviceReport report_of(const auto& device) {
    return device ? status::DeviceReport(device->condition()) : status::DeviceReport{};
}

/// Without stereo there is one eye. Where no device could follow a head, the viewer is fixed.
tracking::TwoEyes two_eyes(const settings::Settings& settings) {
    if (settings::stereo_of(settings) == settings::Stereo::Off) {
        return {};
    }
    const settings::TrackerKind tracker = settings.tracker.kind;
    const bool has_device = tracker != settings::TrackerKind::None || settings.camera.visitor;
    return {.half_apart_m = 0.5e-3 * settings.eye.interocular_mm,
            .fixed_viewer = !settings.eye.tracked || !has_device,
            .glasses_may_lie = tracker != settings::TrackerKind::Simulated};
}

/// A frustum of the zone Table stands at all times.
tracking::PropMotion prop_motion(const settings::PropSettings& prop) {
    const bool on_table = prop.kind == settings::PropKind::Frustum && prop.zone == settings::PropZone::Table;
    return on_table ? tracking::PropMotion::OnTable : tracking::PropMotion::InHand;
}

/// A simulated torch is a tracker's.
tracking::TorchSources torch_sources(const settings::TorchSettings& torch) {
    return {.tracker = torch.by_tracker(), .camera = torch.by_camera()};
}

} // namespace

std::string camera_uses(const Inputs& inputs) {
    std::vector<std::string_view> uses;
    if (inputs.tags) {
        uses.emplace_back("the prop's tags");
    }
    if (inputs.visitor) {
        uses.emplace_back("the visitor's eye");
    }
    if (inputs.drift) {
        uses.emplace_back("the picture's place");
    }
    return fmt::format("{}", fmt::join(uses, ", "));
}

DeviceIntake::DeviceIntake(const settings::Settings& settings, Inputs& inputs)
    : inputs_(inputs), head_is_followed_(settings.eye.tracked), looks_for_drift_(settings.camera.drift),
      tracked_state_(settings.eye.default_m, 0.5 * settings.prop.height_m, two_eyes(settings),
                     prop_motion(settings.prop), torch_sources(settings.torch)) {
    samples_.reserve(1024);
    tag_poses_.reserve(64);
    lamp_poses_.reserve(64);
    heads_.reserve(64);
    events_.reserve(64);
    commands_.reserve(64);
}

void DeviceIntake::poll(MonotonicTime now) {
    take_poses(now);
    events_.clear();
    commands_.clear();
    if (inputs_.panel) {
        errors_ += inputs_.panel->poll(now, events_) ? 0 : 1;
    }
    for (const panel::PanelEvent& event : events_) {
        if (const std::optional<settings::Command> command = command_of(event)) {
            commands_.push_back(*command);
        }
    }
}

void DeviceIntake::take_poses(MonotonicTime now) {
    samples_.clear();
    tag_poses_.clear();
    lamp_poses_.clear();
    heads_.clear();
    if (inputs_.tracker) {
        errors_ += inputs_.tracker->poll(now, samples_) ? 0 : 1;
    }
    if (inputs_.tags) {
        inputs_.tags->poll(now, tag_poses_);
        inputs_.tags->poll_lamp(now, lamp_poses_);
    }
    if (inputs_.visitor) {
        inputs_.visitor->poll(now, heads_);
    }
    for (const tracker::PoseSample& sample : samples_) {
        if (sample.station == tracker::prop_station) {
            prop_signal_.take(sample);
        } else if (sample.station == tracker::head_station) {
            head_signal_.take(sample);
        }
        if (head_is_followed_ || sample.station != tracker::head_station) {
            errors_ += tracked_state_.take(sample) ? 0 : 1;
        }
    }
    for (const tracking::UncertainPose& pose : tag_poses_) {
        errors_ += tracked_state_.take_tags(pose) ? 0 : 1;
    }
    for (const tracking::UncertainPose& pose : lamp_poses_) {
        errors_ += tracked_state_.take_lamp(pose) ? 0 : 1;
    }
    for (const tracking::SeenHead& head : heads_) {
        errors_ += tracked_state_.take_visitor(head) ? 0 : 1;
    }
}

tracker::TrackerHealth DeviceIntake::tracker_health() const {
    return inputs_.tracker ? inputs_.tracker->health() : tracker::TrackerHealth::Well;
}

tracking::TrackedState DeviceIntake::tracked_state_at(MonotonicTime lit) {
    const tracker::TrackerHealth health = tracker_health();
    tracked_state_.tracker_is(health);
    tracking::TrackedState tracked_state = tracked_state_.at(lit);
    tracked_state.prop_known = tracked_state.prop_known || (!inputs_.tracker && !inputs_.tags);
    // The tags stand in for the tracker, so its failure does not concern visitors.
    tracked_state.tracker = tracked_state.by_tags ? tracker::TrackerHealth::Well : health;
    return tracked_state;
}

void DeviceIntake::tell(const tracking::TrackedState& shown, RunStatus& status) const {
    status.device_errors = errors_;
    status.tracker_counts = inputs_.tracker ? inputs_.tracker->counts() : tracker::TrackerCounts{};
    status.tracker_hangs = inputs_.tracker && inputs_.tracker->hangs();
    status.tracker = Sentence(inputs_.tracker ? inputs_.tracker->state() : std::string_view{});
    status.prop_by = shown.by_tags ? "tags" : inputs_.tracker ? "tracker" : "";
    status.eye_by = shown.head_known ? "sensor" : shown.head_seen ? "camera" : "settings";
    status.eye_sd_m = status.eye_by == "camera" ? std::optional(shown.eye_sd_m) : std::nullopt;
    status.source_changes = tracked_state_.source_changes();
    status.devices.tracker = report_of(inputs_.tracker);
    status.devices.panel = report_of(inputs_.panel);
    status.devices.sound = report_of(inputs_.sound);
    status.panel = Sentence(inputs_.panel ? inputs_.panel->state() : std::string_view{});
    status.sound = Sentence(inputs_.sound ? inputs_.sound->state() : std::string_view{});
    status.recording = inputs_.recorder ? Sentence(inputs_.recorder->state()) : inputs_.why_not_recorded;
    tell_of_camera(status);
}

void DeviceIntake::tell_of_camera(RunStatus& status) const {
    const DeviceState camera = camera_state(inputs_);
    status.camera = camera.sentence;
    status.devices.camera = inputs_.camera ? status::DeviceReport(camera.condition) : status::DeviceReport{};
    status.camera_hz = inputs_.camera ? inputs_.camera->rate_hz() : 0.0;
    if (inputs_.viewfinder && inputs_.camera) {
        const std::optional<camera::CameraSetUp> set_up = inputs_.camera->set_up();
        status.camera_width = set_up ? set_up->mode.width : 0;
        status.camera_height = set_up ? set_up->mode.height : 0;
    }
    if (inputs_.drift) {
        const drift::DriftVerdict& verdict = inputs_.drift->verdict();
        status.drift = drift::sentence_of(verdict);
        status.drifted = verdict.state == drift::DriftState::Moved;
        status.drift_m = verdict.off_m;
    } else if (looks_for_drift_) {
        status.drift = Sentence("no calibration is kept to compare the marks with; measure the table");
    }
}

} // namespace frustumscreen::show

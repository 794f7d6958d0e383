#include "app/programs/devices/wiring.h"

#include "app/drift/drift_reference.h"
#include "app/drift/mark_places.h"
#include "app/settings/command.h"
#include "app/settings/lit_zone.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/version.h"
#include "firmware_host/camera/v4l2_camera.h"
#include "firmware_host/display/kms_display.h"
#include "firmware_host/display/surfaceless_display.h"
#include "firmware_host/panel/button_panel.h"
#include "firmware_host/panel/key_lines.h"
#include "firmware_host/panel/scripted_panel.h"
#include "firmware_host/sound/device_sound.h"
#include "firmware_host/sound/pcm_device.h"
#include "firmware_host/tracker/composite_bus.h"
#include "firmware_host/tracker/hidapi_transport.h"
#include "firmware_host/tracker/libusb_transport.h"
#include "firmware_host/tracker/packet_replay.h"
#include "firmware_host/tracker/pose_file.h"
#include "firmware_host/tracker/replay_tracker.h"
#include "firmware_host/tracker/simulated_tracker.h"
#include "firmware_host/tracker/usb_tracker.h"

#include <fmt/chrono.h>
#include <sys/resource.h>

#include <cmath>
#include <ctime>
#include <utility>

namespace frustumscreen {

namespace {

/// Used share of the zone in which every face is lit: at the zone's edge the light only grazes a face.
constexpr double used_share_of_zone = 0.75;

Nanoseconds nanoseconds(double seconds) {
    return Nanoseconds(static_cast<Nanoseconds::rep>(std::llround(seconds * 1e9)));
}

/// Opens a pose file or a packet recording.
Result<std::unique_ptr<Tracker>> make_replay(const TrackerSettings& tracker, MonotonicTime start) {
    const std::string name = tracker.poses.string();
    TRY(Bytes bytes, read_file(tracker.poses));
    if (is_packet_recording(bytes)) {
        TRY(PacketReplay replay, PacketReplay::open(std::move(bytes), name));
        return std::make_unique<PacketReplayTracker>(std::move(replay), start, tracker.replay_speed);
    }
    TRY(std::vector<PoseSample> samples, parse_poses(as_text(bytes), name));
    return std::make_unique<ReplayTracker>(std::move(samples), start, true, tracker.replay_speed);
}

bool has_packets(TrackerKind kind) {
    return kind == TrackerKind::Usb || kind == TrackerKind::SpaceMouse;
}

std::unique_ptr<UsbBus> make_bus(TrackerKind kind) {
    if (kind == TrackerKind::SpaceMouse) {
        return make_hid_bus(UsbTrackerModel::SpaceMouse);
    }
    std::vector<std::unique_ptr<UsbBus>> buses;
    buses.push_back(make_libusb_bus());
    buses.push_back(make_hid_bus(UsbTrackerModel::Hid));
    return std::make_unique<CompositeBus>(std::move(buses));
}

Result<std::unique_ptr<Tracker>> make_tracker(const Settings& settings, MonotonicTime start, PacketTap* tap) {
    if (settings.tracker.kind == TrackerKind::Replay) {
        return at(settings.tracker.poses_key, make_replay(settings.tracker, start));
    }
    if (has_packets(settings.tracker.kind)) {
        const UsbTrackerSetUp set_up{settings.tracker.hemisphere,
                                     0.5 * glm::dvec2(settings.table.width_m, settings.table.depth_m)};
        return std::make_unique<UsbTracker>(make_bus(settings.tracker.kind), set_up, tap);
    }
    const Rectangle places = lit_rectangle(settings);
    SimulatedVisitor visitor;
    visitor.seed = settings.tracker.seed;
    visitor.centre_m = places.centre_m;
    visitor.half_extent_m = used_share_of_zone * places.half_m;
    visitor.eye_m = settings.eye.default_m;
    return std::make_unique<SimulatedTracker>(visitor, start);
}

ButtonTimes times_of(const PanelSettings& panel) {
    ButtonTimes times;
    times.debounce = nanoseconds(1e-3 * panel.debounce_ms);
    times.stuck = nanoseconds(panel.stuck_s);
    return times;
}

Result<std::unique_ptr<Panel>> make_keys(const PanelSettings& panel) {
    TRY(const std::vector<std::uint16_t> codes, key_codes(panel.keys));
    const KeyRequest request{panel.device, codes};
    return std::make_unique<ButtonPanel>([request] { return open_key_lines(request); }, panel.keys.size(),
                                         times_of(panel));
}

std::unique_ptr<Panel> make_buttons(const PanelSettings& panel) {
    const LineRequest request{panel.chip, panel.lines, panel.bias, panel.active_low, panel.lamps};
    return std::make_unique<ButtonPanel>([request] { return open_gpio_lines(request); }, panel.lines.size(),
                                         times_of(panel));
}

Result<std::unique_ptr<Panel>> make_panel(const Settings& settings, std::optional<Nanoseconds> press_every,
                                          MonotonicTime start) {
    if (press_every) {
        return std::make_unique<ScriptedPanel>(
            std::vector<PanelPress>{{*press_every / 2, button_of(Command::NextArtifact)}}, *press_every,
            start);
    }
    if (settings.panel.kind == PanelKind::Gpio) {
        return make_buttons(settings.panel);
    }
    if (settings.panel.kind == PanelKind::Keys) {
        return make_keys(settings.panel);
    }
    std::vector<PanelPress> script;
    for (const ScriptedPress& press : settings.panel.script) {
        script.push_back({nanoseconds(press.at_s), press.button});
    }
    return std::make_unique<ScriptedPanel>(std::move(script), nanoseconds(settings.panel.repeat_s), start);
}

TagSetUp tag_set_up(const CameraSettings& camera) {
    TagSetUp set_up{camera.pinhole, camera.table_from_camera, {}, 1e-3 * camera.rolling_shutter_ms};
    for (const TagSettings& tag : camera.tag) {
        set_up.tags.push_back({tag.id, tag.size_m, prop_from_tag(tag)});
    }
    return set_up;
}

VisitorSetUp visitor_set_up(const Settings& settings) {
    VisitorSetUp set_up{settings.camera.pinhole, settings.camera.table_from_camera, {}};
    set_up.zone.table_size_m = {settings.table.width_m, settings.table.depth_m};
    return set_up;
}

DriftSetUp drift_set_up(const Settings& settings) {
    DriftSetUp set_up{mark_places(settings), {}, settings.calibration.folder / drift_file};
    for (const TagSettings& tag : settings.camera.tag) {
        set_up.moving_tags.push_back(tag.id);
    }
    return set_up;
}

/// Adds the camera, and the users of its frames.
void add_camera(Inputs& inputs, const Settings& settings, const DevicePlan& plan) {
    std::vector<FrameUse> uses;
    if (plan.tags) {
        inputs.tags = std::make_unique<TagTracker>(tag_set_up(settings.camera));
        uses.emplace_back([&tags = *inputs.tags](const CameraFrame& frame) { tags.use(frame); });
    }
    if (plan.visitor) {
        inputs.visitor = std::make_unique<VisitorTracker>(visitor_set_up(settings));
        uses.emplace_back([&visitor = *inputs.visitor](const CameraFrame& frame) { visitor.use(frame); });
    }
    if (plan.drift) {
        inputs.drift = std::make_unique<DriftWatch>(drift_set_up(settings));
        uses.emplace_back([&drift = *inputs.drift](const CameraFrame& frame) { drift.use(frame); });
    }
    if (!uses.empty() && plan.panel) {
        inputs.viewfinder = std::make_unique<Viewfinder>(settings);
        uses.emplace_back(
            [&viewfinder = *inputs.viewfinder](const CameraFrame& frame) { viewfinder.use(frame); });
    }
    if (!uses.empty()) {
        inputs.camera = make_camera(settings.camera, std::move(uses));
    }
}

} // namespace

Result<std::unique_ptr<Display>> make_display(const Settings& settings, bool headless) {
    const DisplaySettings& display = settings.display;
    if (!headless && display.kind == DisplayKind::Kms) {
        OutputRequest request;
        const auto named = [](const std::string& name) { return name == "any" ? std::string() : name; };
        request.connector = named(display.connector);
        request.width = display.mode.width;
        request.height = display.mode.height;
        request.refresh_hz = display.mode.refresh_hz;
        request.force = display.force;
        request.picture_width = settings.projector.pinhole.width;
        request.picture_height = settings.projector.pinhole.height;
        request.picture_hz = settings.projector.refresh_hz;
        return KmsDisplay::create(named(display.card), request);
    }
    return SurfacelessDisplay::create(settings.projector.pinhole.width, settings.projector.pinhole.height);
}

Result<std::unique_ptr<PacketRecorder>> make_recorder(TrackerKind kind, const std::filesystem::path& path) {
    if (!has_packets(kind)) {
        return fail(ErrorKind::BadConfiguration, "record.no_packets",
                    "tracker.kind is \"{}\", which has no packets to record; allowed are \"usb\" and "
                    "\"spacemouse\"",
                    name_of(kind));
    }
    TRY(GrowingFile file, GrowingFile::create(path));
    const std::string about = fmt::format("FrustumScreen {}, recorded from {:%Y-%m-%d %H:%M:%S} UTC on",
                                          project_version(), fmt::gmtime(std::time(nullptr)));
    return std::make_unique<PacketRecorder>(std::move(file), about, monotonic_now());
}

std::unique_ptr<Sound> make_sound(const SoundSettings& settings) {
    if (settings.kind == SoundKind::None) {
        return nullptr;
    }
    return std::make_unique<DeviceSound>([device = settings.device] { return open_alsa(device); });
}

CameraRequest camera_request(const CameraSettings& settings) {
    CameraRequest request{settings.device, settings.width, settings.height, settings.rate_hz, {}, {}, {}};
    if (settings.exposure_ms > 0.0) {
        request.exposure_ms = settings.exposure_ms;
    }
    if (settings.gain >= 0) {
        request.gain = settings.gain;
    }
    if (settings.white_balance_k > 0) {
        request.white_balance_k = settings.white_balance_k;
    }
    return request;
}

std::unique_ptr<Camera> make_camera(const CameraSettings& settings, std::vector<FrameUse> uses) {
    const rlimit none{0, 0};
    static_cast<void>(::setrlimit(RLIMIT_CORE, &none));             // a dump would contain a frame
    const double max_share = uses.empty() ? 1.0 : max_camera_share; // a calibration needs every frame
    const auto use_all = [uses = std::move(uses)](const CameraFrame& frame) {
        for (const FrameUse& use : uses) {
            use(frame);
        }
    };
    return std::make_unique<V4l2Camera>(kernel_v4l2_devices(), camera_request(settings), use_all, max_share);
}

Result<Inputs> make_inputs(const Settings& settings, const DevicePlan& plan,
                           std::optional<Nanoseconds> press_every, MonotonicTime start,
                           std::unique_ptr<PacketRecorder> recorder) {
    Inputs inputs;
    inputs.recorder = std::move(recorder);
    if (plan.tracker != TrackerKind::None) {
        TRY(std::unique_ptr<Tracker> tracker, make_tracker(settings, start, inputs.recorder.get()));
        inputs.tracker =
            std::make_unique<RegisteredTracker>(std::move(tracker), settings.tracker.registration);
    }
    add_camera(inputs, settings, plan);
    if (plan.panel) {
        TRY(inputs.panel, make_panel(settings, press_every, start));
    }
    return inputs;
}

} // namespace frustumscreen

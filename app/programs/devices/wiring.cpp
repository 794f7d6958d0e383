#include "app/programs/devices/wiring.h"

#include "app/drift/drift_reference.h"
#include "app/drift/mark_places.h"
#include "app/scene/flat_screen.h"
#include "app/scene/stereo.h"
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

namespace frustumscreen::programs {

namespace {

/// Used share of the zone in which every face is lit: at the zone's edge the light only grazes a face.
constexpr double used_share_of_zone = 0.75;

Nanoseconds nanoseconds(double seconds) {
    return Nanoseconds(static_cast<Nanoseconds::rep>(std::llround(seconds * 1e9)));
}

/// A name in the settings; empty for any.
std::string or_any(const std::string& name) {
    return name == "any" ? std::string() : name;
}

display::EyeLayout eye_layout(settings::Stereo stereo) {
    switch (stereo) {
    case settings::Stereo::SideBySide:
        return display::EyeLayout::SideBySide;
    case settings::Stereo::TopBottom:
        return display::EyeLayout::TopBottom;
    case settings::Stereo::FrameSequential:
        return display::EyeLayout::InTurn;
    case settings::Stereo::Off:
    case settings::Stereo::Anaglyph: // the picture's own colours tell the eyes apart
        break;
    }
    return display::EyeLayout::One;
}

/// Opens a pose file or a packet recording.
Result<std::unique_ptr<tracker::Tracker>> make_replay(const settings::TrackerSettings& tracker,
                                                      MonotonicTime start) {
    const std::string name = tracker.poses.string();
    TRY(Bytes bytes, read_file(tracker.poses));
    if (tracker::is_packet_recording(bytes)) {
        TRY(tracker::PacketReplay replay, tracker::PacketReplay::open(std::move(bytes), name));
        return std::make_unique<tracker::PacketReplayTracker>(std::move(replay), start, tracker.replay_speed);
    }
    TRY(std::vector<tracker::PoseSample> samples, tracker::parse_poses(as_text(bytes), name));
    return std::make_unique<tracker::ReplayTracker>(std::move(samples), start, true, tracker.replay_speed);
}

bool has_packets(settings::TrackerKind kind) {
    return kind == settings::TrackerKind::Usb || kind == settings::TrackerKind::SpaceMouse;
}

std::unique_ptr<tracker::UsbBus> make_bus(settings::TrackerKind kind) {
    if (kind == settings::TrackerKind::SpaceMouse) {
        return tracker::make_hid_bus(tracker::UsbTrackerModel::SpaceMouse);
    }
    std::vector<std::unique_ptr<tracker::UsbBus>> buses;
    buses.push_back(tracker::make_libusb_bus());
    buses.push_back(tracker::make_hid_bus(tracker::UsbTrackerModel::Hid));
    return std::make_unique<tracker::CompositeBus>(std::move(buses));
}

Result<std::unique_ptr<tracker::Tracker>> make_tracker(const settings::Settings& settings,
                                                       MonotonicTime start, tracker::PacketTap* tap) {
    if (settings.tracker.kind == settings::TrackerKind::Replay) {
        return at(settings.tracker.poses_key, make_replay(settings.tracker, start));
    }
    if (has_packets(settings.tracker.kind)) {
        const tracker::UsbTrackerSetUp set_up{
            settings.tracker.hemisphere, 0.5 * glm::dvec2(settings.table.width_m, settings.table.depth_m)};
        return std::make_unique<tracker::UsbTracker>(make_bus(settings.tracker.kind), set_up, tap);
    }
    const settings::Rectangle places = settings::lit_rectangle(settings);
    tracker::SimulatedVisitor visitor;
    visitor.seed = settings.tracker.seed;
    visitor.centre_m = places.centre_m;
    visitor.half_extent_m = used_share_of_zone * places.half_m;
    visitor.eye_m = settings.eye.default_m;
    visitor.torch = settings.torch.by_tracker();
    return std::make_unique<tracker::SimulatedTracker>(visitor, start);
}

panel::ButtonTimes times_of(const settings::PanelSettings& panel) {
    panel::ButtonTimes times;
    times.debounce = nanoseconds(1e-3 * panel.debounce_ms);
    times.stuck = nanoseconds(panel.stuck_s);
    return times;
}

Result<std::unique_ptr<panel::Panel>> make_keys(const settings::PanelSettings& panel) {
    TRY(const std::vector<std::uint16_t> codes, panel::key_codes(panel.keys));
    const panel::KeyRequest request{panel.device, codes};
    return std::make_unique<panel::ButtonPanel>([request] { return panel::open_key_lines(request); },
                                                panel.keys.size(), times_of(panel));
}

std::unique_ptr<panel::Panel> make_buttons(const settings::PanelSettings& panel) {
    const panel::LineRequest request{.chip = panel.chip,
                                     .lines = panel.lines,
                                     .bias = panel.bias,
                                     .active_low = panel.active_low,
                                     .lamps = panel.lamps};
    return std::make_unique<panel::ButtonPanel>([request] { return panel::open_gpio_lines(request); },
                                                panel.lines.size(), times_of(panel));
}

Result<std::unique_ptr<panel::Panel>>
make_panel(const settings::Settings& settings, std::optional<Nanoseconds> press_every, MonotonicTime start) {
    if (press_every) {
        return std::make_unique<panel::ScriptedPanel>(
            std::vector<panel::PanelPress>{
                {*press_every / 2, settings::button_of(settings::Command::NextArtifact)}},
            *press_every, start);
    }
    if (settings.panel.kind == settings::PanelKind::Gpio) {
        return make_buttons(settings.panel);
    }
    if (settings.panel.kind == settings::PanelKind::Keys) {
        return make_keys(settings.panel);
    }
    std::vector<panel::PanelPress> script;
    for (const settings::ScriptedPress& press : settings.panel.script) {
        script.push_back({nanoseconds(press.at_s), press.button});
    }
    return std::make_unique<panel::ScriptedPanel>(std::move(script), nanoseconds(settings.panel.repeat_s),
                                                  start);
}

tags::TagSetUp tag_set_up(const settings::Settings& settings) {
    const settings::CameraSettings& camera = settings.camera;
    tags::TagSetUp set_up{.camera = camera.pinhole,
                          .table_from_camera = camera.table_from_camera,
                          .tags = {},
                          .readout_s = 1e-3 * camera.rolling_shutter_ms,
                          .lamp = std::nullopt};
    if (settings.torch.by_camera()) {
        const settings::TagSettings& tag = settings.torch.tag;
        set_up.lamp = tags::PropTag{tag.id, tag.size_m, settings::prop_from_tag(tag)};
    }
    for (const settings::TagSettings& tag : camera.tag) {
        set_up.tags.push_back({tag.id, tag.size_m, settings::prop_from_tag(tag)});
    }
    return set_up;
}

visitor::VisitorSetUp visitor_set_up(const settings::Settings& settings) {
    visitor::VisitorSetUp set_up{settings.camera.pinhole, settings.camera.table_from_camera, {}};
    set_up.zone.table_size_m = {settings.table.width_m, settings.table.depth_m};
    return set_up;
}

drift::DriftSetUp drift_set_up(const settings::Settings& settings) {
    drift::DriftSetUp set_up{
        drift::mark_places(settings), {}, settings.calibration.folder / drift::drift_file};
    for (const settings::TagSettings& tag : settings.camera.tag) {
        set_up.moving_tags.push_back(tag.id);
    }
    if (settings.torch.by_camera()) {
        set_up.moving_tags.push_back(settings.torch.tag.id);
    }
    return set_up;
}

/// Adds the camera, and the users of its frames.
void add_camera(show::Inputs& inputs, const settings::Settings& settings, const scene::DevicePlan& plan) {
    std::vector<camera::FrameUse> uses;
    if (plan.tags) {
        inputs.tags = std::make_unique<tags::TagTracker>(tag_set_up(settings));
        uses.emplace_back([&tags = *inputs.tags](const camera::CameraFrame& frame) { tags.use(frame); });
    }
    if (plan.visitor) {
        inputs.visitor = std::make_unique<visitor::VisitorTracker>(visitor_set_up(settings));
        uses.emplace_back(
            [&visitor = *inputs.visitor](const camera::CameraFrame& frame) { visitor.use(frame); });
    }
    if (plan.drift) {
        inputs.drift = std::make_unique<drift::DriftWatch>(drift_set_up(settings));
        uses.emplace_back([&drift = *inputs.drift](const camera::CameraFrame& frame) { drift.use(frame); });
    }
    if (!uses.empty() && plan.panel) {
        inputs.viewfinder = std::make_unique<show::Viewfinder>(settings);
        uses.emplace_back(
            [&viewfinder = *inputs.viewfinder](const camera::CameraFrame& frame) { viewfinder.use(frame); });
    }
    if (!uses.empty()) {
        inputs.camera = make_camera(settings.camera, std::move(uses));
    }
}

} // namespace

display::OutputRequest output_request(const settings::Settings& settings) {
    const settings::DisplaySettings& display = settings.display;
    const settings::Stereo stereo = settings::stereo_of(settings);
    const bool in_turn = stereo == settings::Stereo::FrameSequential;
    display::OutputRequest request;
    request.connector = or_any(display.connector);
    request.width = display.mode.width;
    request.height = display.mode.height;
    request.refresh_hz = display.mode.refresh_hz;
    request.force = display.force;
    request.picture_width = settings.projector.pinhole.width;
    request.picture_height = settings.projector.pinhole.height;
    request.picture_hz = (in_turn ? 2.0 : 1.0) * settings.projector.refresh_hz; // each eye's pictures
    request.eyes = eye_layout(stereo);
    request.fast = in_turn;
    return request;
}

Result<std::unique_ptr<display::Display>> make_display(const settings::Settings& settings, bool headless) {
    if (!headless && settings.display.kind == settings::DisplayKind::Kms) {
        return display::KmsDisplay::create(or_any(settings.display.card), output_request(settings));
    }
    const PixelSize picture = scene::stereo_layout(settings).display;
    return display::SurfacelessDisplay::create(picture.width, picture.height);
}

display::OutputRequest screen_request(const settings::Settings& settings) {
    const settings::ScreenSettings& screen = settings.screen;
    const settings::Stereo stereo = settings::screen_stereo_of(settings);
    const bool in_turn = stereo == settings::Stereo::FrameSequential;
    display::OutputRequest request;
    request.connector = or_any(screen.connector);
    request.picture_width = screen.width;
    request.picture_height = screen.height;
    request.picture_hz = (in_turn ? 2.0 : 1.0) * screen.refresh_hz; // each eye's pictures
    request.eyes = eye_layout(stereo);
    request.fast = in_turn;
    return request;
}

Result<std::unique_ptr<display::Display>> make_screen(const settings::Settings& settings,
                                                      display::Display& projector) {
    if (auto* const on_card = dynamic_cast<display::KmsDisplay*>(&projector)) {
        return display::KmsDisplay::create_beside(*on_card, or_any(settings.screen.card),
                                                  screen_request(settings));
    }
    const settings::ScreenSettings& screen = settings.screen;
    const PixelSize picture =
        scene::stereo_layout(scene::flat_screen(screen.corners_m, screen.width, screen.height).pinhole,
                             settings::screen_stereo_of(settings))
            .display;
    return display::SurfacelessDisplay::create(picture.width, picture.height);
}

Result<std::unique_ptr<tracker::PacketRecorder>> make_recorder(settings::TrackerKind kind,
                                                               const std::filesystem::path& path) {
    if (!has_packets(kind)) {
        return fail(ErrorKind::BadConfiguration, "record.no_packets",
                    "tracker.kind is \"{}\", which has no packets to record; allowed are \"usb\" and "
                    "\"spacemouse\"",
                    settings::name_of(kind));
    }
    TRY(GrowingFile file, GrowingFile::create(path));
    const std::string about = fmt::format("FrustumScreen {}, recorded from {:%Y-%m-%d %H:%M:%S} UTC on",
                                          project_version(), fmt::gmtime(std::time(nullptr)));
    return std::make_unique<tracker::PacketRecorder>(std::move(file), about, monotonic_now());
}

std::unique_ptr<sound::Sound> make_sound(const settings::SoundSettings& settings) {
    if (settings.kind == settings::SoundKind::None) {
        return nullptr;
    }
    return std::make_unique<sound::DeviceSound>(
        [device = settings.device] { return sound::open_alsa(device); });
}

camera::CameraRequest camera_request(const settings::CameraSettings& settings) {
    camera::CameraRequest request{.device = settings.device,
                                  .width = settings.width,
                                  .height = settings.height,
                                  .rate_hz = settings.rate_hz,
                                  .exposure_ms = {},
                                  .gain = {},
                                  .white_balance_k = {}};
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

std::unique_ptr<camera::Camera> make_camera(const settings::CameraSettings& settings,
                                            std::vector<camera::FrameUse> uses) {
    const rlimit none{0, 0};
    static_cast<void>(::setrlimit(RLIMIT_CORE, &none));             // a dump would contain a frame
    const double max_share = uses.empty() ? 1.0 : max_camera_share; // a calibration needs every frame
    const auto use_all = [uses = std::move(uses)](const camera::CameraFrame& frame) {
        for (const camera::FrameUse& use : uses) {
            use(frame);
        }
    };
    return std::make_unique<camera::V4l2Camera>(camera::kernel_v4l2_devices(), camera_request(settings),
                                                use_all, max_share);
}

Result<show::Inputs> make_inputs(const settings::Settings& settings, const scene::DevicePlan& plan,
                                 std::optional<Nanoseconds> press_every, MonotonicTime start,
                                 std::unique_ptr<tracker::PacketRecorder> recorder) {
    show::Inputs inputs;
    inputs.recorder = std::move(recorder);
    if (plan.tracker != settings::TrackerKind::None) {
        TRY(std::unique_ptr<tracker::Tracker> tracker, make_tracker(settings, start, inputs.recorder.get()));
        inputs.tracker = std::make_unique<tracking::RegisteredTracker>(std::move(tracker),
                                                                       settings::registration_of(settings));
    }
    add_camera(inputs, settings, plan);
    if (plan.panel) {
        TRY(inputs.panel, make_panel(settings, press_every, start));
    }
    return inputs;
}

} // namespace frustumscreen::programs

/// The kiosk's settings: one typed struct for each table of config/kiosk.toml, with defaults and units.
/// describe_settings.h has the purpose and the range of each.
///
/// Defaults config/kiosk.toml, the set-up as shipped, except the panel's script and the list of packs.
///
/// Frames   table T unless the name says otherwise; metres, degrees at this edge.
/// Ways     `parse_settings` checks syntax and types, `check` whether this exhibit can use them; the type
///          CheckedSettings is the proof that both passed.
/// Errors   one line: file, line, key, what was found, what is allowed.
/// Threads  values; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/registration.h"
#include "app/geometry/transform.h"
#include "app/pack/signature/signature.h"
#include "app/settings/calibration.h"
#include "app/settings/display_mode.h"
#include "app/settings/hours_settings.h"
#include "app/solid/polygon_mesh.h"
#include "app/torch/torch.h"
#include "firmware_host/base/line_bias.h"
#include "firmware_host/base/result.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::settings {

/// Layout of the pictures for the two eyes in the projector's picture. Off: one picture, for the point between the eyes.
enum class Stereo { Off, SideBySide, TopBottom, FrameSequential, Anaglyph };
[[nodiscard]] std::string_view name_of(Stereo stereo);
/// AsEye: the layout of EyeSettings. The others: as Stereo, for this output.
enum class OutputStereo { AsEye, Off, SideBySide, TopBottom, FrameSequential, Anaglyph };

struct ProjectorSettings {
    geometry::Pinhole pinhole{
        .width = 1920, .height = 1200, .fx = 3600.0, .fy = 3600.0, .cx = 960.0, .cy = 600.0}; ///< pixels
    /// Above the table's centre, looking straight down; the picture's right is +X, its top +Y.
    geometry::RigidTransform table_from_projector{glm::dquat(0.0, 1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, 1.5)};
    double refresh_hz = 60.0;
    OutputStereo stereo = OutputStereo::AsEye;
    double aperture_mm = 10.0; ///< diameter of the lens's opening: sets how fast focus is lost with depth
};

/// Kms: a projector on this machine's graphics card. Surfaceless: no screen.
enum class DisplayKind { Kms, Surfaceless };
[[nodiscard]] std::string_view name_of(DisplayKind kind);
struct DisplaySettings {
    DisplayKind kind = DisplayKind::Kms;
    std::string card = "any";
    std::string connector = "any";
    DisplayMode mode;
    bool force = false;
};

/// Frustum: stands on the table. Cube: all its edges are `base_m`. Solid: any convex shape with flat faces.
enum class PropKind { Frustum, Cube, Solid };
[[nodiscard]] std::string_view name_of(PropKind kind);
/// Table: upright, slid and turned about its axis. Hand: lifted, turned in any way.
enum class PropZone { Table, Hand };
struct PropSettings {
    PropKind kind = PropKind::Frustum;
    /// Side of the bottom square; of a solid: of the upright square column around its axis that holds it.
    double base_m = geometry::shipped_frustum.base_m;
    double top_m = geometry::shipped_frustum.top_m; ///< side of the top square; of a solid: `base_m`
    double height_m = geometry::shipped_frustum.height_m;
    PropZone zone = PropZone::Table; ///< how it moves

    // A solid:
    std::filesystem::path file{}; ///< an OBJ; resolved as the packs
    std::string shape_text{};     ///< the OBJ itself, where there is no `file`
    solid::LengthUnit unit = solid::LengthUnit::Millimetre;
    /// Names of faces that get a picture; empty: all, but for the one on which it stands in the zone Table.
    std::vector<std::string> lit_faces{};
    std::shared_ptr<const geometry::PropShape> shape{}; ///< as it was read; none of a frustum or a cube
    std::vector<std::string> notes{};                   ///< a sentence each on the shape, for its maker
};
/// A cube of the usual size, in the hand.
[[nodiscard]] PropSettings cube_settings(double edge_m = 0.16);
[[nodiscard]] geometry::PropShape make_prop(const PropSettings& prop);
/// The kind of prop that packs are baked for (`frustumscreen-bake --prop`); empty: any serves. A solid in the hand is
/// seen from all around, as a cube.
[[nodiscard]] std::string_view baked_kind(const PropSettings& prop);

struct TableSettings {
    double width_m = 0.8;
    double depth_m = 0.5;
};

/// The places of visitors' eyes, for the plan and for the bake's removal of hidden parts.
struct EyeSettings {
    glm::dvec3 default_m{0.0, -0.55, 0.50};
    double lowest_elevation_deg = 15.0;
    double nearest_m = 0.35;
    double farthest_m = 2.0;
    bool tracked = true;
    Stereo stereo = Stereo::Off;
    double interocular_mm = 63.0; ///< between the two pupils
};

/// Usb: a VIPER, PATRIOT, LIBERTY or HID tracker, whichever is connected. SpaceMouse: a substitute for a tracker.
/// None: the prop stands at the table's centre, its faces square to the table.
enum class TrackerKind { Simulated, Replay, Usb, SpaceMouse, None };
[[nodiscard]] std::string_view name_of(TrackerKind kind);
struct TrackerSettings {
    TrackerKind kind = TrackerKind::Simulated;
    std::uint64_t seed = 1;
    std::filesystem::path poses; ///< resolved against the settings file's folder
    std::string poses_key;       ///< where the settings name it, for messages
    double replay_speed = 1.0;
    glm::dvec3 hemisphere{1.0, 0.0, 0.0}; ///< in the tracker's axes
    geometry::Registration registration;  ///< of a device that reports in its own frame
    double display_latency_ms = 17.0;
};

/// A press by the scripted panel.
struct ScriptedPress {
    double at_s = 0.0;
    int button = 1;
};
/// Gpio: real buttons on a GPIO chip. Keys: keys of a keyboard, for a bench.
enum class PanelKind { Scripted, Gpio, Keys };
[[nodiscard]] std::string_view name_of(PanelKind kind);
[[nodiscard]] std::string_view name_of(LineBias bias);
struct PanelSettings {
    PanelKind kind = PanelKind::Scripted;
    std::vector<ScriptedPress> script;
    double repeat_s = 0.0; ///< 0: once
    std::string chip = "gpiochip0";
    std::vector<std::string> lines;
    LineBias bias = LineBias::PullUp;
    bool active_low = true;
    std::vector<std::string> lamps;
    std::string device;
    std::vector<std::string> keys;
    double debounce_ms = 30.0, stuck_s = 30.0;

    /// Number of real buttons.
    [[nodiscard]] std::size_t buttons() const {
        return kind == PanelKind::Gpio ? lines.size() : kind == PanelKind::Keys ? keys.size() : 0;
    }
};

struct ExhibitSettings {
    std::vector<std::filesystem::path> packs; ///< shown in this order; resolved as above
    std::string packs_key;                    ///< where the settings name them, for messages
    /// The installed set, which has priority over `packs`; resolved as above. Empty: none is looked for.
    std::filesystem::path library = "/var/lib/frustumscreen/library";
    std::string language = "en";
    bool captions = true;
    double caption_height_m = 0.010;
    double caption_brightness = 0.6; ///< share of the projector's light
    bool zone_frame = true;          ///< a frame of light shows the prop's zone
    bool guidance = true;            ///< a visitor who sees a dark face is told what to do
    std::filesystem::path words;     ///< the exhibit's own words; empty: none. Resolved as above
    bool table_pictures = true;      ///< pictures of the set lie on the table, to choose from
    double rest_s = 60.0; ///< time without visitors until artifacts come in turn, in the first language
    int memory_mb = 192;  ///< 10^6 bytes that loaded artifacts may take
    std::vector<pack::TrustedKey> keys; ///< the museum's: packs from a stick are signed with one of them
    pack::UnsignedPacks unsigned_packs = pack::UnsignedPacks::Refuse; ///< from a stick
    /// The importer's report on a stick (library/import_report.h); missing: there is none. Resolved as above.
    std::filesystem::path import_report = "/run/frustumscreen-import/report.json";
    /// Numbers of visits (counts/day_counts.h); missing folder: nothing is counted. Resolved as above.
    std::filesystem::path counts = "/var/lib/frustumscreen/counts";
};

/// Alsa: a sound card of this machine. It is opened only if there is something to say.
enum class SoundKind { None, Alsa };
[[nodiscard]] std::string_view name_of(SoundKind kind);
struct SoundHour {
    double from_h = 0.0;
    double gain_db = 0.0;
};
struct SoundSettings {
    SoundKind kind = SoundKind::Alsa;
    std::string device = "default";
    double gain_db = 0.0;
    std::vector<SoundHour> hours; ///< ascending; added to the gain, each until the next
};

/// V4l2: a camera with a kernel driver, usually at USB.
enum class CameraKind { None, V4l2 };
[[nodiscard]] std::string_view name_of(CameraKind kind);
/// A tag on the prop: its middle, and its rotation from lying flat with its top towards +Y.
struct TagSettings {
    int id = 0;
    double size_m = 0.03;     ///< side of the black square
    glm::dvec3 centre_m{0.0}; ///< frame of the prop
    double turn_deg = 0.0;    ///< counter-clockwise seen from above
    double lean_deg = 0.0; ///< before the turn: 0 lies, 90 stands and looks outwards, from where its foot was
};
/// The tag flat, then leaned, then turned, then moved.
[[nodiscard]] geometry::RigidTransform prop_from_tag(const TagSettings& tag);
struct CameraSettings {
    CameraKind kind = CameraKind::None;
    std::string device = "any";
    int width = 1280, height = 720;
    double rate_hz = 30.0;
    /// 0 for the exposure, a number below 0 for the gain and 0 for the white balance mean the camera's own value.
    double exposure_ms = 0.0;
    int gain = -1;
    int white_balance_k = 0;
    double rolling_shutter_ms = 0.0; ///< from the first row's exposure to the last one's; 0: all at once
    bool tags = false;               ///< the prop's second tracker
    bool visitor = false;            ///< the visitor's eye, with nothing on the head
    bool drift = false;              ///< checks that the picture lies where it was calibrated
    std::vector<TagSettings> tag;
    geometry::Pinhole pinhole{.width = 1280,
                              .height = 720,
                              .fx = 0.0,
                              .fy = 0.0,
                              .cx = 640.0,
                              .cy = 360.0};     ///< fx of 0: not measured
    geometry::RigidTransform table_from_camera; ///< identity: not measured
};

/// The source of the torch's pose. Tracker: station 3. Camera: a tag on a lamp. None: there is no torch.
enum class TorchSource { None, Tracker, Camera, Both };
[[nodiscard]] std::string_view name_of(TorchSource source);
/// Hand-held torches that throw the contents of the shown artifact's pack.
struct TorchSettings {
    TorchSource source = TorchSource::None;
    torch::Beam beam;
    double min_opening_deg = 8.0, max_opening_deg = 60.0; ///< by a twist of the torch
    double house_light = 1.0;                   ///< 0..1: the artifact's light while a torch is held
    geometry::RigidTransform sensor_from_torch; ///< of the tracker's sensor
    /// On the lamp, in the torch's frame: on its upper side, its top towards the light.
    TagSettings tag{
        .id = 586, .size_m = 0.04, .centre_m = {0.0, -0.025, -0.06}, .turn_deg = 0.0, .lean_deg = 90.0};

    [[nodiscard]] bool exists() const { return source != TorchSource::None; }
    [[nodiscard]] bool by_tracker() const {
        return source == TorchSource::Tracker || source == TorchSource::Both;
    }
    [[nodiscard]] bool by_camera() const {
        return source == TorchSource::Camera || source == TorchSource::Both;
    }
};

/// Windows that visitors pin onto the table: each shows what was seen through the prop.
inline constexpr std::size_t max_windows = 6;
struct WindowSettings {
    std::size_t count = 0; ///< that lie there at once, up to max_windows; 0: none can be pinned
    double width_m = 0.12, depth_m = 0.12; ///< of each
    bool live = false;                     ///< behaviours go on in a window; otherwise it is frozen

    [[nodiscard]] bool exist() const { return count > 0; }
};

/// A flat screen behind the table, the second output, and the room that it shows.
struct ScreenSettings {
    std::filesystem::path room; ///< empty: there is no screen
    /// The corners of its lit area: top left, top right, bottom right, bottom left, as people before it see it.
    std::array<glm::dvec3, 4> corners_m{
        {{-0.6, 0.7, 0.85}, {0.6, 0.7, 0.85}, {0.6, 0.7, 0.175}, {-0.6, 0.7, 0.175}}};
    int width = 1920, height = 1080; ///< pixels
    double refresh_hz = 60.0;
    std::string card = "any";
    std::string connector = "any";
    OutputStereo stereo = OutputStereo::AsEye;

    [[nodiscard]] bool exists() const { return !room.empty(); }
};

struct RenderSettings {
    double error_tolerance_px = 0.5;
    int highlight_code = 235; ///< sRGB code of the artifact's brightest places; 0: as in the pack
};

/// How the table is measured, where calibrations are kept (kept_calibrations.h), and which one is in use.
struct CalibrationSettings {
    std::filesystem::path folder = "/var/lib/frustumscreen/calibration";
    bool by_buttons = true;       ///< the staff may start a calibration with the buttons
    double sensor_height_m = 0.0; ///< above the prop's bottom; 0: as in tracker.sensor_from_prop
    int touches = 15;
    double block_m = 0.12;           ///< height to which boards raise the prop for half of the touches
    std::optional<Calibration> used; ///< already copied to `projector` and `tracker`
    std::string used_name;           ///< the file's name
    std::vector<std::string> unused; ///< why newer ones are not used, one line each
};

struct Settings {
    ProjectorSettings projector;
    DisplaySettings display;
    RenderSettings render;
    PropSettings prop;
    TableSettings table;
    EyeSettings eye;
    ScreenSettings screen;
    TorchSettings torch;
    WindowSettings windows;
    TrackerSettings tracker;
    CalibrationSettings calibration;
    PanelSettings panel;
    CameraSettings camera;
    ExhibitSettings exhibit;
    SoundSettings sound;
    HoursSettings hours;
};

/// The layout of the projector's picture.
[[nodiscard]] Stereo stereo_of(const Settings& settings);
/// The layout of the screen's picture.
[[nodiscard]] Stereo screen_stereo_of(const Settings& settings);

/// The tracker's registration, with that of the torch's sensor.
[[nodiscard]] inline geometry::Registration registration_of(const Settings& settings) {
    geometry::Registration registration = settings.tracker.registration;
    registration.sensor_from_torch = settings.torch.sensor_from_torch;
    return registration;
}

/// A prop in the hand has no zone on the table, and a prop that is not tracked never leaves its zone.
[[nodiscard]] inline bool shows_zone_frame(const Settings& settings) {
    return settings.exhibit.zone_frame && settings.prop.zone == PropZone::Table &&
           settings.tracker.kind != TrackerKind::None;
}

class CheckedSettings {
public:
    [[nodiscard]] const Settings& operator*() const { return settings_; }
    [[nodiscard]] const Settings* operator->() const { return &settings_; }

private:
    friend Result<CheckedSettings> kiosk_settings(std::string_view text, const std::filesystem::path& file);
    friend Result<CheckedSettings> parse_settings(std::string_view text, const std::filesystem::path& file);
    explicit CheckedSettings(Settings settings) : settings_(std::move(settings)) {}
    Settings settings_;
};

[[nodiscard]] Result<CheckedSettings> load_settings(const std::filesystem::path& file);
/// The same, from text already read. The newest kept calibration that is whole and fits these settings replaces
/// their values of projector and tracker.
[[nodiscard]] Result<CheckedSettings> kiosk_settings(std::string_view text,
                                                     const std::filesystem::path& file);
/// Ignores calibrations. `file` names the text in messages, and relative paths start at its folder.
[[nodiscard]] Result<CheckedSettings> parse_settings(std::string_view text,
                                                     const std::filesystem::path& file);

} // namespace frustumscreen::settings

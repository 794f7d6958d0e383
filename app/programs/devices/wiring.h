/// The only module that names concrete devices.
///
/// Threads  the render thread: the display's context becomes current on it.
/// Errors   an unreadable pose file or recording, packet recording from a tracker without packets, no OpenGL
///          ES, a display that this build lacks.
#pragma once

#include "app/scene/device_plan.h"
#include "app/settings/settings.h"
#include "app/show/inputs.h"
#include "firmware_host/base/result.h"
#include "firmware_host/camera/camera.h"
#include "firmware_host/display/display.h"
#include "firmware_host/display/kms_mode.h"
#include "firmware_host/tracker/packet_recorder.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace frustumscreen::programs {

/// The display's picture has the size that the layout of the eyes' pictures has (app/scene/stereo.h).
[[nodiscard]] Result<std::unique_ptr<display::Display>> make_display(const settings::Settings& settings,
                                                                     bool headless);
[[nodiscard]] display::OutputRequest output_request(const settings::Settings& settings);
/// The screen behind the table, beside the projector's display, which `make_display` has made. The settings must have one.
[[nodiscard]] Result<std::unique_ptr<display::Display>> make_screen(const settings::Settings& settings,
                                                                    display::Display& projector);
[[nodiscard]] display::OutputRequest screen_request(const settings::Settings& settings);

/// Creates a new file for the tracker's packets.
[[nodiscard]] Result<std::unique_ptr<tracker::PacketRecorder>>
make_recorder(settings::TrackerKind kind, const std::filesystem::path& path);
/// Opens only the devices of the plan. `press_every`: interval of presses of 'next artifact', in place of the
/// panel's script. `recorder`, if any, gets the tracker's packets.
[[nodiscard]] Result<show::Inputs> make_inputs(const settings::Settings& settings,
                                               const scene::DevicePlan& plan,
                                               std::optional<Nanoseconds> press_every, MonotonicTime start,
                                               std::unique_ptr<tracker::PacketRecorder> recorder = nullptr);

/// nullptr: the settings switch sound off.
[[nodiscard]] std::unique_ptr<sound::Sound> make_sound(const settings::SoundSettings& settings);

[[nodiscard]] camera::CameraRequest camera_request(const settings::CameraSettings& settings);
/// Limit of the camera's thread while the exhibit runs, decoding included, as a share of one core; frames are
/// skipped to stay within it.
inline constexpr double max_camera_share = 0.25;
/// Starts the camera's thread, which passes each frame to all uses in turn, and stays within its share of a
/// core if there are uses. The settings must have a camera. The process writes no core dumps from then on.
[[nodiscard]] std::unique_ptr<camera::Camera> make_camera(const settings::CameraSettings& settings,
                                                          std::vector<camera::FrameUse> uses = {});

} // namespace frustumscreen::programs

/// The one place that names concrete devices.
///
/// Threads  the render thread: the display's context becomes current on it.
/// Errors   a pose file or recording that cannot be read, a recording of a tracker that has no packets, no
///          OpenGL ES, a display that this build does not have.
#pragma once

#include "app/scene/device_plan.h"
#include "app/settings/settings.h"
#include "app/show/inputs.h"
#include "firmware_host/base/result.h"
#include "firmware_host/camera/camera.h"
#include "firmware_host/display/display.h"
#include "firmware_host/tracker/packet_recorder.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace frustumscreen {

[[nodiscard]] Result<std::unique_ptr<Display>> make_display(const Settings& settings, bool headless);

/// A new file for the tracker's packets.
[[nodiscard]] Result<std::unique_ptr<PacketRecorder>> make_recorder(TrackerKind kind,
                                                                    const std::filesystem::path& path);
/// Opens what the plan has and nothing else. `press_every`: presses 'next artifact' this often in place of
/// the panel's script. `recorder`, if any, gets the tracker's packets.
[[nodiscard]] Result<Inputs> make_inputs(const Settings& settings, const DevicePlan& plan,
                                         std::optional<Nanoseconds> press_every, MonotonicTime start,
                                         std::unique_ptr<PacketRecorder> recorder = nullptr);

/// None: the settings switch it off.
[[nodiscard]] std::unique_ptr<Sound> make_sound(const SoundSettings& settings);

[[nodiscard]] CameraWish camera_wish(const CameraSettings& settings);
/// Of one core, that the camera's thread takes at most while the exhibit runs, decoding and all: frames are passed over.
inline constexpr double most_camera_share = 0.25;
/// Starts its thread, which hands each frame to all uses, one after the other, and keeps its share of a core where there are uses. The settings have
/// one. The process dumps no core from then on.
[[nodiscard]] std::unique_ptr<Camera> make_camera(const CameraSettings& settings,
                                                  std::vector<FrameUse> uses = {});

} // namespace frustumscreen

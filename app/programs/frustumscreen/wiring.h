/// The one place that names concrete devices.
///
/// Threads  the render thread: the display's context becomes current on it.
/// Errors   a pose file or recording that cannot be read, a recording of what has no packets, no OpenGL ES, a
/// display that this build does not have.
#pragma once

#include "app/scene/scene_plan.h"
#include "app/settings/settings.h"
#include "app/show/inputs.h"
#include "firmware_host/base/result.h"
#include "firmware_host/display/display.h"
#include "firmware_host/tracker/packet_recorder.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace frustumscreen {

[[nodiscard]] Result<std::unique_ptr<Display>> make_display(const Settings& settings, bool headless);

/// A new file for the tracker's packets.
[[nodiscard]] Result<std::unique_ptr<PacketRecorder>> make_recorder(TrackerKind kind,
                                                                    const std::filesystem::path& path);
/// What the plan has, no more. `press_every`: press 'next artifact' evenly in place of the panel's script.
/// `recorder`, if any, has the tracker's packets.
[[nodiscard]] Result<Inputs> make_inputs(const Settings& settings, const DevicePlan& plan,
                                         std::optional<Nanoseconds> press_every, MonotonicTime start,
                                         std::unique_ptr<PacketRecorder> recorder = nullptr);

} // namespace frustumscreen

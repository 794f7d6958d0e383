/// The pictures of the screen behind the table for the frames of a pose file.
///
/// Frames   table T, metres: that of the hit points too.
/// Threads  the main one.
/// Errors   the settings have no screen; as RoomShow; the folder or a file cannot be written.
#pragma once

#include "app/programs/frustumscreen/render/eye_choice.h"
#include "app/settings/settings.h"
#include "app/tracking/tracked_state.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <span>
#include <string>

namespace frustumscreen::programs {

struct ScreenRequest {
    std::string eye; ///< as choose_eye
    int width = 0;   ///< of the pictures; 0: the settings'
    int height = 0;
    bool hit_points = false; ///< writes frame_00000.pfm too
    std::filesystem::path out;
};
/// Writes frame_00000.png ... and frames.csv. The room's objects begin to move with the first frame.
[[nodiscard]] Result<void> write_screen_pictures(const settings::Settings& settings,
                                                 const ScreenRequest& request,
                                                 std::span<const tracking::TrackedState> frames);

} // namespace frustumscreen::programs

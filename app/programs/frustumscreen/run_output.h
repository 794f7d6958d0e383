/// The output of a run: pictures, poses, frames and sound in a folder, and a report on standard output.
///
/// Threads  the render thread, when the loop is over.
/// Errors   a file cannot be written; the files before it are complete.
#pragma once

#include "app/programs/frustumscreen/run_request.h"
#include "app/show/run_loop.h"
#include "firmware_host/base/result.h"
#include "firmware_host/sound/sound.h"

#include <filesystem>

namespace frustumscreen::programs {

/// Writes frame_00000.png ..., with a screen screen_00000.png ... beside them, poses.csv with their poses, frames.csv
/// with every frame of the run, and sound.wav if `sound` recorded it. Removes the visitor's cameras that an earlier
/// call of render left there.
[[nodiscard]] Result<void> write_output(const std::filesystem::path& folder, const show::LoopResult& result,
                                        const sound::Sound* sound);

void report(const RunRequest& request, const show::LoopResult& result);

} // namespace frustumscreen::programs

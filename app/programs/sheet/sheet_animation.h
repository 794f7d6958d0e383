/// A short looping animation of the visitor's view, as animated WebP.
///
/// The camera is at the visitor's eye and looks at the middle of the prop's places, so the prop's movement is
/// visible. It plays forwards and backwards, and thus loops without a jump; frames that close a loop by
/// themselves only play forwards.
///
/// Library  libwebp's WebPAnimEncoder.
/// Errors   an unreadable picture; the encoder has no memory.
/// Threads  one; the visitor's views use all cores inside.
#pragma once

#include "app/programs/sheet/sheet_frames.h"
#include "app/settings/settings.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <functional>
#include <vector>

namespace frustumscreen::programs {

struct AnimationOptions {
    int width = 560;
    int height = 350;
    float quality = 86.0F; ///< 0..100
    bool lossless = false;
    bool closed = false; ///< the last frame leads to the first: play forwards only
};

[[nodiscard]] Result<Bytes> visitor_animation(const settings::Settings& settings,
                                              const std::vector<SheetFrame>& frames,
                                              const AnimationOptions& options,
                                              const std::function<void(std::size_t, std::size_t)>& progress);

} // namespace frustumscreen::programs

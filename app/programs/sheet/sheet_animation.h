/// A short looping animation of the visitor's view, as animated WebP.
///
/// The camera stands at the visitor's eye and keeps looking at the middle of the places where the prop is, so
/// that the prop is seen to move. It plays forwards and backwards, so that it loops without a jump; frames that close a
/// loop by themselves play forwards alone.
///
/// Library  libwebp's WebPAnimEncoder.
/// Errors   a picture that cannot be read; the encoder has no memory.
#pragma once

#include "app/programs/sheet/sheet_frames.h"
#include "app/settings/settings.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <functional>
#include <vector>

namespace frustumscreen {

struct AnimationOptions {
    int width = 560;
    int height = 350;
    float quality = 86.0F; ///< 0..100
    bool lossless = false;
    bool closed = false; ///< the last frame leads to the first: it plays forwards alone
};

[[nodiscard]] Result<Bytes> visitor_animation(const Settings& settings, const std::vector<SheetFrame>& frames,
                                              const AnimationOptions& options,
                                              const std::function<void(std::size_t, std::size_t)>& progress);

} // namespace frustumscreen

/// The contact sheet: for each frame the projector's picture, around the prop or the whole of it, and beside it the visitor's
/// view.
///
/// Threads  one; the visitor's views use all cores inside.
/// Errors   a picture that cannot be read.
#pragma once

#include "app/image/image.h"
#include "app/programs/sheet/sheet_frames.h"
#include "app/settings/settings.h"
#include "app/typography/text_image.h"
#include "firmware_host/base/result.h"

#include <functional>
#include <string>
#include <vector>

namespace frustumscreen {

struct SheetOptions {
    std::string title = "FrustumScreen";
    int columns = 0; ///< of frames; 0 = one for up to three frames, else two
    bool whole_table =
        false; ///< all that is projected, in place of what is projected on the prop and around it
};

/// `progress(done, all)` after each frame.
[[nodiscard]] Result<Image8> contact_sheet(const Settings& settings, const std::vector<SheetFrame>& frames,
                                           const SheetOptions& options, const Typesetter& typesetter,
                                           const std::function<void(std::size_t, std::size_t)>& progress);

} // namespace frustumscreen

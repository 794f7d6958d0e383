/// The contact sheet: for each frame the projector's picture, whole or around the prop, next to the visitor's
/// view.
///
/// Threads  one; the visitor's views use all cores internally.
/// Errors   an unreadable picture.
#pragma once

#include "app/image/image.h"
#include "app/programs/sheet/sheet_frames.h"
#include "app/settings/settings.h"
#include "app/typography/text_image.h"
#include "firmware_host/base/result.h"

#include <functional>
#include <string>
#include <vector>

namespace frustumscreen::programs {

struct SheetOptions {
    std::string title = "FrustumScreen";
    int columns = 0;          ///< frames in a row; 0: one for up to three frames, otherwise two
    bool whole_table = false; ///< the whole projected picture instead of the part around the prop
};

/// Calls `progress(done, all)` after each frame.
[[nodiscard]] Result<image::Image8>
contact_sheet(const settings::Settings& settings, const std::vector<SheetFrame>& frames,
              const SheetOptions& options, const typography::Typesetter& typesetter,
              const std::function<void(std::size_t, std::size_t)>& progress);

} // namespace frustumscreen::programs

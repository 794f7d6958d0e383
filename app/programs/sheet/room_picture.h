/// One large picture of the exhibit: the table in its room, the projector's picture, the visitor's view.
///
/// Threads  one; the views use all cores inside.
/// Errors   an unreadable picture.
#pragma once

#include "app/image/image.h"
#include "app/programs/sheet/sheet_frames.h"
#include "app/settings/settings.h"
#include "app/typography/text_image.h"
#include "firmware_host/base/result.h"

namespace frustumscreen::programs {

[[nodiscard]] Result<image::Image8> room_picture(const settings::Settings& settings, const SheetFrame& frame,
                                                 const typography::Typesetter& typesetter);

} // namespace frustumscreen::programs

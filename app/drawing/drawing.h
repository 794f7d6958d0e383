/// Technical drawings for building an exhibit, made from its settings with the exhibit's own geometry.
///
/// Shape    SVG, to scale: printed at 100 % its lengths are those on the sheet. Dimensions in millimetres.
/// Threads  pure; any.
#pragma once

#include "app/settings/settings.h"

#include <string>
#include <string_view>

namespace frustumscreen::drawing {

/// A3: the table, the projector and its light, the tracker and the visitors' eyes, from the side and from
/// above. `name` names the settings.
[[nodiscard]] std::string table_sheet(const settings::Settings& settings, std::string_view name);

/// A3: the prop from the front and from above, one of its faces, and all of them unfolded.
[[nodiscard]] std::string prop_sheet(const settings::Settings& settings, std::string_view name);

/// The prop's faces unfolded in true size, with folds and glue tabs, to cut out; as large as necessary.
[[nodiscard]] std::string net_sheet(const settings::Settings& settings, std::string_view name);

/// A3: a holder for the prop, from above and in section.
[[nodiscard]] std::string holder_sheet(const settings::Settings& settings, std::string_view name);

} // namespace frustumscreen::drawing

/// Technical drawings for building an exhibit, made from its settings with the exhibit's own geometry.
///
/// Shape    SVG, to scale: printed at 100 % its lengths are those on the sheet. Dimensions in millimetres.
/// Threads  pure; any.
#pragma once

#include "app/settings/settings.h"

#include <glm/glm.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

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

/// A3: a torch from the side, from above and from the front, with the place of the tracker's sensor and of the camera's tag,
/// and the holder in which it hangs at the table's edge.
[[nodiscard]] std::string torch_sheet(const settings::Settings& settings, std::string_view name);

/// An object of the room behind the screen as it is drawn; table frame.
struct DrawnObject {
    std::string name;
    std::vector<glm::dvec2> foot_m;   ///< corners of its box from above
    double low_m = 0.0, high_m = 0.0; ///< its box's, along Z
    glm::dvec3 place_m{0.0};
    double size_m = 0.0;
    bool moves = false;
};
/// A3: table, prop, screen and the room behind it from above and from the right, and a list of the objects. The settings
/// must have a screen.
[[nodiscard]] std::string room_sheet(const settings::Settings& settings, std::span<const DrawnObject> objects,
                                     std::string_view name);

} // namespace frustumscreen::drawing

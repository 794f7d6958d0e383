#include "app/exhibit/zone_frame.h"

#include "app/geometry/time_curves.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::exhibit {

namespace {

constexpr double begins_m = 0.015; ///< inside the border
constexpr double whole_m = 0.015;  ///< past the border
constexpr double lifted_m = 0.02;  ///< of the prop's bottom: counts as being on the border
constexpr double tilted = 0.17;    ///< radians, 10 degrees: counts as being on the border
constexpr double arm_m = 0.1;      ///< metres past the border for each radian of tilt

} // namespace

ZoneFrame::ZoneFrame(const settings::Rectangle& axis, double half_bottom_m, const glm::dvec2& table_m)
    : axis_(axis), shown_(axis.half_m.x > 0.0 || axis.half_m.y > 0.0) {
    const glm::dvec2 edge = 0.5 * table_m;
    const glm::dvec2 low = glm::max(axis.centre_m - axis.half_m - half_bottom_m, -edge);
    const glm::dvec2 high = glm::min(axis.centre_m + axis.half_m + half_bottom_m, edge);
    const glm::dvec2 middle = 0.5 * (low + high);
    const glm::dvec2 size = high - low;
    const double inset = 0.5 * zone_line_m;
    sides_ = {
        typography::TableRectangle{{middle.x, low.y + inset}, {size.x, zone_line_m}},
        typography::TableRectangle{{middle.x, high.y - inset}, {size.x, zone_line_m}},
        typography::TableRectangle{{low.x + inset, middle.y}, {zone_line_m, size.y - 2.0 * zone_line_m}},
        typography::TableRectangle{{high.x - inset, middle.y}, {zone_line_m, size.y - 2.0 * zone_line_m}}};
}

double ZoneFrame::share(const geometry::RigidTransform& table_from_prop) const {
    if (!shown_) {
        return 0.0;
    }
    const glm::dvec3 at = table_from_prop.translation;
    const glm::dvec2 past = glm::abs(glm::dvec2(at) - axis_.centre_m) - axis_.half_m;
    const double upright = std::clamp(table_from_prop.direction({0.0, 0.0, 1.0}).z, -1.0, 1.0);
    const double past_m = std::max({past.x, past.y, at.z - lifted_m, arm_m * (std::acos(upright) - tilted)});
    return geometry::ease((past_m + begins_m) / (begins_m + whole_m));
}

} // namespace frustumscreen::exhibit

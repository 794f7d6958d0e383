#include "tests/simulators/tags/skirt.h"

#include "app/tracking/pose_math.h"

#include <cmath>

namespace frustumscreen::simulators {

std::vector<tags::PropTag> tags_of(const Skirt& skirt) {
    // The strip starts at the foot and is as wide as a tag with its white margin: ten eighths of the black
    // square.
    const double strip = skirt.tag_m * 10.0 / 8.0;
    const double slope = glm::radians(skirt.slope_deg);
    const double out = 0.5 * skirt.base_m + 0.5 * strip * std::cos(slope);
    const double height = 0.5 * strip * std::sin(slope); // its outer edge lies on the table
    std::vector<tags::PropTag> tags;
    for (int side = 0; side < 4; ++side) {
        for (int k = 0; k < skirt.a_side; ++k) {
            const double along = skirt.base_m * ((k + 0.5) / skirt.a_side - 0.5);
            const geometry::RigidTransform turned{
                tracking::rotation_of({0.0, 0.0, glm::radians(90.0 * side)}), {}};
            const geometry::RigidTransform leaned{tracking::rotation_of({slope, 0.0, 0.0}),
                                                  {along, -out, height}};
            tags.push_back({skirt.first_id + static_cast<int>(tags.size()), skirt.tag_m, turned * leaned});
        }
    }
    return tags;
}

} // namespace frustumscreen::simulators

/// The tags of the figures and tests: a skirt around the prop's foot.
///
/// Frames   the prop's.
/// Threads  pure; any.
#pragma once

#include "app/tags/prop_tag.h"

#include <vector>

namespace frustumscreen::simulators {

struct Skirt {
    double base_m = 0.30;   ///< side of the prop's foot, which the skirt surrounds
    double tag_m = 0.03;    ///< side of a tag's black square
    double slope_deg = 0.0; ///< 0: flat on the table, 90: upright; it slopes outwards
    int a_side = 2;         ///< tags along each of the four sides, spread evenly
    int first_id = 0;
};

/// Ids continue from side to side: front (towards -Y), right, back, left.
[[nodiscard]] std::vector<tags::PropTag> tags_of(const Skirt& skirt);

} // namespace frustumscreen::simulators

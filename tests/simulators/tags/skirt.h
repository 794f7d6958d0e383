/// The tags that the figures and tests are made with: a skirt around the prop's foot.
///
/// Frames   the prop's.
/// Threads  pure; any.
#pragma once

#include "app/tags/prop_tag.h"

#include <vector>

namespace frustumscreen {

struct Skirt {
    double base_m = 0.30;   ///< side of the prop's foot, around which it lies
    double tag_m = 0.03;    ///< side of a tag's black square
    double slope_deg = 0.0; ///< 0: it lies flat on the table, 90: it stands; it falls outwards
    int a_side = 2;         ///< tags along each of the four sides, spread evenly
    int first_id = 0;
};

/// Ids go on from side to side: front (towards -Y), right, back, left.
[[nodiscard]] std::vector<PropTag> tags_of(const Skirt& skirt);

} // namespace frustumscreen

/// The tag sheet of the automatic calibration, an A3 sheet of AprilTags on which the prop stands, and a tag
/// for the prop's top.
///
/// The printed sheet (app/drawing/board/board_sheet.h) and the positions of the tags' corners come from this
/// one list, so they cannot differ.
/// Frames   the prop's: origin at the middle of its bottom, +Z up; the sheet is the plane z = 0, its upper
///          side the prop's back (+Y).
/// Units    metres.
/// Layout   ten tags as large as the space allows, 5 cm at most: in a ring around the prop, or, where there is
///          no space in front of the prop and behind it, in two columns beside it.
/// Errors   one sentence: the prop is too large or too small for the sheet.
/// Threads  pure; any.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/tags/prop_tag.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen::calibration {

struct Board {
    static constexpr glm::dvec2 size_m{0.420, 0.297}; ///< of the sheet

    geometry::FrustumSize prop;
    std::vector<tags::PropTag> tags; ///< the sheet's tags, then the tag of the prop's top

    [[nodiscard]] const tags::PropTag& top() const { return tags.back(); }
};

/// The sheet for a prop. A cube has a top as large as its base.
[[nodiscard]] Result<Board> board_for(const geometry::FrustumSize& prop);

} // namespace frustumscreen::calibration

/// The board of the automatic calibration: an A3 sheet of AprilTags on which the prop stands, and a tag for the prop's top.
///
/// One list for what is printed (app/drawing/board/board_sheet.h) and for where its corners are: a tag that moves here moves in both.
/// Frames   the prop's: origin at the middle of its bottom, +Z up; the sheet is the plane z = 0, its upper side the prop's back (+Y).
/// Units    metres.
/// Layout   ten tags, as large as they fit, up to 5 cm: in a ring around the prop, or where that leaves no room in front of it and behind
///          it, in two columns beside it.
/// Errors   one sentence: a prop that is too large or too small for it.
/// Threads  pure; any.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/tags/prop_tag.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen {

struct Board {
    static constexpr glm::dvec2 size_m{0.420, 0.297}; ///< the sheet's

    FrustumSize prop;
    std::vector<PropTag> tags; ///< of the sheet; then that of the prop's top

    [[nodiscard]] const PropTag& top() const { return tags.back(); }
};

/// A cube's base and top are alike.
[[nodiscard]] Result<Board> board_for(const FrustumSize& prop);

} // namespace frustumscreen

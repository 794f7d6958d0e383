/// The prop's faces laid out flat, as one piece to cut out and fold.
///
/// Frame    the net's plane: origin at the middle of the top face, x and y as the prop's; seen from outside
///          the prop. Metres.
/// Shape    the sides are attached to the top; a cube's bottom is attached to its side -Y. A frustum's net
///          has no bottom.
/// Threads  values; any.
#pragma once

#include "app/geometry/prop_shape.h"

#include <glm/glm.hpp>

#include <array>
#include <string>
#include <vector>

namespace frustumscreen::drawing {

struct NetFace {
    std::string name;                    ///< as in PropShape
    std::array<glm::dvec2, 4> corners{}; ///< in the order of PropFace::corners, counter-clockwise
};
/// A fold between two faces of the net.
struct NetFold {
    glm::dvec2 from{0.0};
    glm::dvec2 to{0.0};
};
/// A flap on a face's edge, glued to the adjacent face.
struct NetTab {
    std::array<glm::dvec2, 4> corners{}; ///< the first and the last one are the edge's
};
struct PropNet {
    std::vector<NetFace> faces;
    std::vector<NetFold> folds;
    std::vector<NetTab> tabs;
};

/// Of a frustum or a cube.
[[nodiscard]] PropNet unfold(const geometry::PropShape& prop);

} // namespace frustumscreen::drawing

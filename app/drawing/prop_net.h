/// The prop's faces laid out flat, as one piece to cut out and fold.
///
/// Frame    the net's plane: x and y as the prop's where the top face lies, which is the one that looks up most; seen from
///          outside the prop. Metres.
/// Shape    around the top lie its neighbours, around them theirs; a cube's bottom is attached to its side -Y. Faces that are
///          not lit are left out. A face that fits nowhere without lying on another begins a piece of its own.
/// Threads  values; any.
#pragma once

#include "app/geometry/prop_shape.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace frustumscreen::drawing {

struct NetFace {
    std::size_t face = 0;            ///< of PropShape::faces
    std::string name;                ///< as there
    std::vector<glm::dvec2> corners; ///< in the order of PropFace::corners, counter-clockwise
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
    std::size_t pieces = 1;
};

[[nodiscard]] PropNet unfold(const geometry::PropShape& prop);

} // namespace frustumscreen::drawing

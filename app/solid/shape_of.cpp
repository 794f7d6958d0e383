#include "app/solid/shape_of.h"

namespace frustumscreen::solid {

namespace {

geometry::PropFace lit_face(const SolidFace& face) {
    geometry::PropFace lit{.name = face.name, .plane = face.plane, .corners = {}};
    for (const glm::dvec3& corner : face.corners) {
        lit.corners.push_back(corner);
    }
    return lit;
}

} // namespace

geometry::PropShape shape_of(const Solid& solid, Underside underside) {
    geometry::PropShape shape;
    std::vector<geometry::Plane> dark;
    for (const SolidFace& face : solid.faces) {
        if (underside == Underside::Dark && is_underside(face)) {
            dark.push_back(face.plane);
        } else {
            shape.faces.push_back(lit_face(face));
            shape.bounds.push_back(face.plane);
        }
    }
    shape.bounds.insert(shape.bounds.end(), dark.begin(), dark.end());
    shape.corners = solid.corners;
    const SolidBox box = box_around(solid);
    shape.middle = 0.5 * (box.low + box.high);
    return shape;
}

} // namespace frustumscreen::solid

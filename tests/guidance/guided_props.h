/// Props for tests of guidance: a frustum on a table, a cube and solids in a hand, and a wedge.
#pragma once

#include "app/bench/truth/seeded_situations.h"
#include "app/exhibit/guidance_setup.h"
#include "tests/solid/example_props.h"

#include <numbers>
#include <string>

namespace frustumscreen::guidance {

inline GuidanceSetup frustum_setup() {
    return exhibit::guidance_setup(settings::Settings{});
}

inline GuidanceSetup cube_setup() {
    return exhibit::guidance_setup(bench::cube_in_hand());
}

/// One of config/prop_*.obj in the hand, under the projector of `cube_setup`.
inline GuidanceSetup solid_setup(const std::string& name) {
    GuidanceSetup setup = cube_setup();
    setup.prop = solid::example_prop(name);
    return setup;
}
inline GuidanceSetup solid_cube_setup() {
    return solid_setup("cube");
}
inline GuidanceSetup hexagon_setup() {
    return solid_setup("hexagon");
}
inline GuidanceSetup tetrahedron_setup() {
    return solid_setup("tetrahedron");
}
inline GuidanceSetup gem_setup() {
    return solid_setup("gem");
}

/// A wedge: all of its sides differ.
inline GuidanceSetup wedge_setup() {
    GuidanceSetup setup = frustum_setup();
    geometry::PropShape& prop = setup.prop;
    const glm::dmat4 shear(glm::dvec4(0.6, 0.0, 0.0, 0.0), glm::dvec4(0.1, 0.7, 0.0, 0.0),
                           glm::dvec4(0.15, -0.1, 0.9, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0));
    const auto moved = [&](const glm::dvec3& p) { return glm::dvec3(shear * glm::dvec4(p, 1.0)); };
    for (glm::dvec3& corner : prop.corners) {
        corner = moved(corner);
    }
    prop.middle = moved(prop.middle);
    for (geometry::PropFace& face : prop.faces) {
        for (glm::dvec3& corner : face.corners) {
            corner = moved(corner);
        }
        const auto& c = face.corners;
        const glm::dvec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
        face.plane = {normal, glm::dot(normal, c[0])};
    }
    return setup;
}

} // namespace frustumscreen::guidance

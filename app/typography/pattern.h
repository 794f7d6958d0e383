/// The alignment test picture: it shows what must coincide if projector, table and tracker agree.
///
/// The picture's outermost pixels and its centre; the table's outline and a grid every 5 cm with its
/// coordinates in cm; the prop's edges at the tracked pose, each face with its number (1 +X, 2 -X, 3 +Y, 4
/// -Y, 5 top), dim if the projector does not light the face.
///
/// Frames   table T; metres.
/// Threads  as Canvas.
/// Errors   none: parts behind the projector are left out.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"
#include "app/image/image.h"
#include "app/typography/text_image.h"

#include <glm/glm.hpp>

#include <span>
#include <string>

namespace frustumscreen::typography {

struct PatternScene {
    geometry::Pinhole projector;
    geometry::RigidTransform table_from_projector;
    glm::dvec2 table_size_m{0.0};
    geometry::PropShape prop;
};

/// The part that does not change while the prop moves.
[[nodiscard]] image::Image8 table_pattern(const PatternScene& scene, const Typesetter& typesetter);
[[nodiscard]] image::Image8 with_prop(const image::Image8& table, const PatternScene& scene,
                                      const geometry::RigidTransform& table_from_prop,
                                      const Typesetter& typesetter);
/// Adds lines for the staff below the pattern's own text; long lines are wrapped.
[[nodiscard]] image::Image8 with_lines(const image::Image8& pattern, std::span<const std::string> lines,
                                       const Typesetter& typesetter);

} // namespace frustumscreen::typography

/// Plans the crosses of a person's sightings: behind an upper corner of the resting prop, as seen from the
/// head.
///
/// Chosen   Candidates are combinations of corner, direction and distance whose cross lies in the picture, is
///          free of the words and lit past the prop, and whose line of sight is not blocked by the prop's
///          body. Crosses are chosen one after the other: the one whose line passes nearest to the head, at a
///          distance from the crosses before, so that the person aims without a step.
/// Frames   table T; prop P; pixels of the projector.
/// Units    metres.
/// Threads  pure; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"

#include <optional>
#include <vector>

namespace frustumscreen::calibration {

/// From a cross's middle to the end of its arms, on the table.
inline constexpr double cross_arm_m = 0.025;

/// The scene, constant while the sightings are made.
struct SightScene {
    geometry::Pinhole pinhole;
    geometry::RigidTransform table_from_projector;
    geometry::PropShape prop;
    glm::dvec3 usual_eye_m{0.0}; ///< default place of visitors' eyes
};
/// The pixel of a point in the table's frame; nothing if the projector does not light it.
[[nodiscard]] std::optional<glm::dvec2> pixel_of(const SightScene& scene, const glm::dvec3& point_m);
/// The place that leaves most space for words and crosses, upright: table_from_prop. Anywhere near it will do.
[[nodiscard]] geometry::RigidTransform first_place(const SightScene& scene);

struct WordsBox {
    glm::dvec2 low{0.0}, high{0.0};
    [[nodiscard]] glm::dvec2 size() const { return high - low; }
};

struct SightCross {
    glm::dvec3 tip_m{0.0};   ///< the prop's corner
    glm::dvec3 cross_m{0.0}; ///< the cross's middle
    glm::dvec2 pixel{0.0};   ///< the pixel that lights it
};

struct SightPlan {
    WordsBox words; ///< beside the prop, where the person sees them
    std::vector<SightCross> crosses;
};
/// Plans `count` crosses, or fewer if there is no space for more. `head_m`: the approximate place of the head;
/// ignored if it is nowhere near the table.
[[nodiscard]] SightPlan plan_sights(const SightScene& scene, const geometry::RigidTransform& table_from_prop,
                                    const glm::dvec3& head_m, std::size_t count);

} // namespace frustumscreen::calibration

/// Where the crosses of a person's sightings lie: behind an upper corner of the resting prop, as seen from where the head is.
///
/// Chosen   of corners, directions and distances those whose cross lies in the picture and free of the words, lit past the prop, and whose line
///          of sight leaves the corner free of the prop's body. Of them, one after the other, the one whose line passes nearest to the head,
///          and away from the crosses before: so that it is aimed at without a step.
/// Frames   table T; prop P; pixels of the projector.
/// Units    metres.
/// Threads  pure; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"

#include <optional>
#include <vector>

namespace frustumscreen {

/// From a cross's middle to the end of its arms, on the table.
inline constexpr double cross_arm_m = 0.025;

/// What stays as it is while the sightings are made.
struct SightScene {
    Pinhole pinhole;
    RigidTransform table_from_projector;
    PropShape prop;
    glm::dvec3 usual_eye_m{0.0}; ///< where visitors' eyes are while nobody knows better
};
/// Of a point of the table's space; nothing: the projector does not light it.
[[nodiscard]] std::optional<glm::dvec2> pixel_of(const SightScene& scene, const glm::dvec3& point_m);
/// Where the prop leaves most room for words and crosses, upright: table_from_prop. A wish: anywhere near it will do.
[[nodiscard]] RigidTransform wished_place(const SightScene& scene);

struct WordsBox {
    glm::dvec2 low{0.0}, high{0.0};
    [[nodiscard]] glm::dvec2 size() const { return high - low; }
};

struct SightCross {
    glm::dvec3 tip_m{0.0};   ///< the prop's corner
    glm::dvec3 cross_m{0.0}; ///< the cross's middle
    glm::dvec2 pixel{0.0};   ///< that lights it
};

struct SightPlan {
    WordsBox words; ///< beside the prop, where the person sees them
    std::vector<SightCross> crosses;
};
/// Fewer than `count` crosses where there is no room for more. `head_m`: about where the head is; one that is nowhere near the table is not believed.
[[nodiscard]] SightPlan plan_sights(const SightScene& scene, const RigidTransform& table_from_prop,
                                    const glm::dvec3& head_m, std::size_t count);

} // namespace frustumscreen

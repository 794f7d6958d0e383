/// The draws of the parts inside the prop, face by face.
///
/// Frames   the prop's, metres.
/// Threads  pure; any. Allocates nothing into a plan that `make_plan` made for the same inputs.
/// Errors   none: a face that no eye looks through, or that no light meets, shows nothing.
#pragma once

#include "app/scene/frame_plan.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace frustumscreen::scene {

/// Values of one frame that faces and parts share.
struct SharedByParts {
    const geometry::PropShape& prop;
    const PlanView& view;
    glm::dmat4 projector_from_prop{1.0};
    glm::dmat4 clip_from_prop{1.0};
    glm::dvec3 projector_in_prop{0.0};
    geometry::RigidTransform prop_from_table = {};
    geometry::Box box = {}; ///< around all parts, prop frame; of parts that reach out of the prop, the prop's
    geometry::Box parts_box = {}; ///< around all parts
    bool one_part = true;
    bool beyond = false; ///< PlacedLevel::beyond, of a part

    [[nodiscard]] glm::dvec3 eye(std::size_t face) const {
        const std::size_t which = view.eyes_m.size() == 1 ? 0 : std::min(face, view.eyes_m.size() - 1);
        return prop_from_table.point(view.eyes_m[which]);
    }
};

[[nodiscard]] SharedByParts shared_by_all(const geometry::PropShape& prop, std::span<const Part> parts,
                                          const PlanView& view);

/// Points are planned as a relief that the processor draws.
[[nodiscard]] bool takes_relief_draw(const PlacedLevel& level);

/// Plans part by part, because the triangles that face the eye are found once for all faces that share the eye. Returns
/// the faces, as bits, through which an eye looks at a part, whether or not they show some of it.
[[nodiscard]] std::uint32_t plan_parts(std::span<const Part> parts, const SharedByParts& shared,
                                       FramePlan& plan);

} // namespace frustumscreen::scene

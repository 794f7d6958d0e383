/// Brightness where a ray meets the scene: a table, a white prop and its tags, under the room's light and a
/// projector's picture.
///
/// Frames   rays in the prop's frame, their hits in the table's frame.
/// Threads  pure; any.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/tags/prop_tag.h"
#include "firmware_host/tags/tag_picture.h"

#include <vector>

namespace frustumscreen::simulators {

struct SceneLight {
    double room = 0.6;    ///< of white paper, from the room's light; 1 is the camera's maximum
    double picture = 0.0; ///< the most that the projector's picture adds to that
    bool busy = false;    ///< the table is covered with small dark and bright squares; otherwise plain
};

class SceneSurfaces {
public:
    SceneSurfaces(geometry::PropShape prop, std::vector<tags::PropTag> tags, const SceneLight& light);

    /// Along the ray from `origin_m`; both in the table's frame.
    [[nodiscard]] double brightness(const glm::dvec3& origin_m, const glm::dvec3& direction,
                                    const geometry::RigidTransform& prop_from_table,
                                    const geometry::RigidTransform& table_from_prop) const;
    /// The table alone.
    [[nodiscard]] double table_brightness(const glm::dvec3& origin_m, const glm::dvec3& direction) const;
    /// Greatest distance of the prop or its tags from the prop's origin.
    [[nodiscard]] double radius_m() const { return radius_m_; }
    [[nodiscard]] const std::vector<tags::PropTag>& tags() const { return tags_; }

private:
    struct Printed {
        geometry::RigidTransform tag_from_prop;
        double module_m = 0.0;
        tags::TagModules modules{};
    };
    [[nodiscard]] double table_reflectance(const glm::dvec3& table_m) const;
    [[nodiscard]] double lit(double reflectance, const glm::dvec3& table_m) const;

    geometry::PropShape prop_;
    std::vector<tags::PropTag> tags_;
    std::vector<Printed> printed_;
    SceneLight light_;
    double radius_m_ = 0.0;
};

} // namespace frustumscreen::simulators

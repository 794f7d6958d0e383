/// The museum's light on an artifact: a soft dome, brighter above, and a broad key light from the upper left
/// of its front, shadowed by the artifact itself and by the table that it stands on (ambient occlusion).
///
/// Frame    box.
/// Threads  built on one; queried from any.
#pragma once

#include "assets_baked/bake/source_scene.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen::bake {

class MuseumLight {
public:
    /// `source` must outlive it.
    explicit MuseumLight(const SourceScene& source);
    /// Light on a point with this unit normal; 1 = an open surface facing the key light. Uses 96 rays.
    [[nodiscard]] float at(const glm::vec3& place, const glm::vec3& normal) const;
    /// True if none of these rays leaves the artifact, upwards or downwards, so that nobody sees the point.
    [[nodiscard]] bool is_hidden(const glm::vec3& place, const glm::vec3& normal) const;

private:
    const SourceScene& source_;
    std::vector<glm::vec3> directions_;
};

} // namespace frustumscreen::bake

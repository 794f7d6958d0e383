/// The museum's light on a mesh that is an artifact, or a part of one that shadows it.
///
/// A point of a part that is seen at rest has the light that the whole artifact has there, so that the whole and its parts
/// look the same. A point that the artifact hides at rest, as inside a closed lid, is seen only when a part has moved: it
/// has the light of its part alone.
///
/// Frames   box of the mesh; box of the whole, whose axes are the same.
/// Threads  built on one; queried from any.
#pragma once

#include "assets_baked/bake/museum_light.h"
#include "assets_baked/bake/source_scene.h"

#include <glm/glm.hpp>

#include <optional>

namespace frustumscreen::bake {

/// The place of a part's box in the box of the whole, at rest.
struct PlaceInWhole {
    const SourceScene* whole = nullptr; ///< never null; outlives what uses it
    glm::dvec3 origin{0.0};             ///< of the part's box, in the whole's
    double scale = 1.0;                 ///< length of the part's box unit, in the whole's
};

class PartLight {
public:
    /// `mesh` must outlive it. `place`: none for a mesh that is the whole.
    PartLight(const SourceScene& mesh, const std::optional<PlaceInWhole>& place);
    /// As MuseumLight::at, with place and normal in the mesh's box.
    [[nodiscard]] float at(const glm::vec3& place, const glm::vec3& normal) const;

private:
    MuseumLight alone_;
    std::optional<MuseumLight> at_rest_;
    glm::dvec3 origin_{0.0};
    double scale_ = 1.0;
};

} // namespace frustumscreen::bake

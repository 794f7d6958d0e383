/// The source surface for rays and nearest-point queries, in the box frame.
///
/// Frame    box. Two-sided unless requested otherwise; alpha MASK is cut at its cut-off, BLEND counts as
///          opaque (docs/conventions.md: the picture).
/// Threads  built on one; queried from any.
/// Library  Embree 3; rays in 32-bit floats over a box of size 1.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <glm/glm.hpp>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace frustumscreen::bake {

struct SurfaceHit {
    bool hit = false;
    float distance = 0.0F;
    std::uint32_t triangle = 0;
    float u = 0.0F, v = 0.0F; ///< barycentric weights of the triangle's second and third corner
    glm::vec3 point{0.0F};
    glm::vec3 normal{0.0F}; ///< unit geometric normal, counter-clockwise side
};

/// Sides that rays hit; the kiosk draws only a level's front faces.
enum class Sides { Both, Front };

class SourceScene {
public:
    /// `mesh` must outlive the scene. `points` are its positions in the box frame.
    SourceScene(const SourceMesh& mesh, std::span<const glm::dvec3> points, Sides sides = Sides::Both);
    ~SourceScene();
    SourceScene(const SourceScene&) = delete;
    SourceScene& operator=(const SourceScene&) = delete;

    /// First hit with near < distance < far; `direction` is unit.
    [[nodiscard]] SurfaceHit trace(const glm::vec3& origin, const glm::vec3& direction, float near = 0.0F,
                                   float far = 1e30F) const;
    /// Given a hit's distance, triangle, u and v, returns whether it counts. If not, the ray continues, also
    /// to other surfaces at the same distance.
    using Counts = std::function<bool(const SurfaceHit&)>;
    /// First hit that counts.
    [[nodiscard]] SurfaceHit trace(const glm::vec3& origin, const glm::vec3& direction,
                                   const Counts& counts) const;
    [[nodiscard]] bool occluded(const glm::vec3& origin, const glm::vec3& direction, float near,
                                float far) const;
    /// Nearest surface point within `reach`.
    [[nodiscard]] SurfaceHit nearest(const glm::vec3& point, float reach) const;
    /// The hit nearest to the point along the normal, within `reach` on either side, that faces the same way;
    /// if there is none, the nearest point of the surface.
    [[nodiscard]] SurfaceHit facing(const glm::vec3& point, const glm::vec3& normal, float reach) const;

    /// Base colour at a hit, linear light; alpha in w.
    [[nodiscard]] glm::vec4 colour(std::uint32_t triangle, float u, float v) const;
    [[nodiscard]] glm::vec4 colour(const SurfaceHit& hit) const { return colour(hit.triangle, hit.u, hit.v); }

    /// The colour that a layer of the mesh has there.
    [[nodiscard]] glm::vec4 colour(const SourceLayer& layer, const SurfaceHit& hit) const;

    [[nodiscard]] const SourceMesh& mesh() const;
    [[nodiscard]] const glm::vec3& corner(std::uint32_t triangle, int k) const;
    /// True if any material has a texture or the mesh has vertex colours, so that colour varies over the
    /// surface.
    [[nodiscard]] bool has_varying_colour() const;
    [[nodiscard]] bool has_front_only() const;

    struct Embree;

private:
    std::unique_ptr<Embree> embree_;
};

} // namespace frustumscreen::bake

/// A source mesh placed in the prop, as a target of Embree's rays. The truth and the ray-cast peer share one.
///
/// Frame    prop frame, metres; placed in 64-bit, Embree's copy is 32-bit (robust).
/// Threads  immutable once built; any.
#pragma once

#include "app/geometry/collineation.h"
#include "assets_baked/bake/source_mesh.h"
#include "assets_baked/bake/source_scene.h"
#include "firmware_host/base/result.h"

#include <embree3/rtcore.h>

#include <memory>

namespace frustumscreen::bench {

class TracedMesh {
public:
    /// Errors: no triangles; a placement that is not finite; Embree has no memory.
    [[nodiscard]] static Result<std::shared_ptr<const TracedMesh>>
    build(std::shared_ptr<const bake::SourceMesh> mesh, const glm::dmat4& prop_from_artifact,
          bake::Sides sides = bake::Sides::Both);
    /// Builds it on a device that other scenes use too, so that one of them may have it as an instance.
    [[nodiscard]] static Result<std::shared_ptr<const TracedMesh>>
    build_on(RTCDevice device, std::shared_ptr<const bake::SourceMesh> mesh,
             const glm::dmat4& prop_from_artifact, bake::Sides sides = bake::Sides::Both);

    [[nodiscard]] const bake::SourceMesh& mesh() const { return *mesh_; }
    /// The box of the triangles' corners, with a margin for float rounding.
    [[nodiscard]] const geometry::Box& box() const { return box_; }
    /// Rays pass through masked material, and through sides that were not requested.
    [[nodiscard]] RTCScene scene() const { return scene_.get(); }
    /// (t, u, v) of the ray on the triangle's plane in 64-bit; false if it is edge-on.
    [[nodiscard]] bool refine(std::uint32_t triangle, const glm::dvec3& origin, const glm::dvec3& direction,
                              glm::dvec3& t_u_v) const;

private:
    struct Release {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
        void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
    };

    TracedMesh() = default;
    void add_triangles();
    static void cut(const RTCFilterFunctionNArguments* arguments);
    [[nodiscard]] bool is_cut(std::uint32_t triangle, double u, double v) const;

    std::shared_ptr<const bake::SourceMesh> mesh_;
    std::vector<glm::dvec3> positions_; ///< prop frame
    geometry::Box box_;
    bake::Sides sides_ = bake::Sides::Both;
    std::unique_ptr<RTCDeviceTy, Release> device_;
    std::unique_ptr<RTCSceneTy, Release> scene_;
};

} // namespace frustumscreen::bench

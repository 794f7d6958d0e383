#include "app/bench/truth/traced_mesh.h"

#include "app/bench/truth/surface_colour.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace frustumscreen::bench {

bool TracedMesh::refine(std::uint32_t triangle, const glm::dvec3& origin, const glm::dvec3& direction,
                        glm::dvec3& t_u_v) const {
    const std::array<std::uint32_t, 3>& corners = mesh_->triangles[triangle];
    const glm::dvec3 along_u = positions_[corners[1]] - positions_[corners[0]];
    const glm::dvec3 along_v = positions_[corners[2]] - positions_[corners[0]];
    const glm::dvec3 normal = glm::cross(along_u, along_v);
    const double slope = glm::dot(direction, normal);
    if (std::abs(slope) < 1e-9 * glm::length(normal)) {
        return false;
    }
    const glm::dvec3 from_corner = origin - positions_[corners[0]];
    const double t = -glm::dot(from_corner, normal) / slope;
    const glm::dvec3 in_plane = from_corner + t * direction;
    const double square = glm::dot(normal, normal);
    const double u = glm::dot(glm::cross(in_plane, along_v), normal) / square;
    const double v = glm::dot(glm::cross(along_u, in_plane), normal) / square;
    // The triangle was found in float, so rounding may place the hit outside its edges.
    const double clamped_u = std::clamp(u, 0.0, 1.0);
    t_u_v = {t, clamped_u, std::clamp(v, 0.0, 1.0 - clamped_u)};
    return true;
}

bool TracedMesh::is_cut(std::uint32_t triangle, double u, double v) const {
    const bake::SourceMaterial& material = mesh_->materials[mesh_->triangle_materials[triangle]];
    return material.alpha_mask && surface_colour(*mesh_, triangle, u, v).alpha < material.alpha_cutoff;
}

/// Embree's filter, called before it accepts a hit.
void TracedMesh::cut(const RTCFilterFunctionNArguments* arguments) {
    const auto& traced = *static_cast<const TracedMesh*>(arguments->geometryUserPtr);
    for (unsigned lane = 0; lane < arguments->N; ++lane) {
        if (arguments->valid[lane] == 0) {
            continue;
        }
        const unsigned triangle = RTCHitN_primID(arguments->hit, arguments->N, lane);
        const glm::vec3 normal(RTCHitN_Ng_x(arguments->hit, arguments->N, lane),
                               RTCHitN_Ng_y(arguments->hit, arguments->N, lane),
                               RTCHitN_Ng_z(arguments->hit, arguments->N, lane));
        const glm::vec3 direction(RTCRayN_dir_x(arguments->ray, arguments->N, lane),
                                  RTCRayN_dir_y(arguments->ray, arguments->N, lane),
                                  RTCRayN_dir_z(arguments->ray, arguments->N, lane));
        const bool from_behind = traced.sides_ == bake::Sides::Front && glm::dot(normal, direction) > 0.0F;
        if (from_behind || traced.is_cut(triangle, RTCHitN_u(arguments->hit, arguments->N, lane),
                                         RTCHitN_v(arguments->hit, arguments->N, lane))) {
            arguments->valid[lane] = 0;
        }
    }
}

void TracedMesh::add_triangles() {
    const std::unique_ptr<RTCGeometryTy, Release> geometry(
        rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), positions_.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh_->triangles.size()));
    if (vertices == nullptr || indices == nullptr) {
        return; // `build` queries rtcGetDeviceError
    }
    for (const glm::dvec3& position : positions_) {
        for (int axis = 0; axis < 3; ++axis) {
            *vertices++ = static_cast<float>(position[axis]);
        }
    }
    for (const std::array<std::uint32_t, 3>& triangle : mesh_->triangles) {
        indices = std::copy(triangle.begin(), triangle.end(), indices);
    }
    const bool masked = std::any_of(mesh_->materials.begin(), mesh_->materials.end(),
                                    [](const bake::SourceMaterial& material) { return material.alpha_mask; });
    if (masked || sides_ == bake::Sides::Front) {
        rtcSetGeometryUserData(geometry.get(), this);
        rtcSetGeometryIntersectFilterFunction(geometry.get(), cut);
    }
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene_.get(), geometry.get(), 0);
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_.get());
}

Result<std::shared_ptr<const TracedMesh>> TracedMesh::build(std::shared_ptr<const bake::SourceMesh> mesh,
                                                            const glm::dmat4& prop_from_artifact,
                                                            bake::Sides sides) {
    const std::unique_ptr<RTCDeviceTy, Release> device(rtcNewDevice(nullptr));
    return build_on(device.get(), std::move(mesh), prop_from_artifact, sides);
}

Result<std::shared_ptr<const TracedMesh>> TracedMesh::build_on(RTCDevice device,
                                                               std::shared_ptr<const bake::SourceMesh> mesh,
                                                               const glm::dmat4& prop_from_artifact,
                                                               bake::Sides sides) {
    if (!mesh || mesh->triangles.empty()) {
        return bad_input(
            "bench.no_triangles",
            "the mesh has no triangles to cast rays at; give the file that the pack was baked from");
    }
    std::shared_ptr<TracedMesh> traced(new TracedMesh());
    traced->mesh_ = std::move(mesh);
    traced->sides_ = sides;
    traced->positions_.reserve(traced->mesh_->positions.size());
    for (const glm::dvec3& position : traced->mesh_->positions) {
        traced->positions_.emplace_back(prop_from_artifact * glm::dvec4(position, 1.0));
    }
    geometry::Box box{glm::dvec3(std::numeric_limits<double>::infinity()),
                      glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (const std::array<std::uint32_t, 3>& triangle : traced->mesh_->triangles) {
        for (const std::uint32_t corner : triangle) {
            box.low = glm::min(box.low, traced->positions_[corner]);
            box.high = glm::max(box.high, traced->positions_[corner]);
        }
    }
    const double size = glm::distance(box.low, box.high);
    if (!std::isfinite(size)) {
        return bad_input("bench.placement_not_finite",
                         "the pack's placement does not map the mesh to finite points; bake the pack again");
    }
    traced->box_ = {box.low - 1e-4 * size, box.high + 1e-4 * size};
    rtcRetainDevice(device);
    traced->device_.reset(device);
    traced->scene_.reset(rtcNewScene(traced->device_.get()));
    traced->add_triangles();
    if (rtcGetDeviceError(traced->device_.get()) != RTC_ERROR_NONE) {
        return fail(ErrorKind::Internal, "bench.no_scene",
                    "Embree could not build the scene of the source mesh; free some memory");
    }
    return std::shared_ptr<const TracedMesh>(std::move(traced));
}

} // namespace frustumscreen::bench

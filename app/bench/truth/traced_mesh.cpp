#include "app/bench/truth/traced_mesh.h"

#include "app/bench/truth/surface_colour.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace frustumscreen {

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
    // The triangle was found in float: its edges may be missed by a rounding.
    const double clamped_u = std::clamp(u, 0.0, 1.0);
    t_u_v = {t, clamped_u, std::clamp(v, 0.0, 1.0 - clamped_u)};
    return true;
}

/// Embree asks before it accepts a hit: cut where the material's alpha is below its cut-off.
void TracedMesh::cut_masked(const RTCFilterFunctionNArguments* arguments) {
    const auto& mesh = *static_cast<const SourceMesh*>(arguments->geometryUserPtr);
    for (unsigned lane = 0; lane < arguments->N; ++lane) {
        if (arguments->valid[lane] == 0) {
            continue;
        }
        const unsigned triangle = RTCHitN_primID(arguments->hit, arguments->N, lane);
        const SourceMaterial& material = mesh.materials[mesh.triangle_materials[triangle]];
        const double u = RTCHitN_u(arguments->hit, arguments->N, lane);
        const double v = RTCHitN_v(arguments->hit, arguments->N, lane);
        if (material.alpha_mask && surface_colour(mesh, triangle, u, v).alpha < material.alpha_cutoff) {
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
        return; // `build` asks rtcGetDeviceError
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
                                    [](const SourceMaterial& material) { return material.alpha_mask; });
    if (masked) {
        rtcSetGeometryUserData(geometry.get(), const_cast<SourceMesh*>(mesh_.get()));
        rtcSetGeometryIntersectFilterFunction(geometry.get(), cut_masked);
    }
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene_.get(), geometry.get(), 0);
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_.get());
}

Result<std::shared_ptr<const TracedMesh>> TracedMesh::build(std::shared_ptr<const SourceMesh> mesh,
                                                            const glm::dmat4& prop_from_artifact) {
    if (!mesh || mesh->triangles.empty()) {
        return bad_input(
            "the mesh has no triangles to cast rays at; give the file that the pack was baked from");
    }
    std::shared_ptr<TracedMesh> traced(new TracedMesh());
    traced->mesh_ = std::move(mesh);
    traced->positions_.reserve(traced->mesh_->positions.size());
    for (const glm::dvec3& position : traced->mesh_->positions) {
        traced->positions_.emplace_back(prop_from_artifact * glm::dvec4(position, 1.0));
    }
    Box box{glm::dvec3(std::numeric_limits<double>::infinity()),
            glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (const std::array<std::uint32_t, 3>& triangle : traced->mesh_->triangles) {
        for (const std::uint32_t corner : triangle) {
            box.low = glm::min(box.low, traced->positions_[corner]);
            box.high = glm::max(box.high, traced->positions_[corner]);
        }
    }
    const double size = glm::distance(box.low, box.high);
    if (!std::isfinite(size)) {
        return bad_input("the pack's placement does not map the mesh to finite points; bake the pack again");
    }
    traced->box_ = {box.low - 1e-4 * size, box.high + 1e-4 * size};
    traced->device_.reset(rtcNewDevice(nullptr));
    traced->scene_.reset(rtcNewScene(traced->device_.get()));
    traced->add_triangles();
    if (rtcGetDeviceError(traced->device_.get()) != RTC_ERROR_NONE) {
        return fail(ErrorKind::Internal,
                    "Embree could not build the scene of the source mesh; free some memory");
    }
    return std::shared_ptr<const TracedMesh>(std::move(traced));
}

} // namespace frustumscreen

#include "assets_baked/bake/file_normals.h"

#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::bake {

namespace {

float cosine_of(double degrees) {
    return static_cast<float>(std::cos(degrees * std::numbers::pi / 180.0));
}

} // namespace

FileNormals::FileNormals(const SourceMesh& mesh, const BoxFrame& frame) : mesh_(mesh) {
    normals_.reserve(mesh.normals.size());
    for (const glm::vec3& normal : mesh.normals) {
        normals_.emplace_back(frame.turned_from_file * glm::dvec3(normal));
    }
}

glm::vec3 FileNormals::at(const SurfaceHit& hit, const glm::vec3& normal) const {
    static const float min_cosine = cosine_of(max_lean_deg);
    static const float min_agreement = cosine_of(60.0); // a hit on another side of an edge shows nothing here
    if (normals_.empty() || !hit.hit) {
        return normal;
    }
    const std::array<std::uint32_t, 3>& corners = mesh_.triangles[hit.triangle];
    const std::array<float, 3> weights{1.0F - hit.u - hit.v, hit.u, hit.v};
    glm::vec3 sum(0.0F);
    float side = 0.0F; // of the first corner's normal: some files have the other winding
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3& own = normals_[corners[k]];
        const float cosine = glm::dot(own, hit.normal);
        side = k == 0 ? cosine : side;
        if (std::abs(cosine) < min_cosine || cosine * side < 0.0F) {
            return normal;
        }
        sum += weights[k] * own;
    }
    const float length = glm::length(sum);
    if (!(length > 0.0F)) {
        return normal;
    }
    sum *= (glm::dot(sum, normal) < 0.0F ? -1.0F : 1.0F) / length;
    return glm::dot(sum, normal) < min_agreement ? normal : sum;
}

} // namespace frustumscreen::bake

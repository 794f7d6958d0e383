#include "assets_baked/bake/source_scene.h"

#include "assets_baked/bake/nearest_on_triangle.h"

#include <embree3/rtcore.h>

#include <cassert>
#include <cmath>

namespace frustumscreen::bake {

struct SourceScene::Embree {
    const SourceMesh* mesh = nullptr;
    std::vector<glm::vec3> positions; // box frame; one spare for Embree's 16-byte reads
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    bool varying_colour = false;
    bool front_only = false;
};

namespace {

float wrapped(float x, Wrap wrap) {
    switch (wrap) {
    case Wrap::Repeat:
        return x - std::floor(x);
    case Wrap::Mirror: {
        const float period = x - 2.0F * std::floor(x / 2.0F);
        return period <= 1.0F ? period : 2.0F - period;
    }
    case Wrap::Clamp:
        break;
    }
    return std::fmin(std::fmax(x, 0.0F), 1.0F);
}

int wrapped_texel(int i, int size, Wrap wrap) {
    if (wrap == Wrap::Repeat) {
        return ((i % size) + size) % size;
    }
    return std::min(std::max(i, 0), size - 1); // Mirror at its edge repeats the edge texel
}

/// Bilinear at the base level, filtered in linear light.
glm::vec4 sample(const SourceTexture& texture, const glm::vec2& uv) {
    const image::Image8& image = *texture.image;
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
        return glm::vec4(1.0F);
    }
    const float x = wrapped(uv.x, texture.wrap_u) * static_cast<float>(image.width) - 0.5F;
    const float y = wrapped(uv.y, texture.wrap_v) * static_cast<float>(image.height) - 0.5F;
    const int x0 = static_cast<int>(std::floor(x));
    const int y0 = static_cast<int>(std::floor(y));
    const float fx = x - static_cast<float>(x0);
    const float fy = y - static_cast<float>(y0);
    const std::array<float, 256>& linear = image::linear_from_srgb8();
    const auto texel = [&](int i, int j) {
        const glm::u8vec4 t = image.at(wrapped_texel(i, image.width, texture.wrap_u),
                                       wrapped_texel(j, image.height, texture.wrap_v));
        return glm::vec4(linear[t.x], linear[t.y], linear[t.z], static_cast<float>(t.w) / 255.0F);
    };
    const glm::vec4 top = glm::mix(texel(x0, y0), texel(x0 + 1, y0), fx);
    const glm::vec4 bottom = glm::mix(texel(x0, y0 + 1), texel(x0 + 1, y0 + 1), fx);
    return glm::mix(top, bottom, fy);
}

/// The mesh has texture coordinates.
glm::vec2 uv_at(const SourceMesh& mesh, std::uint32_t triangle, float u, float v) {
    const auto& corners = mesh.triangles[triangle];
    return mesh.uvs[corners[0]] * (1.0F - u - v) + mesh.uvs[corners[1]] * u + mesh.uvs[corners[2]] * v;
}

/// Lets a ray pass through a face that faces away from it.
void cut_back_faces(const RTCFilterFunctionNArguments* arguments) {
    const glm::vec3 normal(RTCHitN_Ng_x(arguments->hit, 1, 0), RTCHitN_Ng_y(arguments->hit, 1, 0),
                           RTCHitN_Ng_z(arguments->hit, 1, 0));
    const glm::vec3 direction(RTCRayN_dir_x(arguments->ray, 1, 0), RTCRayN_dir_y(arguments->ray, 1, 0),
                              RTCRayN_dir_z(arguments->ray, 1, 0));
    if (glm::dot(normal, direction) > 0.0F) {
        arguments->valid[0] = 0;
    }
}

/// Lets a ray pass where alpha MASK cuts, and through faces that are not drawn.
void cut(const RTCFilterFunctionNArguments* arguments) {
    assert(arguments->N == 1);
    const auto* scene = static_cast<const SourceScene*>(arguments->geometryUserPtr);
    if (scene->has_front_only()) {
        cut_back_faces(arguments);
    }
    const std::uint32_t triangle = RTCHitN_primID(arguments->hit, 1, 0);
    const SourceMesh& mesh = scene->mesh();
    const SourceMaterial& material = mesh.materials[mesh.triangle_materials[triangle]];
    if (!material.alpha_mask) {
        return;
    }
    const float u = RTCHitN_u(arguments->hit, 1, 0);
    const float v = RTCHitN_v(arguments->hit, 1, 0);
    if (scene->colour(triangle, u, v).w < material.alpha_cutoff) {
        arguments->valid[0] = 0;
    }
}

struct CountingContext : RTCIntersectContext {
    const SourceScene::Counts* counts = nullptr;
};

void leave_out(const RTCFilterFunctionNArguments* arguments) {
    const auto* context = static_cast<const CountingContext*>(arguments->context);
    SurfaceHit hit;
    hit.hit = true;
    hit.distance = RTCRayN_tfar(arguments->ray, 1, 0);
    hit.triangle = RTCHitN_primID(arguments->hit, 1, 0);
    hit.u = RTCHitN_u(arguments->hit, 1, 0);
    hit.v = RTCHitN_v(arguments->hit, 1, 0);
    if (!(*context->counts)(hit)) {
        arguments->valid[0] = 0;
    }
}

SurfaceHit first_hit(RTCScene scene, RTCIntersectContext& context, const glm::vec3& origin,
                     const glm::vec3& direction, float near, float far) {
    RTCRayHit query{};
    query.ray.org_x = origin.x;
    query.ray.org_y = origin.y;
    query.ray.org_z = origin.z;
    query.ray.dir_x = direction.x;
    query.ray.dir_y = direction.y;
    query.ray.dir_z = direction.z;
    query.ray.tnear = near;
    query.ray.tfar = far;
    query.ray.mask = 0xFFFFFFFFU;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return {};
    }
    const glm::vec3 normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    const float length = glm::length(normal);
    return {.hit = true,
            .distance = query.ray.tfar,
            .triangle = query.hit.primID,
            .u = query.hit.u,
            .v = query.hit.v,
            .point = origin + direction * query.ray.tfar,
            .normal = length > 0.0F ? normal / length : glm::vec3(0.0F)};
}

struct NearestQuery {
    const SourceScene* scene;
    glm::vec3 point;
    SurfaceHit best;
    float best_squared;
};

bool keep_nearest(RTCPointQueryFunctionArguments* arguments) {
    auto& query = *static_cast<NearestQuery*>(arguments->userPtr);
    const glm::vec3& a = query.scene->corner(arguments->primID, 0);
    const glm::vec3& b = query.scene->corner(arguments->primID, 1);
    const glm::vec3& c = query.scene->corner(arguments->primID, 2);
    const glm::vec2 weights = nearest_on_triangle(query.point, a, b, c);
    const glm::vec3 point = a + (b - a) * weights.x + (c - a) * weights.y;
    const glm::vec3 away = point - query.point;
    const float squared = glm::dot(away, away);
    if (!(squared < query.best_squared)) { // also rejects the NaN of a degenerate triangle
        return false;
    }
    query.best_squared = squared;
    query.best = {.hit = true,
                  .distance = std::sqrt(squared),
                  .triangle = arguments->primID,
                  .u = weights.x,
                  .v = weights.y,
                  .point = point,
                  .normal = {}};
    arguments->query->radius = query.best.distance;
    return true;
}

} // namespace

SourceScene::SourceScene(const SourceMesh& mesh, std::span<const glm::dvec3> points, Sides sides)
    : embree_(std::make_unique<Embree>()) {
    embree_->mesh = &mesh;
    embree_->positions.reserve(points.size() + 1);
    for (const glm::dvec3& p : points) {
        embree_->positions.emplace_back(p);
    }
    embree_->positions.emplace_back(0.0F);
    bool masked = false;
    embree_->varying_colour = !mesh.colours.empty() || mesh.materials.size() > 1;
    for (const SourceMaterial& material : mesh.materials) {
        masked = masked || material.alpha_mask;
        embree_->varying_colour = embree_->varying_colour || material.texture >= 0;
    }

    embree_->device = rtcNewDevice(nullptr);
    embree_->scene = rtcNewScene(embree_->device);
    rtcSetSceneFlags(embree_->scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                                                RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               embree_->positions.data(), 0, sizeof(glm::vec3), points.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                               sizeof(mesh.triangles[0]), mesh.triangles.size());
    embree_->front_only = sides == Sides::Front;
    if (masked || embree_->front_only) {
        rtcSetGeometryUserData(geometry, this);
        rtcSetGeometryIntersectFilterFunction(geometry, cut);
        rtcSetGeometryOccludedFilterFunction(geometry, cut);
    }
    rtcSetGeometryPointQueryFunction(geometry, keep_nearest);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(embree_->scene);
}

SourceScene::~SourceScene() {
    rtcReleaseScene(embree_->scene);
    rtcReleaseDevice(embree_->device);
}

SurfaceHit SourceScene::trace(const glm::vec3& origin, const glm::vec3& direction, float near,
                              float far) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    return first_hit(embree_->scene, context, origin, direction, near, far);
}

SurfaceHit SourceScene::trace(const glm::vec3& origin, const glm::vec3& direction,
                              const Counts& counts) const {
    CountingContext context;
    rtcInitIntersectContext(&context);
    context.filter = leave_out;
    context.counts = &counts;
    return first_hit(embree_->scene, context, origin, direction, 0.0F, 1e30F);
}

bool SourceScene::occluded(const glm::vec3& origin, const glm::vec3& direction, float near, float far) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tnear = near;
    ray.tfar = far;
    ray.mask = 0xFFFFFFFFU;
    rtcOccluded1(embree_->scene, &context, &ray);
    return ray.tfar < 0.0F;
}

SurfaceHit SourceScene::nearest(const glm::vec3& point, float reach) const {
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    RTCPointQuery query{point.x, point.y, point.z, 0.0F, reach};
    NearestQuery state{.scene = this, .point = point, .best = {}, .best_squared = reach * reach};
    rtcPointQuery(embree_->scene, &query, &context, nullptr, &state);
    if (state.best.hit) {
        const glm::vec3& a = corner(state.best.triangle, 0);
        const glm::vec3 normal =
            glm::cross(corner(state.best.triangle, 1) - a, corner(state.best.triangle, 2) - a);
        const float length = glm::length(normal);
        state.best.normal = length > 0.0F ? normal / length : glm::vec3(0.0F);
    }
    return state.best;
}

SurfaceHit SourceScene::facing(const glm::vec3& point, const glm::vec3& normal, float reach) const {
    const glm::vec3 origin = point + normal * reach;
    SurfaceHit best;
    float best_distance = reach;
    float near = 0.0F;
    for (int k = 0; k < 12; ++k) {
        const SurfaceHit hit = trace(origin, -normal, near, 2.0F * reach);
        if (!hit.hit) {
            break;
        }
        const float distance = std::abs(hit.distance - reach);
        // The side counts too: a triangle seen from behind is a candidate only if none faces this way.
        const float penalty = glm::dot(hit.normal, normal) > 0.0F ? 0.0F : 0.25F * reach;
        if (distance + penalty < best_distance) {
            best_distance = distance + penalty;
            best = hit;
        }
        near = hit.distance + 1e-6F + hit.distance * 1e-6F;
    }
    return best.hit ? best : nearest(point, 8.0F * reach);
}

glm::vec4 SourceScene::colour(std::uint32_t triangle, float u, float v) const {
    const SourceMesh& source = *embree_->mesh;
    const SourceMaterial& material = source.materials[source.triangle_materials[triangle]];
    const auto& corners = source.triangles[triangle];
    const float w = 1.0F - u - v;
    glm::vec4 result = material.base_colour;
    if (!source.colours.empty()) {
        result *=
            source.colours[corners[0]] * w + source.colours[corners[1]] * u + source.colours[corners[2]] * v;
    }
    if (material.texture >= 0 && !source.uvs.empty()) {
        result *= sample(source.textures[static_cast<std::size_t>(material.texture)],
                         uv_at(source, triangle, u, v));
    }
    return result;
}

glm::vec4 SourceScene::colour(const SourceLayer& layer, const SurfaceHit& hit) const {
    const SourceMesh& source = *embree_->mesh;
    const SourceLayer::Look& look = layer.looks[source.triangle_materials[hit.triangle]];
    glm::vec4 colour = look.base_colour;
    if (look.texture >= 0 && !source.uvs.empty()) {
        colour *= sample(layer.textures[static_cast<std::size_t>(look.texture)],
                         uv_at(source, hit.triangle, hit.u, hit.v));
    }
    colour.w = layer.has_alpha ? colour.w : 1.0F;
    return colour;
}

const SourceMesh& SourceScene::mesh() const {
    return *embree_->mesh;
}

const glm::vec3& SourceScene::corner(std::uint32_t triangle, int k) const {
    return embree_->positions[embree_->mesh->triangles[triangle][static_cast<std::size_t>(k)]];
}

bool SourceScene::has_front_only() const {
    return embree_->front_only;
}

bool SourceScene::has_varying_colour() const {
    return embree_->varying_colour;
}

} // namespace frustumscreen::bake

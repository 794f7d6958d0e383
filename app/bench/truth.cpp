#include "app/bench/truth.h"

#include "app/geometry/collineation.h"
#include "firmware_host/base/parallel.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace frustumscreen {

namespace {

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, ReleaseScene>;
using Geometry = std::unique_ptr<RTCGeometryTy, ReleaseGeometry>;

struct PixelArea {
    int left = 0, top = 0, right = 0, bottom = 0; ///< right and bottom are one past the end
};

/// The pixels that the prop's corners span; the whole picture if a corner is behind the projector.
PixelArea pixels_of_prop(const PropShape& prop, const TruthView& view) {
    const RigidTransform projector_from_prop = view.prop_from_projector.inverse();
    const Pinhole& pinhole = view.projector;
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    for (const PropFace& face : prop.faces) {
        for (const glm::dvec3& corner : face.corners) {
            const std::optional<glm::dvec2> pixel = pinhole.pixel(projector_from_prop.point(corner));
            if (!pixel) {
                return {0, 0, pinhole.width, pinhole.height};
            }
            low = glm::min(low, *pixel);
            high = glm::max(high, *pixel);
        }
    }
    const auto clamped = [](double value, int size) {
        return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size)));
    };
    return {clamped(std::floor(low.x), pinhole.width), clamped(std::floor(low.y), pinhole.height),
            clamped(std::ceil(high.x), pinhole.width), clamped(std::ceil(high.y), pinhole.height)};
}

/// Where the ray is inside `box`; false if it never is for t > 0. direction need not be unit.
bool enters(const Box& box, const glm::dvec3& origin, const glm::dvec3& direction, double& enter) {
    double leave = std::numeric_limits<double>::infinity();
    enter = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) {
            if (origin[axis] < box.low[axis] || origin[axis] > box.high[axis]) {
                return false;
            }
            continue;
        }
        const double a = (box.low[axis] - origin[axis]) / direction[axis];
        const double b = (box.high[axis] - origin[axis]) / direction[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

glm::u8vec4 code_of(const glm::vec3& linear) {
    return {srgb8_from_linear(linear.r), srgb8_from_linear(linear.g), srgb8_from_linear(linear.b), 255};
}

} // namespace

struct Truth::Scene {
    std::shared_ptr<const SourceMesh> mesh;
    std::vector<glm::dvec3> positions; ///< prop frame
    Box box;                           ///< of the triangles' corners, with a margin for float rounding
    Device device;
    EmbreeScene embree;

    /// (t, u, v) of the ray on the triangle's plane in 64-bit; false if it is edge-on.
    [[nodiscard]] bool refine(std::uint32_t triangle, const glm::dvec3& origin, const glm::dvec3& direction,
                              glm::dvec3& t_u_v) const {
        const std::array<std::uint32_t, 3>& corners = mesh->triangles[triangle];
        const glm::dvec3 along_u = positions[corners[1]] - positions[corners[0]];
        const glm::dvec3 along_v = positions[corners[2]] - positions[corners[0]];
        const glm::dvec3 normal = glm::cross(along_u, along_v);
        const double slope = glm::dot(direction, normal);
        if (std::abs(slope) < 1e-9 * glm::length(normal)) {
            return false;
        }
        const glm::dvec3 from_corner = origin - positions[corners[0]];
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

    void add_triangles();
    static void cut_masked(const RTCFilterFunctionNArguments* arguments);
};

/// Embree asks before it accepts a hit: cut where the material's alpha is below its cut-off.
void Truth::Scene::cut_masked(const RTCFilterFunctionNArguments* arguments) {
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

void Truth::Scene::add_triangles() {
    const Geometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), positions.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh->triangles.size()));
    if (vertices == nullptr || indices == nullptr) {
        return; // rtcGetDeviceError tells `build`
    }
    for (const glm::dvec3& position : positions) {
        for (int axis = 0; axis < 3; ++axis) {
            *vertices++ = static_cast<float>(position[axis]);
        }
    }
    for (const std::array<std::uint32_t, 3>& triangle : mesh->triangles) {
        indices = std::copy(triangle.begin(), triangle.end(), indices);
    }
    const bool masked = std::any_of(mesh->materials.begin(), mesh->materials.end(),
                                    [](const SourceMaterial& material) { return material.alpha_mask; });
    if (masked) {
        rtcSetGeometryUserData(geometry.get(), const_cast<SourceMesh*>(mesh.get()));
        rtcSetGeometryIntersectFilterFunction(geometry.get(), cut_masked);
    }
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(embree.get(), geometry.get(), 0);
    rtcSetSceneFlags(embree.get(), RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(embree.get());
}

Truth::Truth(std::unique_ptr<Scene> scene) : scene_(std::move(scene)) {}
Truth::Truth(Truth&&) noexcept = default;
Truth& Truth::operator=(Truth&&) noexcept = default;
Truth::~Truth() = default;

Result<Truth> Truth::build(std::shared_ptr<const SourceMesh> mesh, const glm::dmat4& prop_from_artifact) {
    if (!mesh || mesh->triangles.empty()) {
        return bad_input(
            "the mesh has no triangles to cast rays at; give the file that the pack was baked from");
    }
    auto scene = std::make_unique<Scene>();
    scene->mesh = std::move(mesh);
    scene->positions.reserve(scene->mesh->positions.size());
    for (const glm::dvec3& position : scene->mesh->positions) {
        scene->positions.emplace_back(prop_from_artifact * glm::dvec4(position, 1.0));
    }
    Box box{glm::dvec3(std::numeric_limits<double>::infinity()),
            glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (const std::array<std::uint32_t, 3>& triangle : scene->mesh->triangles) {
        for (const std::uint32_t corner : triangle) {
            box.low = glm::min(box.low, scene->positions[corner]);
            box.high = glm::max(box.high, scene->positions[corner]);
        }
    }
    const double size = glm::distance(box.low, box.high);
    if (!std::isfinite(size)) {
        return bad_input("the pack's placement does not map the mesh to finite points; bake the pack again");
    }
    scene->box = {box.low - 1e-4 * size, box.high + 1e-4 * size};
    scene->device.reset(rtcNewDevice(nullptr));
    scene->embree.reset(rtcNewScene(scene->device.get()));
    scene->add_triangles();
    if (rtcGetDeviceError(scene->device.get()) != RTC_ERROR_NONE) {
        return fail(ErrorKind::Internal,
                    "Embree could not build the scene of the source mesh; free some memory");
    }
    return Truth(std::move(scene));
}

bool Truth::first_hit(const glm::dvec3& origin, const glm::dvec3& direction, Hit& hit) const {
    double enter = 0.0;
    if (!enters(scene_->box, origin, direction, enter)) {
        return false;
    }
    // Starting at the box keeps float's precision for the artifact.
    const glm::dvec3 start = origin + enter * direction;
    const glm::dvec3 unit = glm::normalize(direction);
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(start.x);
    ray.ray.org_y = static_cast<float>(start.y);
    ray.ray.org_z = static_cast<float>(start.z);
    ray.ray.dir_x = static_cast<float>(unit.x);
    ray.ray.dir_y = static_cast<float>(unit.y);
    ray.ray.dir_z = static_cast<float>(unit.z);
    ray.ray.tnear = 0.0F;
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = 0xFFFFFFFFU;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_->embree.get(), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return false;
    }
    glm::dvec3 t_u_v(ray.ray.tfar, ray.hit.u, ray.hit.v);
    (void)scene_->refine(ray.hit.primID, start, unit, t_u_v); // else Embree's own stands
    hit = {ray.hit.primID, start + t_u_v.x * unit,
           surface_colour(*scene_->mesh, ray.hit.primID, t_u_v.y, t_u_v.z)};
    return true;
}

TruthPicture Truth::cast(const PropShape& prop, const TruthView& view, bool sixteen_rays) const {
    const int width = view.projector.width;
    const int height = view.projector.height;
    const glm::u8vec4 black(0, 0, 0, 255);
    TruthPicture picture{{width, height},
                         {width, height},
                         {width, height, glm::vec3(std::numeric_limits<float>::quiet_NaN())},
                         {width, height, black},
                         {}};
    if (sixteen_rays) {
        picture.colour16 = Image8(width, height, black);
    }
    /// What the projector's ray through (u, v) must show: false if it does not light the prop.
    enum class Seen { Nothing, Prop, Artifact };
    const glm::dvec3 projector = view.prop_from_projector.translation;
    const auto look = [&](double u, double v, Hit& hit) {
        const glm::dvec3 light = view.prop_from_projector.direction(view.projector.ray({u, v}));
        PropHit lit;
        if (!intersect(prop, projector, light, lit)) {
            return Seen::Nothing;
        }
        const Plane& face = prop.faces[static_cast<std::size_t>(lit.face)].plane;
        if (!(face.distance(view.eye_m) > 0.0)) {
            return Seen::Prop;
        }
        const glm::dvec3 on_face = projector + lit.t * light;
        return first_hit(view.eye_m, on_face - view.eye_m, hit) ? Seen::Artifact : Seen::Prop;
    };
    const PixelArea area = pixels_of_prop(prop, view);
    const auto cast_row = [&](int y) {
        Hit hit;
        for (int x = area.left; x < area.right; ++x) {
            const Seen seen = look(x + 0.5, y + 0.5, hit);
            picture.prop.at(x, y) = seen != Seen::Nothing ? 1 : 0;
            if (seen != Seen::Artifact) {
                continue;
            }
            picture.hit.at(x, y) = 1;
            picture.point_m.at(x, y) = glm::vec3(hit.point_m);
            picture.colour.at(x, y) = code_of(hit.colour.linear);
            if (!sixteen_rays) {
                continue;
            }
            glm::vec3 sum(0.0F);
            for (int sub = 0; sub < 16; ++sub) {
                const int column = sub % 4;
                const int row = sub / 4;
                if (look(x + (column + 0.5) / 4.0, y + (row + 0.5) / 4.0, hit) == Seen::Artifact) {
                    sum += glm::clamp(hit.colour.linear, 0.0F, 1.0F);
                }
            }
            picture.colour16.at(x, y) = code_of(sum / 16.0F);
        }
    };
    parallel_for(static_cast<std::size_t>(std::max(area.bottom - area.top, 0)), 1,
                 [&](std::size_t begin, std::size_t) { cast_row(area.top + static_cast<int>(begin)); });
    return picture;
}

} // namespace frustumscreen

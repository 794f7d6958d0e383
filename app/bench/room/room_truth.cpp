#include "app/bench/room/room_truth.h"

#include "firmware_host/base/parallel.h"

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <limits>
#include <utility>

namespace frustumscreen::bench {

Result<std::unique_ptr<RoomTruth>> RoomTruth::build(room::Room room, std::span<const RoomSource> sources,
                                                    std::span<const glm::dmat4> box_from_file) {
    std::unique_ptr<RoomTruth> made(new RoomTruth(std::move(room)));
    made->device_.reset(rtcNewDevice(nullptr));
    for (std::size_t k = 0; k < sources.size(); ++k) {
        TRY(std::shared_ptr<const TracedMesh> mesh,
            TracedMesh::build_on(made->device_.get(), sources[k].mesh, box_from_file[k]));
        made->meshes_.push_back(std::move(mesh));
    }
    made->scene_.reset(rtcNewScene(made->device_.get()));
    rtcSetSceneFlags(made->scene_.get(), RTC_SCENE_FLAG_ROBUST);
    for (const room::Object& object : made->room_.objects) {
        const RTCGeometry geometry = rtcNewGeometry(made->device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, made->meshes_[object.pack]->scene());
        rtcAttachGeometryByID(made->scene_.get(), geometry, static_cast<unsigned>(made->instances_.size()));
        made->instances_.push_back({geometry, glm::dmat4(1.0)});
        rtcReleaseGeometry(geometry); // the scene keeps it
    }
    made->place(0.0);
    if (rtcGetDeviceError(made->device_.get()) != RTC_ERROR_NONE) {
        return fail(ErrorKind::Internal, "bench.no_room_scene",
                    "Embree could not build the scene of the room; free some memory");
    }
    return made;
}

void RoomTruth::place(double seconds) {
    for (std::size_t k = 0; k < instances_.size(); ++k) {
        const room::Object& object = room_.objects[k];
        const glm::dmat4 table_from_box =
            glm::scale(room::table_from_object(object, seconds).matrix(), glm::dvec3(object.size_m));
        instances_[k].box_from_table = glm::affineInverse(table_from_box);
        const glm::mat4 single(table_from_box);
        rtcSetGeometryTransform(instances_[k].geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                                glm::value_ptr(single));
        rtcCommitGeometry(instances_[k].geometry);
    }
    rtcCommitScene(scene_.get());
}

bool RoomTruth::hit(const glm::dvec3& eye_m, const glm::dvec3& direction, glm::dvec3& point_m) const {
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(eye_m.x);
    ray.ray.org_y = static_cast<float>(eye_m.y);
    ray.ray.org_z = static_cast<float>(eye_m.z);
    ray.ray.dir_x = static_cast<float>(direction.x);
    ray.ray.dir_y = static_cast<float>(direction.y);
    ray.ray.dir_z = static_cast<float>(direction.z);
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = 0xFFFFFFFFU;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_.get(), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return false;
    }
    const Instance& instance = instances_[ray.hit.instID[0]];
    const TracedMesh& mesh = *meshes_[room_.objects[ray.hit.instID[0]].pack];
    const glm::dvec3 origin(instance.box_from_table * glm::dvec4(eye_m, 1.0));
    const glm::dvec3 along(instance.box_from_table * glm::dvec4(direction, 0.0));
    glm::dvec3 t_u_v(ray.ray.tfar, ray.hit.u, ray.hit.v);
    (void)mesh.refine(ray.hit.primID, origin, along, t_u_v); // if false, Embree's own values remain
    point_m = eye_m + t_u_v.x * direction;
    return true;
}

TruthPicture RoomTruth::cast(const settings::ScreenSettings& screen, const RoomFrame& frame) {
    place(frame.seconds);
    TruthPicture picture{
        .prop = {screen.width, screen.height, 1},
        .hit = {screen.width, screen.height},
        .point_m = {screen.width, screen.height, glm::vec3(std::numeric_limits<float>::quiet_NaN())},
        .colour = {screen.width, screen.height, glm::u8vec4(0, 0, 0, 255)},
        .colour16 = {}};
    const glm::dvec3 across_m = screen.corners_m[1] - screen.corners_m[0];
    const glm::dvec3 down_m = screen.corners_m[3] - screen.corners_m[0];
    parallel_for(static_cast<std::size_t>(screen.height), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            const auto y = static_cast<int>(row);
            for (int x = 0; x < screen.width; ++x) {
                const glm::dvec3 at_m = screen.corners_m[0] + (x + 0.5) / screen.width * across_m +
                                        (y + 0.5) / screen.height * down_m;
                glm::dvec3 point_m;
                if (hit(frame.eye_m, glm::normalize(at_m - frame.eye_m), point_m)) {
                    picture.hit.at(x, y) = 1;
                    picture.point_m.at(x, y) = glm::vec3(point_m);
                }
            }
        }
    });
    return picture;
}

} // namespace frustumscreen::bench

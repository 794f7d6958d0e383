/// The truth for the room behind the screen: a ray cast of the source meshes, each built once and placed as an instance for
/// every object, where the object is at that moment.
///
/// For a pixel of the screen at S and the eye at E, the first hit of E + t (S - E), t > 0, as docs/conventions.md has it.
///
/// Frames   table T, metres.
/// Set-up   as truth.h: Embree (float, robust) finds the triangle; the hit is refined in 64-bit in the object's box.
/// Threads  `cast` uses every core inside; one call at a time.
/// Errors   a mesh without triangles; Embree has no memory.
#pragma once

#include "app/bench/room/room_scene.h"
#include "app/bench/truth/traced_mesh.h"
#include "app/bench/truth/truth.h"
#include "app/scene/flat_screen.h"

#include <memory>
#include <span>
#include <vector>

namespace frustumscreen::bench {

class RoomTruth {
public:
    /// `sources`, `box_from_file`: one for each of the room's packs.
    [[nodiscard]] static Result<std::unique_ptr<RoomTruth>>
    build(room::Room room, std::span<const RoomSource> sources, std::span<const glm::dmat4> box_from_file);
    RoomTruth(const RoomTruth&) = delete;
    RoomTruth& operator=(const RoomTruth&) = delete;

    /// Hits and their points alone: its colours are black.
    [[nodiscard]] TruthPicture cast(const settings::ScreenSettings& screen, const RoomFrame& frame);

private:
    struct Release {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    };
    struct Instance {
        RTCGeometry geometry = nullptr; ///< the scene's
        glm::dmat4 box_from_table{1.0};
    };
    explicit RoomTruth(room::Room room) : room_(std::move(room)) {}
    void place(double seconds);
    /// False if nothing is hit.
    [[nodiscard]] bool hit(const glm::dvec3& eye_m, const glm::dvec3& direction, glm::dvec3& point_m) const;

    room::Room room_;
    std::unique_ptr<RTCDeviceTy, Release> device_;
    std::vector<std::shared_ptr<const TracedMesh>> meshes_; ///< in their boxes; one for each pack
    std::unique_ptr<RTCSceneTy, Release> scene_;
    std::vector<Instance> instances_; ///< one for each object
};

} // namespace frustumscreen::bench

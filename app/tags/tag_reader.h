/// Turns a camera's frame into the prop's pose on the table: finds the tags, fits the pose, and limits its
/// processor time. A lamp with a tag of its own gets its pose from the same frame.
///
/// Frames   table T; a frame of another size than the pinhole's, but of equal aspect ratio, is read as the
///          same view.
/// Time     a pose has its frame's capture time, from the kernel. With a rolling shutter that is the time of
///          the frame's middle row, and the pose has the time of the mean row of its tags; successive poses
///          give the motion during a frame.
/// Share    a quarter of one core, however full of edges a picture is: after a frame that took some time it
///          skips those within four times that time. If the whole picture exceeds that at 30 frames a second,
///          the next hundred frames are searched at half size. That costs less than half, but finds fewer
///          small, blurred or dark tags. If it finds no pose although the whole picture gave one, the next
///          hundred are whole again, at a lower rate.
/// Threads  one caller: the camera's own thread. Allocates.
/// Errors   none: no pose. An uncertain pose (tag_pose.h) is not returned.
#pragma once

#include "app/tags/tag_pose.h"
#include "app/tracking/uncertain_pose.h"
#include "firmware_host/camera/camera.h"
#include "firmware_host/camera/cpu_throttle.h"

#include <atomic>
#include <functional>
#include <vector>

namespace frustumscreen::tags {

struct TagSetUp {
    geometry::Pinhole camera;
    geometry::RigidTransform table_from_camera;
    std::vector<PropTag> tags;
    double readout_s = 0.0; ///< of the camera's rows, from the first to the last; 0: global shutter
    std::optional<PropTag> lamp = std::nullopt; ///< on a torch: its pose in the torch's frame
};

/// Counts of frames since the start.
struct TagCounts {
    std::uint64_t looked_at = 0;
    std::uint64_t skipped = 0;      ///< to stay within the share
    std::uint64_t posed = 0;        ///< gave a returned pose
    std::uint64_t at_half_size = 0; ///< included in `looked_at`
    std::uint64_t misshapen = 0;    ///< of another aspect ratio than in the settings
};

class TagReader {
public:
    static constexpr double max_share = 0.25; ///< of one core

    /// `busy` returns the processor time of this thread in seconds.
    explicit TagReader(TagSetUp set_up, std::function<double()> busy = camera::thread_seconds);

    [[nodiscard]] std::optional<tracking::UncertainPose> read(const camera::CameraFrame& frame);
    /// The lamp's pose in the frame that was read last; `table_from_prop` is the torch's.
    [[nodiscard]] const std::optional<tracking::UncertainPose>& lamp() const { return lamp_; }
    [[nodiscard]] const TagCounts& counts() const { return counts_; }

private:
    [[nodiscard]] std::optional<tracking::UncertainPose> look(const camera::CameraFrame& frame);
    void look_for_lamp(const geometry::Pinhole& camera, MonotonicTime first_row);
    /// Chooses the search size of the next picture, from the result and the time of this one.
    void follow_size(bool posed, double took_s);

    TagSetUp set_up_;
    camera::CpuThrottle pace_;
    TagDetector whole_;
    TagDetector half_;
    int half_for_ = 0;         ///< frames still to be searched at half size
    int whole_for_ = 0;        ///< frames still to be searched whole, whatever they cost
    bool whole_posed_ = false; ///< the latest whole search gave a pose
    struct Before {
        geometry::RigidTransform camera_from_prop;
        MonotonicTime time;
    };
    std::optional<Before> before_; ///< the latest returned pose
    std::optional<tracking::UncertainPose> lamp_;
    std::vector<FoundTag> found_;
    TagCounts counts_;
};

} // namespace frustumscreen::tags

/// A camera's frame into the prop's pose on the table: finds the tags, fits the pose, and keeps its hands off the processor.
///
/// Frames   table T; a frame of another size than the pinhole's, but of its shape, is read as the same view.
/// Time     a pose has its frame's time: when the kernel says that it was taken. With a shutter that reads row after row that is the time of its middle
///          row, and a pose that of the row amid its tags; poses in sequence tell how the prop moves meanwhile.
/// Share    after a frame that took some time it passes over those that come within four times that: it never takes more than a
///          quarter of one core, however full of edges a picture is. Where the whole picture costs more than that at 30 frames a
///          second, the next hundred are searched at half size: that costs less than half, and finds fewer of the tags that are small,
///          blurred or dark. Where it finds no pose and the whole picture gave one, the next hundred are whole again, and come less often.
/// Threads  one caller: the camera's own thread. Allocates.
/// Errors   none: no pose. One that is not sure (tag_pose.h) is not handed on.
#pragma once

#include "app/tags/tag_pose.h"
#include "app/tracking/uncertain_pose.h"
#include "firmware_host/camera/camera.h"
#include "firmware_host/camera/frame_pace.h"

#include <atomic>
#include <functional>
#include <vector>

namespace frustumscreen {

struct TagSetUp {
    Pinhole camera;
    RigidTransform table_from_camera;
    std::vector<PropTag> tags;
    double readout_s = 0.0; ///< of the camera's rows, from the first to the last; 0: all at once
};

/// What became of the frames, since the start.
struct TagCounts {
    std::uint64_t looked_at = 0;
    std::uint64_t passed_over = 0;  ///< to keep its share
    std::uint64_t posed = 0;        ///< gave a pose that was handed on
    std::uint64_t at_half_size = 0; ///< of those looked at
    std::uint64_t misshapen = 0;    ///< of another shape than the settings say
};

class TagReader {
public:
    static constexpr double most_share = 0.25; ///< of one core

    /// `busy`: seconds of the processor that this thread has used.
    explicit TagReader(TagSetUp set_up, std::function<double()> busy = thread_seconds);

    [[nodiscard]] std::optional<UncertainPose> read(const CameraFrame& frame);
    [[nodiscard]] const TagCounts& counts() const { return counts_; }

private:
    [[nodiscard]] std::optional<UncertainPose> look(const CameraFrame& frame);
    /// Chooses how large the next picture is searched, after one that gave a pose or not and took so long.
    void follow_size(bool posed, double took_s);

    TagSetUp set_up_;
    FramePace pace_;
    TagDetector whole_;
    TagDetector half_;
    int half_for_ = 0;         ///< frames to come are searched at half size
    int whole_for_ = 0;        ///< frames to come are searched whole, whatever they cost
    bool whole_posed_ = false; ///< the latest one that was searched whole gave a pose
    struct Before {
        RigidTransform camera_from_prop;
        MonotonicTime time;
    };
    std::optional<Before> before_; ///< the latest pose that was handed on
    std::vector<FoundTag> found_;
    TagCounts counts_;
};

} // namespace frustumscreen

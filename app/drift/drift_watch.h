/// The drift check while the exhibit runs: the render thread shows drift marks now and then; the camera's
/// thread finds them and judges.
///
/// Threads  `use`: the camera's; no frame leaves it, and only it writes the reference's file, once after a
///          calibration. Everything else: the render thread, which neither waits nor allocates.
/// Errors   none; `verdict` describes them. An unreadable reference is learned again; a failed write is
///          reported on standard error, and the reference is learned again after the next start.
#pragma once

#include "app/drift/drift_check.h"
#include "app/drift/mark_schedule.h"
#include "firmware_host/base/sentence.h"
#include "firmware_host/camera/camera.h"
#include "firmware_host/tags/tag_detector.h"

#include <atomic>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

namespace frustumscreen::drift {

struct DriftSetUp {
    std::vector<glm::dvec2> marks_m; ///< from the kept calibration
    std::vector<int> moving_tags;    ///< ids that are not fixed on the table: the prop's
    std::filesystem::path file;      ///< of the reference
};

/// A mark to light in this frame.
struct ShownMark {
    glm::dvec2 place_m{0.0};
    double brightness = 0.0; ///< above 0, up to 1
};

/// The verdict in one sentence.
[[nodiscard]] Sentence sentence_of(const DriftVerdict& verdict);

class DriftWatch {
public:
    /// Reads the reference, if there is one for these marks.
    explicit DriftWatch(DriftSetUp set_up);

    void use(const camera::CameraFrame& frame);

    /// `quiet`: as in MarkSchedule.
    [[nodiscard]] std::optional<ShownMark> step(MonotonicTime now, bool quiet);
    /// The latest verdict.
    [[nodiscard]] const DriftVerdict& verdict();

private:
    void follow(const camera::CameraFrame& frame, Nanoseconds since_begin);
    void find_mark();
    void end_set(MonotonicTime time);
    void keep_reference();
    void follow_size(const camera::CameraFrame& frame);
    [[nodiscard]] std::optional<PixelWindow> window_of(std::size_t mark) const;
    void find_anchors(MarkSet& set);

    DriftSetUp set_up_;
    MarkSchedule schedule_;                 ///< used by the render thread
    DriftVerdict told_;                     ///< used by the render thread
    std::atomic<std::int64_t> began_ns_{0}; ///< start of the current set; 0: none

    // Used by the camera's thread:
    DriftCheck check_;
    MarkFinder finder_;
    tags::TagDetector tags_;
    std::vector<tags::FoundTag> found_tags_;
    std::vector<std::uint8_t> dark_;
    std::int64_t follows_ns_ = 0; ///< the set that it follows or has finished
    bool ended_ = true;
    std::optional<std::size_t> mark_; ///< the mark of the current frames
    MarkSet set_;

    std::mutex mutex_; ///< held only for a copy
    DriftVerdict verdict_;
};

} // namespace frustumscreen::drift

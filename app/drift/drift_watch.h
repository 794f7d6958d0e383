/// The check whether the picture still lies where it was calibrated, while the exhibit runs: the render thread shows marks of light now
/// and then, the camera's thread finds them and judges.
///
/// Threads  `use`: the camera's; no frame leaves it, and it alone writes the reference's file, once after a calibration. All else: the
///          render thread, which waits for nothing and allocates nothing.
/// Errors   none; `verdict` says what is the matter. A reference that cannot be read is learned anew; one that cannot be written is a line
///          on standard error, and is learned anew with the next start.
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

namespace frustumscreen {

struct DriftSetUp {
    std::vector<glm::dvec2> marks_m; ///< by the kept calibration
    std::vector<int> moving_tags;    ///< ids that do not lie on the table for good: the prop's
    std::filesystem::path file;      ///< where the reference is stored
};

/// A mark that is to be lit in this frame.
struct ShownMark {
    glm::dvec2 place_m{0.0};
    double brightness = 0.0; ///< above 0, up to 1
};

/// What is told of it.
[[nodiscard]] Sentence sentence_of(const DriftVerdict& verdict);

class DriftWatch {
public:
    /// Reads the reference, if there is one of these marks.
    explicit DriftWatch(DriftSetUp set_up);

    void use(const CameraFrame& frame);

    /// `quiet`: as MarkSchedule.
    [[nodiscard]] std::optional<ShownMark> step(MonotonicTime now, bool quiet);
    /// The latest one.
    [[nodiscard]] const DriftVerdict& verdict();

private:
    void follow(const CameraFrame& frame, Nanoseconds since_begin);
    void find_mark();
    void end_set(MonotonicTime time);
    void keep_reference();
    void follow_size(const CameraFrame& frame);
    [[nodiscard]] std::optional<PixelWindow> window_of(std::size_t mark) const;
    void find_anchors(MarkSet& set);

    DriftSetUp set_up_;
    MarkSchedule schedule_;                 ///< the render thread's
    DriftVerdict told_;                     ///< the same
    std::atomic<std::int64_t> began_ns_{0}; ///< of the set that is shown; 0: none

    // The camera's thread:
    DriftCheck check_;
    MarkFinder finder_;
    TagDetector tags_;
    std::vector<FoundTag> found_tags_;
    std::vector<std::uint8_t> dark_;
    std::int64_t follows_ns_ = 0; ///< the set that it follows, or has followed to its end
    bool ended_ = true;
    std::optional<std::size_t> mark_; ///< whose frames are gathered
    MarkSet set_;

    std::mutex mutex_; ///< held for a copy only
    DriftVerdict verdict_;
};

} // namespace frustumscreen

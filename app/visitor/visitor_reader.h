/// Turns a camera's frames into the heads of the visitors at the table: finds the foreground, head outlines
/// in it, and the identity of each head from frame to frame.
///
/// Frames   table T; a frame of another size than the pinhole's, but of equal aspect ratio, is read as the
///          same view.
/// Time     a head has its frame's capture time, from the kernel. A decreasing time restarts everything.
/// Sure     a head is returned once it was seen for a third of a second. A head that has not moved for a
///          minute is an object, such as a coat on a chair, and becomes background.
/// Share    a tenth of one core: after a frame that took some time it skips those within ten times that time.
/// Threads  one caller: the camera's own thread.
/// Errors   none: no heads.
#pragma once

#include "app/tracking/seen_head.h"
#include "app/visitor/background.h"
#include "app/visitor/head_fit.h"
#include "firmware_host/camera/camera.h"
#include "firmware_host/camera/cpu_throttle.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::visitor {

struct VisitorSetUp {
    geometry::Pinhole camera;
    geometry::RigidTransform table_from_camera;
    HeadZone zone;
};

/// Counts of frames since the start.
struct VisitorCounts {
    std::uint64_t looked_at = 0;
    std::uint64_t skipped = 0;   ///< to stay within the share
    std::uint64_t misshapen = 0; ///< of another aspect ratio than in the settings
};

class VisitorReader {
public:
    static constexpr double max_share = 0.1; ///< of one core
    static constexpr Nanoseconds sure_after = std::chrono::milliseconds(300);
    static constexpr Nanoseconds forgotten_after = std::chrono::milliseconds(500);
    static constexpr Nanoseconds thing_after = std::chrono::seconds(60);
    static constexpr double moved_px = 0.8; ///< of the small frame

    /// `busy` returns the processor time of this thread in seconds.
    explicit VisitorReader(VisitorSetUp set_up, std::function<double()> busy = camera::thread_seconds);

    /// The heads seen in this frame; valid until the next call.
    [[nodiscard]] std::span<const tracking::SeenHead> read(const camera::CameraFrame& frame);
    [[nodiscard]] const VisitorCounts& counts() const { return counts_; }

private:
    /// A person, followed from frame to frame.
    struct Person {
        std::uint32_t number = 0;
        FittedHead head;
        MonotonicTime first, last;
        glm::dvec2 still_at{0.0}; ///< mean pixel over some seconds when it was last seen to move
        glm::dvec2 mean{0.0};
        MonotonicTime moved;
        [[nodiscard]] bool is_thing() const { return last - moved >= thing_after; }
    };
    void look(const camera::CameraFrame& frame);
    void prepare(int width, int height);
    void follow(MonotonicTime time);
    void see(Person& person, const FittedHead& head, MonotonicTime time);
    [[nodiscard]] tracking::SeenHead seen(const Person& person) const;

    VisitorSetUp set_up_;
    camera::CpuThrottle pace_;
    geometry::Pinhole camera_; ///< of the small frame
    SmallFrame small_;
    std::optional<Background> background_;
    std::vector<FittedHead> fitted_;
    std::vector<Person> people_;
    std::vector<PixelBox> boxes_;
    std::vector<tracking::SeenHead> heads_;
    std::uint32_t last_number_ = 0;
    VisitorCounts counts_;
};

} // namespace frustumscreen::visitor

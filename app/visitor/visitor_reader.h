/// A camera's frames into the heads of those who stand at the table: what is not background, what of it has a head's outline, and
/// whose head that is from frame to frame.
///
/// Frames   table T; a frame of another size than the pinhole's, but of its shape, is read as the same view.
/// Time     a head has its frame's time: when the kernel says that it was taken. Time that goes back begins anew.
/// Sure     a head is handed on once it was seen for a third of a second. One that has not moved at all for a minute is no head but a
///          thing, such as a coat on a chair; it becomes background.
/// Share    after a frame that took some time it passes over those that come within ten times that: a tenth of one core at most.
/// Threads  one caller: the camera's own thread.
/// Errors   none: no heads.
#pragma once

#include "app/tracking/seen_head.h"
#include "app/visitor/background.h"
#include "app/visitor/head_fit.h"
#include "firmware_host/camera/camera.h"
#include "firmware_host/camera/frame_pace.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen {

struct VisitorSetUp {
    Pinhole camera;
    RigidTransform table_from_camera;
    HeadZone zone;
};

/// What became of the frames, since the start.
struct VisitorCounts {
    std::uint64_t looked_at = 0;
    std::uint64_t passed_over = 0; ///< to keep its share
    std::uint64_t misshapen = 0;   ///< of another shape than the settings say
};

class VisitorReader {
public:
    static constexpr double most_share = 0.1; ///< of one core
    static constexpr Nanoseconds sure_after = std::chrono::milliseconds(300);
    static constexpr Nanoseconds forgotten_after = std::chrono::milliseconds(500);
    static constexpr Nanoseconds thing_after = std::chrono::seconds(60);
    static constexpr double moved_px = 0.8; ///< of the small frame

    /// `busy`: seconds of the processor that this thread has used.
    explicit VisitorReader(VisitorSetUp set_up, std::function<double()> busy = thread_seconds);

    /// Those seen in this frame, until the next call.
    [[nodiscard]] std::span<const SeenHead> read(const CameraFrame& frame);
    [[nodiscard]] const VisitorCounts& counts() const { return counts_; }

private:
    /// Somebody, from frame to frame.
    struct Person {
        std::uint32_t number = 0;
        FittedHead head;
        MonotonicTime first, last;
        glm::dvec2 still_at{0.0}; ///< pixel, the mean of some seconds, where it was last seen to move
        glm::dvec2 mean{0.0};
        MonotonicTime moved;
        [[nodiscard]] bool is_thing() const { return last - moved >= thing_after; }
    };
    void look(const CameraFrame& frame);
    void prepare(int width, int height);
    void follow(MonotonicTime time);
    void see(Person& person, const FittedHead& head, MonotonicTime time);
    [[nodiscard]] SeenHead seen(const Person& person) const;

    VisitorSetUp set_up_;
    FramePace pace_;
    Pinhole camera_; ///< of the small frame
    SmallFrame small_;
    std::optional<Background> background_;
    std::vector<FittedHead> fitted_;
    std::vector<Person> people_;
    std::vector<PixelBox> boxes_;
    std::vector<SeenHead> heads_;
    std::uint32_t last_number_ = 0;
    VisitorCounts counts_;
};

} // namespace frustumscreen

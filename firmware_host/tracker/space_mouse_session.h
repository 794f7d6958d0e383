/// A SpaceMouse in place of a tracker on a desk: the prop moves while the cap is deflected.
///
/// Frame    table T: the prop begins at the table's centre and stays on or above the table.
/// Time     samples lie on a grid of 8 ms from the first call on, also at rest, so they depend only on the
///          reports and their times. A report is valid until the next one of its kind, for at most 100 ms: a
///          mouse repeats its reports while its cap is deflected; one that hangs does not.
/// Threads  see device_session.h.
/// Method   velocities are constant between reports, so the integral is exact: p + v t within the table's
///          box, exp(w t) R with w in the table's axes.
#pragma once

#include "firmware_host/tracker/device_session.h"
#include "firmware_host/tracker/space_mouse_codec.h"

namespace frustumscreen::tracker {

class SpaceMouseSession final : public DeviceSession {
public:
    static constexpr Nanoseconds sample_period = std::chrono::milliseconds(8);
    static constexpr Nanoseconds report_holds = std::chrono::milliseconds(100);
    static constexpr double full_deflection = 350.0; ///< counts
    static constexpr double dead_zone = 15.0;        ///< counts
    static constexpr double full_push_m_per_s = 0.25;
    static constexpr double full_turn_rad_per_s = 1.5;
    static constexpr double highest_m = 0.5; ///< above the table

    /// `table_half_m`: half the table along X and Y.
    explicit SpaceMouseSession(const glm::dvec2& table_half_m);

    [[nodiscard]] std::span<const std::byte> due(MonotonicTime now) override;
    void receive(std::span<const std::byte> report, MonotonicTime arrival,
                 std::vector<PoseSample>& samples) override;
    [[nodiscard]] UsbTrackerState state(MonotonicTime) const override {
        return next_sample_ ? UsbTrackerState::Streaming : UsbTrackerState::SettingUp;
    }
    [[nodiscard]] bool failed() const override { return false; }
    [[nodiscard]] const SequenceChecker& intake() const override { return intake_; }

private:
    struct Motion {
        glm::dvec3 per_second{0.0};
        MonotonicTime until{};
    };
    void advance(MonotonicTime to);
    void sample(MonotonicTime to, std::vector<PoseSample>& samples);

    glm::dvec3 lowest_m_;
    glm::dvec3 highest_corner_m_;
    glm::dvec3 position_m_{0.0};
    glm::dquat rotation_{1.0, 0.0, 0.0, 0.0};
    Motion push_;
    Motion turn_;
    MonotonicTime at_{}; ///< the time of the pose
    std::optional<MonotonicTime> next_sample_;
    SequenceChecker intake_; ///< only counts refused reports
};

} // namespace frustumscreen::tracker

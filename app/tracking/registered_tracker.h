/// A tracker whose poses are in table coordinates, whatever frame its device reports; the only place that
/// applies a registration.
///
/// Frame    table T. Poses in a device's own frame K are transformed by its registration; poses in table
///          coordinates are unchanged.
/// Threads  those of the device's interface: one caller. Allocates nothing itself.
/// Errors   the device's.
#pragma once

#include "app/geometry/registration.h"
#include "firmware_host/tracker/tracker.h"

#include <memory>
#include <optional>
#include <span>

namespace frustumscreen::tracking {

/// Transforms poses from the device's own frame to the table T. The pose of a sensor becomes that of the thing that
/// it is fixed to: of the prop, of the eye with +X from the left eye to the right one, or of the torch. The poses of
/// other sensors stay those of the sensors. A pose that is not ok is unchanged.
void place_on_table(std::span<tracker::PoseSample> samples, const geometry::Registration& registration);

class RegisteredTracker final : public tracker::Tracker {
public:
    /// `registration` is ignored if the device reports in table coordinates.
    RegisteredTracker(std::unique_ptr<tracker::Tracker> device, const geometry::Registration& registration);

    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<tracker::PoseSample>& samples) override;
    [[nodiscard]] std::string name() const override { return device_->name(); }
    [[nodiscard]] bool reports_table_frame() const override { return true; }
    [[nodiscard]] std::string_view state() const override { return device_->state(); }
    [[nodiscard]] DeviceCondition condition() const override { return device_->condition(); }
    [[nodiscard]] tracker::TrackerHealth health() const override { return device_->health(); }
    [[nodiscard]] bool hangs() const override { return device_->hangs(); }
    [[nodiscard]] tracker::TrackerCounts counts() const override { return device_->counts(); }
    [[nodiscard]] std::optional<MonotonicTime> alive_until() const override { return device_->alive_until(); }

    /// The applied registration; nullopt: the device reports in table coordinates.
    [[nodiscard]] const std::optional<geometry::Registration>& registration() const { return registration_; }

private:
    std::unique_ptr<tracker::Tracker> device_;
    std::optional<geometry::Registration> registration_;
};

} // namespace frustumscreen::tracking

/// The HID tracker's session: it verifies the device's description of itself; then the device streams without
/// a request.
///
/// The transport hands over the feature report first. Frame, time, threads: see device_session.h.
#pragma once

#include "firmware_host/tracker/device_session.h"
#include "firmware_host/tracker/hid_tracker_codec.h"

namespace frustumscreen::tracker {

class HidTrackerSession final : public DeviceSession {
public:
    HidTrackerSession();

    [[nodiscard]] std::span<const std::byte> due(MonotonicTime now) override;
    void receive(std::span<const std::byte> report, MonotonicTime arrival,
                 std::vector<PoseSample>& samples) override;
    [[nodiscard]] UsbTrackerState state(MonotonicTime now) const override;
    [[nodiscard]] bool failed() const override { return failed_; }
    [[nodiscard]] const SequenceChecker& intake() const override { return intake_; }

private:
    void check(const HidTrackerInfo& info);
    void give_up(UsbTrackerState trouble);
    [[nodiscard]] Nanoseconds silence(MonotonicTime now) const;

    std::optional<MonotonicTime> began_;
    bool informed_ = false; ///< the feature report was good
    bool failed_ = false;
    UsbTrackerState trouble_ = UsbTrackerState::SettingUp;
    bool booting_ = false; ///< the device's latest report says so
    SequenceChecker intake_;
};

} // namespace frustumscreen::tracker

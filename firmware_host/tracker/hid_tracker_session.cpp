#include "firmware_host/tracker/hid_tracker_session.h"

namespace frustumscreen::tracker {

namespace {

constexpr double tick_ns = 1e3; ///< the time stamp counts microseconds
constexpr int position_unit_um = 10;
constexpr int fewest_hz = 30;
constexpr int max_hz = 1000;
/// A device that is silent for longer is reopened, unless it is slow by design.
constexpr Nanoseconds longest_silence = std::chrono::seconds(1);

} // namespace

HidTrackerSession::HidTrackerSession() : intake_(tick_ns) {}

void HidTrackerSession::give_up(UsbTrackerState trouble) {
    trouble_ = trouble;
    failed_ = true;
}

void HidTrackerSession::check(const HidTrackerInfo& info) {
    if (info.version != hid_tracker_version || info.rate_hz < fewest_hz || info.rate_hz > max_hz ||
        info.stations < 1 || info.stations > static_cast<int>(DeviceFrame::max_sensors)) {
        give_up(UsbTrackerState::SetUpRefused);
    } else if (info.position_unit_um != position_unit_um) {
        give_up(UsbTrackerState::WrongUnits);
    } else {
        informed_ = true;
    }
}

Nanoseconds HidTrackerSession::silence(MonotonicTime now) const {
    return now - intake_.latest().value_or(*began_);
}

/// Never sends anything; only detects a missing feature report and silence.
std::span<const std::byte> HidTrackerSession::due(MonotonicTime now) {
    began_ = began_ ? began_ : now;
    if (!informed_ && now - *began_ > SessionTimes::reply) {
        give_up(UsbTrackerState::SetUpRefused);
    } else if (silence(now) > std::max(longest_silence, intake_.timeout())) {
        give_up(UsbTrackerState::Silent);
    }
    return {};
}

void HidTrackerSession::receive(std::span<const std::byte> report, MonotonicTime arrival,
                                std::vector<PoseSample>& samples) {
    if (report.empty() || failed_) {
        return;
    }
    const HidTrackerMessage message = parse_hid_tracker(report);
    if (const auto* info = std::get_if<HidTrackerInfo>(&message)) {
        check(*info);
    } else if (const auto* pose = std::get_if<HidTrackerPose>(&message); pose && informed_) {
        intake_.take(pose->frame, arrival, samples);
        booting_ = pose->starting;
    } else {
        intake_.count_refusal();
    }
}

UsbTrackerState HidTrackerSession::state(MonotonicTime now) const {
    if (failed_ || !began_) {
        return trouble_;
    }
    if (silence(now) > intake_.timeout()) {
        return UsbTrackerState::Silent;
    }
    if (!intake_.latest()) {
        return UsbTrackerState::SettingUp;
    }
    return booting_ ? UsbTrackerState::Booting : intake_.state(now);
}

} // namespace frustumscreen::tracker

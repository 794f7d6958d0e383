#include "tests/simulators/museum/kiosk_model.h"

#include <algorithm>

namespace frustumscreen::simulators {

namespace {

constexpr MuseumTime ends_after_s = 3;     ///< from the picture on, with a set that crashes it
constexpr MuseumTime hangs_after_s = 5;    ///< from the picture on, caused by a device
constexpr MuseumTime gives_up_after_s = 8; ///< from the start on, if the driver gives no picture

} // namespace

bool KioskModel::has(FaultKind fault) const {
    return std::any_of(fault_events_.begin(), fault_events_.end(),
                       [&](const FaultEvent& each) { return each.fault == fault; });
}

void KioskModel::end_by(unsigned remedies) {
    std::erase_if(fault_events_,
                  [&](const FaultEvent& each) { return (kind_of(each.fault).remedies & remedies) != 0; });
}

void KioskModel::begin_process(MuseumTime now) {
    began_ = now;
    ++process_;
    is_lit_ = false;
    hangs_since_.reset();
    pictures_ = 0;
    memory_ = 0.2;
}

void KioskModel::end_process(MuseumTime now, bool failed) {
    began_.reset();
    is_lit_ = false;
    hangs_since_.reset();
    failures_ += failed ? 1 : 0;
    begins_at_ = now + restart_s;
    end_by(ByRestart);
}

void KioskModel::boot(MuseumTime now, MuseumTime after_s) {
    boots_until_ = now + after_s + boot_s;
    began_.reset();
    is_lit_ = false;
    hangs_since_.reset();
    begins_at_ = boots_until_;
    failures_ = 0;
    end_by(ByReboot | ByRestart);
}

void KioskModel::fault_event(const FaultEvent& fault_event, MuseumTime now) {
    fault_events_.push_back(fault_event);
    switch (fault_event.fault) {
    case FaultKind::Crash:
        end_process(now, true);
        break;
    case FaultKind::Hang:
        hangs_since_ = now;
        break;
    case FaultKind::KernelHang:
        boot(now, hardware_watchdog_s);
        break;
    case FaultKind::PowerCut:
        boot(now, 5);
        break;
    case FaultKind::GpuWedged:
    case FaultKind::MachineBroken:
        is_lit_ = false;
        break;
    default:
        break;
    }
}

bool KioskModel::ends_soon_after_start() const {
    return has(FaultKind::BadSet) && mode_ == watch::Mode::Normal;
}

bool KioskModel::gives_no_picture() const {
    return (has(FaultKind::GpuWedged) && mode_ != watch::Mode::Plain) || has(FaultKind::MachineBroken);
}

/// Advances the exhibit's process by a second.
void KioskModel::live(MuseumTime now) {
    const MuseumTime age = now - *began_;
    memory_ += has(FaultKind::Leak) ? 0.8 / static_cast<double>(leak_s) : 0.0;
    if (has(FaultKind::BadSettings) && mode_ != watch::Mode::BuiltIn) {
        return end_process(now, true);
    }
    if (has(FaultKind::DriverCrash) && mode_ != watch::Mode::Plain) {
        return end_process(now, true);
    }
    if (memory_ >= 1.0) {
        return end_process(now, true);
    }
    if (hangs_since_) {
        is_lit_ = false;
        return now - *hangs_since_ >= systemd_watchdog_s ? end_process(now, true) : void();
    }
    if (gives_no_picture()) {
        is_lit_ = false;
        return age >= gives_up_after_s ? end_process(now, true) : void();
    }
    is_lit_ = age >= start_s;
    if (!is_lit_) {
        return;
    }
    if (ends_soon_after_start() && age >= start_s + ends_after_s) {
        return end_process(now, true);
    }
    if (has(FaultKind::DeviceThread) && age >= start_s + hangs_after_s) {
        hangs_since_ = now;
        return;
    }
    heard_ = now;
    pictures_ += has(FaultKind::Freeze) ? 0 : 1;
}

std::optional<watch::Outcome> KioskModel::pass(MuseumTime now) {
    std::erase_if(fault_events_, [&](const FaultEvent& each) { return each.restored_at <= now; });
    if (is_booting(now)) {
        return std::nullopt;
    }
    if (mode_ == watch::Mode::Safe) {
        ++safe_pictures_;
    } else if (began_) {
        live(now);
    } else if (now >= begins_at_) {
        begin_process(now);
    }
    watch::Outcome outcome;
    outcome.process = began_ ? process_ : 0;
    outcome.failures = failures_;
    outcome.exhibit_memory = began_ ? memory_ : 0.0;
    outcome.safe_pictures = safe_pictures_;
    if (pictures_ > 0) {
        outcome.exhibit =
            watch::ExhibitSays{.age = std::chrono::seconds(now - heard_),
                               .well = true,
                               .pictures = pictures_,
                               .artifacts = 1,
                               .device_hangs = has(FaultKind::TrackerHung) || has(FaultKind::TrackerDead)};
    }
    return outcome;
}

void KioskModel::take(watch::Step step, watch::Mode mode, MuseumTime now) {
    mode_ = mode;
    switch (step) {
    case watch::Step::ResetDevice:
        end_by(ByReset);
        break;
    case watch::Step::Reboot:
        boot(now, 0);
        break;
    default:
        end_process(now, false);
        break; // by command: not a failure
    }
}

VisibleState KioskModel::shown() const {
    if (mode_ == watch::Mode::Safe) {
        return VisibleState::Words;
    }
    if (!is_lit_ || hangs_since_ || has(FaultKind::Freeze)) {
        return VisibleState::Dark;
    }
    if (has(FaultKind::TrackerHung) || has(FaultKind::TrackerDead)) {
        return VisibleState::Untracked;
    }
    return mode_ == watch::Mode::BuiltIn ? VisibleState::BuiltIn : VisibleState::Whole;
}

} // namespace frustumscreen::simulators

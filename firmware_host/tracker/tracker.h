/// The tracker: poses of the prop and the visitor's head, as a device reports them.
///
/// Frame    tracker K for a device, table T for a pose file and the simulation; see `reports_table_frame`.
/// Threads  one caller; `poll` never blocks.
#pragma once

#include "firmware_host/base/device_state.h"
#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::tracker {

enum Station : int { prop_station = 1, head_station = 2, torch_station = 3 };

struct PoseSample {
    MonotonicTime time;
    int station = prop_station;
    glm::dvec3 position_m{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0}; ///< unit, w x y z
    bool ok = true;                          ///< false: the device marks this pose as invalid
};

/// The tracker's health, as far as it affects a visitor.
enum class TrackerHealth : std::uint8_t {
    Well,      ///< the prop's pose may still be unknown while the prop is covered or out of reach
    MetalNear, ///< metal bends its field: poses are wrong by some millimetres
    Away       ///< no poses of the prop: unplugged, booting, faulty, or without the prop's sensor
};

/// Counts of a device's driver since the exhibit started; zeros without a device.
struct TrackerCounts {
    std::uint64_t connections = 0;    ///< devices opened
    std::uint64_t frames = 0;         ///< taken
    std::uint64_t lost = 0;           ///< counter values missing between two taken frames of a sensor
    std::uint64_t duplicated = 0;     ///< came twice; refused
    std::uint64_t reordered = 0;      ///< came after a later one; refused
    std::uint64_t implausible = 0;    ///< a counter far from the expected one; refused
    std::uint64_t unusable = 0;       ///< invalid poses, or poses that the device marks as bad
    std::uint64_t broken = 0;         ///< discards of bytes, mostly for a wrong checksum
    std::uint64_t clock_restarts = 0; ///< jumps of the device's clock
    double clock_drift = 0.0;         ///< seconds of our clock per second of the latest device's, minus 1

    /// Adds the counts of a later device; the drift becomes the later one's.
    TrackerCounts& operator+=(const TrackerCounts& later) {
        connections += later.connections;
        frames += later.frames;
        lost += later.lost;
        duplicated += later.duplicated;
        reordered += later.reordered;
        implausible += later.implausible;
        unusable += later.unusable;
        broken += later.broken;
        clock_restarts += later.clock_restarts;
        clock_drift = later.clock_drift;
        return *this;
    }
};

class Tracker {
public:
    virtual ~Tracker() = default;
    /// Appends every sample with time <= now that was not returned yet, in ascending time.
    /// Errors: DeviceLost (poll again later), BadInput (counted by the caller).
    [[nodiscard]] virtual Result<void> poll(MonotonicTime now, std::vector<PoseSample>& samples) = 0;
    [[nodiscard]] virtual std::string name() const = 0;
    [[nodiscard]] virtual bool reports_table_frame() const { return true; }
    /// The state of the device, or of its replacement, in one plain sentence, valid until the next `poll`;
    /// empty if there is nothing to report.
    [[nodiscard]] virtual std::string_view state() const { return {}; }
    /// Whether the device that the settings ask for can be used; its id is that of the sentence that `state` says.
    [[nodiscard]] virtual DeviceCondition condition() const { return {}; }
    [[nodiscard]] virtual TrackerHealth health() const { return TrackerHealth::Well; }
    /// The device is plugged in but does not work; a reset of its port may help.
    [[nodiscard]] virtual bool hangs() const { return false; }
    /// As of the latest `poll`.
    [[nodiscard]] virtual TrackerCounts counts() const { return {}; }
    /// Time until which the device's thread has promised a sign of life; nullopt: there is no such thread.
    [[nodiscard]] virtual std::optional<MonotonicTime> alive_until() const { return {}; }
};

} // namespace frustumscreen::tracker

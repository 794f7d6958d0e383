/// The tracker: poses of the prop and the visitor's head, as a device reports them.
///
/// Frame    tracker K for a device, table T for a pose file and the simulation; see `reports_table_frame`.
/// Threads  one caller; `poll` never blocks.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

enum Station : int { prop_station = 1, head_station = 2, torch_station = 3 };

struct PoseSample {
    MonotonicTime time;
    int station = prop_station;
    glm::dvec3 position_m{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0}; ///< unit, w x y z
    bool ok = true;                          ///< false: the device says that this pose is not to be used
};

class Tracker {
public:
    virtual ~Tracker() = default;
    /// Appends every sample with time <= now that was not handed out before, in ascending time.
    /// Errors: DeviceLost (poll again later), BadInput (counted by the caller).
    [[nodiscard]] virtual Result<void> poll(MonotonicTime now, std::vector<PoseSample>& samples) = 0;
    [[nodiscard]] virtual std::string name() const = 0;
    [[nodiscard]] virtual bool reports_table_frame() const { return true; }
    /// How the device is, or what stands in its place, in one plain sentence that stands until the next
    /// `poll`; empty: there is nothing to say.
    [[nodiscard]] virtual std::string_view state() const { return {}; }
    /// Until when its thread has promised to be heard of again; nothing: it has none.
    [[nodiscard]] virtual std::optional<MonotonicTime> alive_until() const { return {}; }
};

} // namespace frustumscreen

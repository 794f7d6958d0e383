/// Whether the staff may confirm the state of delivery: a stick with a signed request was put in a short time ago.
///
/// Time     `now` never goes back.
/// Threads  a value; one caller. Allocates nothing.
#pragma once

#include "app/library/import_report.h"
#include "app/library/report_request.h"
#include "firmware_host/base/time.h"

#include <algorithm>
#include <chrono>
#include <optional>

namespace frustumscreen::exhibit {

class ResetOffer {
public:
    static constexpr Nanoseconds stands = std::chrono::minutes(10);

    /// Call when the importer's report changes. `is_old`: it is from before the exhibit's start.
    void take(MonotonicTime now, const library::ImportReport& report, bool is_old) {
        const bool asks =
            !is_old && std::any_of(report.packs.begin(), report.packs.end(), library::offers_reset);
        since_ = !asks ? std::nullopt : since_ ? since_ : std::optional(now);
    }
    [[nodiscard]] bool at(MonotonicTime now) const { return since_ && now - *since_ < stands; }

private:
    std::optional<MonotonicTime> since_;
};

} // namespace frustumscreen::exhibit

/// The copy of the kiosk that the staff may have written onto a stick: whether a stick waits for it, and how far it is.
///
///     ImportReport -> CopyOffer -> CopyState, for StaffPage::Copy
///
/// Offered  for `stands` after a stick was looked through that waits for the staff (library/report_request.h).
/// Writing  from the button until the last report of that stick; reports of other sticks are ignored meanwhile.
/// Time     `now` never goes back.
/// Threads  a value; one caller. `step` allocates nothing while the state does not change.
/// Errors   in the state, one sentence.
#pragma once

#include "app/library/import_report.h"
#include "firmware_host/base/time.h"

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace frustumscreen::exhibit {

enum class CopyStage : std::uint8_t {
    NoStick,   ///< or it was put in too long ago
    Looking,   ///< it is looked through, or its packs are copied
    NoRequest, ///< it does not wait for the staff
    Offered,
    Writing,
    Written,
    Failed,
};

struct CopyState {
    CopyStage stage = CopyStage::NoStick;
    int percent = 0;    ///< of the packs, while Writing
    std::string said{}; ///< Written: the folder's name; Failed: why

    [[nodiscard]] bool operator==(const CopyState&) const = default;
};

class CopyOffer {
public:
    static constexpr Nanoseconds stands = std::chrono::minutes(10);
    /// Time-out: after this long without a new report the copy has failed. A slow stick takes some seconds for a pack of 4 MB.
    static constexpr Nanoseconds timeout = std::chrono::minutes(2);

    /// Call when the importer's report changes. `is_old`: it is from before the exhibit's start.
    void take(MonotonicTime now, const library::ImportReport& report, bool is_old);
    /// The staff confirmed what is offered.
    void confirm(MonotonicTime now);
    /// The state at this time; call in every step.
    const CopyState& step(MonotonicTime now);
    [[nodiscard]] bool is_offered() const { return state_.stage == CopyStage::Offered; }

private:
    std::string stick_; ///< import id of the latest stick
    CopyState state_;
    MonotonicTime since_; ///< when the state last changed
};

} // namespace frustumscreen::exhibit

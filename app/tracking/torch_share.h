/// The share of a torch's light: softly 0 when it is laid down or lost, softly back when it is taken.
///
/// Laid down   it has not moved for `lies_after`, and points across the table or up; or it is below the table's plane, in
///             its holder. A hand that rests moves it more, and a torch that is fixed above the table, pointing down,
///             goes on.
/// Taken       it has moved by `taken_m` or `taken_rad` from where it lay. It lies before it is first seen to move.
/// Frames      table T; the torch's +Z is the direction of its light.
/// Time        `now` never goes back; a step of any length is exact.
/// Threads     values; one caller. Allocates nothing.
#pragma once

#include "app/geometry/transform.h"
#include "firmware_host/base/time.h"

#include <chrono>
#include <optional>

namespace frustumscreen::tracking {

class TorchShare {
public:
    static constexpr Nanoseconds lies_after = std::chrono::seconds(3);
    static constexpr double still_m = 0.006, still_rad = 0.035;
    static constexpr double taken_m = 0.015, taken_rad = 0.09;
    /// Sine of the light's descent below which it points across the table: 30 degrees.
    static constexpr double across = 0.5;
    static constexpr double comes_s = 0.3, goes_s = 0.8;

    /// `table_from_torch`: none: it is lost. Returns the share, 0..1.
    double update(MonotonicTime now, const std::optional<geometry::RigidTransform>& table_from_torch);
    /// As of the latest update: its light comes, or is there.
    [[nodiscard]] bool lit() const { return lit_; }

private:
    void follow(MonotonicTime now, const geometry::RigidTransform& pose);

    bool lies_ = true, lit_ = false;
    std::optional<geometry::RigidTransform> rested_; ///< where it has been since `still_since_`, or lies
    MonotonicTime still_since_;
    double progress_ = 0.0; ///< of the fade
    std::optional<MonotonicTime> last_;
};

} // namespace frustumscreen::tracking

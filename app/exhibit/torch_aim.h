/// Where a torch's beam goes: whether it meets the object, and where it meets the table.
///
/// Frames   table T, metres; torch: torch.h.
/// Threads  pure; any. Allocates nothing.
#pragma once

#include "app/geometry/transform.h"
#include "app/torch/torch.h"
#include "firmware_host/base/time.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace frustumscreen::exhibit {

/// A sphere around the object that is to be lit.
struct LitObject {
    glm::dvec3 centre_m{0.0};
    double radius_m = 0.0;
};
/// Around points, at the middle of their box.
[[nodiscard]] LitObject around(std::span<const glm::dvec3> points);

enum class TorchAim : std::uint8_t {
    Lights, ///< its beam meets the sphere within its reach
    Past,   ///< it points past it
    TooFar, ///< it points at it from beyond its reach
};
/// A rectangle counts as its circle.
[[nodiscard]] TorchAim aim_of(const torch::Beam& beam, const geometry::RigidTransform& table_from_torch,
                              const LitObject& object);

/// When to tell a visitor that the torch lights nothing: from `dwell` after its beam left the object until it meets it again.
class TorchAdvice {
public:
    static constexpr Nanoseconds dwell = std::chrono::seconds(4);

    /// `aim`: of the torch in the hand; none: there is none. Returns what is wrong; none: nothing is to be said.
    std::optional<TorchAim> step(MonotonicTime now, const std::optional<TorchAim>& aim);

private:
    std::optional<MonotonicTime> since_;
};

/// The ellipse in which a round beam meets the table's plane.
struct TorchSpot {
    glm::dvec2 centre_m{0.0};
    glm::dvec2 along{1.0, 0.0}; ///< unit, away from the torch
    double half_along_m = 0.0, half_across_m = 0.0;
    double share = 0.0; ///< 0..1: softly 0 where the beam grazes the table, or comes from afar

    /// The corners of the rectangle around it: top left, top right, bottom right, bottom left for a reader at the torch.
    [[nodiscard]] std::array<glm::dvec2, 4> corners() const;
};
/// Empty if the edge of the beam does not meet the table.
[[nodiscard]] std::optional<TorchSpot> spot_on_table(const torch::Beam& beam,
                                                     const geometry::RigidTransform& table_from_torch);

} // namespace frustumscreen::exhibit

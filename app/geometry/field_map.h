/// How metal near a tracker bends the places that it reports, as a smooth map that takes them back to where they are.
///
/// Frame    K, the tracker's own, in and out. The map has axes of its own: those of a box around the places that it was measured at.
/// Form     place + the sum of ten vectors times 1, x, y, z, x^2, x y, x z, y^2, y z, z^2; x, y, z are 0 in the box's middle and +-1 at its sides.
/// Bounds   outside the box the shift is that of the nearest place in it: nothing is extrapolated, and it stays continuous.
/// Units    metres.
/// Threads  values; any.
#pragma once

#include "app/geometry/transform.h"

#include <array>

namespace frustumscreen {

struct FieldMap {
    static constexpr std::size_t term_count = 10;
    static constexpr std::array<const char*, term_count> term_names{"one", "x",  "y",  "z",  "xx",
                                                                    "xy",  "xz", "yy", "yz", "zz"};
    using Terms = std::array<double, term_count>;

    RigidTransform box_from_tracker{};            ///< origin in the box's middle
    glm::dvec3 half_m{1.0};                       ///< half the box's sides
    std::array<glm::dvec3, term_count> shift_m{}; ///< of each term, along the box's axes

    /// Of a reported place, in term_names' order; all of them between -1 and 1.
    [[nodiscard]] Terms terms(const glm::dvec3& reported) const;
    /// Where a sensor is that is reported there.
    [[nodiscard]] glm::dvec3 place(const glm::dvec3& reported) const;
};

} // namespace frustumscreen

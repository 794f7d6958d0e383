/// The report of an electromagnetic tracker near metal: the tracker's own arithmetic on a field distorted by
/// an induced dipole.
///
/// The source at the origin of K has three coils, driven one after the other; the metal answers each with its
/// own dipole; the sensor measures the sum, and the tracker treats it as the source's field alone. The
/// resulting distortion is not a polynomial.
/// Frame    K; metres.
/// Source   Raab, Blood, Steiner and Jones, Magnetic position and orientation tracking system, 1979; a
///          sphere's dipole: Jackson, Classical electrodynamics, 5.
/// Threads  values; any.
#pragma once

#include "tests/simulators/table/simulated_table.h"

namespace frustumscreen::simulators {

struct Metal {
    glm::dvec3 in_tracker_m{0.0};
    double strength_m3 = 0.0; ///< minus half the cube of a conducting sphere's radius
    [[nodiscard]] geometry::RigidTransform
    reported(const geometry::RigidTransform& tracker_from_sensor) const;
};

/// A table near metal: the tracker's source stands next to the picture, the metal below the table, and places
/// in the zone are reported up to `bend_m` from their true position.
struct BentTable {
    SimulatedTable table;
    Metal metal;
};
[[nodiscard]] BentTable bent_table(std::uint64_t seed, double bend_m);

} // namespace frustumscreen::simulators

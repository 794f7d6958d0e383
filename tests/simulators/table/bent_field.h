/// What an electromagnetic tracker reports beside metal: the tracker's own arithmetic on a field that an induced dipole bends.
///
/// The source at the origin of K has three coils, one after the other; metal answers each with a dipole of its own; the sensor measures the
/// sum, and the tracker takes it for the source's field alone. Nothing in it is a polynomial.
/// Frame    K; metres.
/// Source   Raab, Blood, Steiner and Jones, Magnetic position and orientation tracking system, 1979; a sphere's dipole: Jackson, Classical electrodynamics, 5.
/// Threads  values; any.
#pragma once

#include "tests/simulators/table/simulated_table.h"

namespace frustumscreen {

struct Metal {
    glm::dvec3 in_tracker_m{0.0};
    double strength_m3 = 0.0; ///< half a conducting sphere's radius, cubed, times -1
    [[nodiscard]] RigidTransform reported(const RigidTransform& tracker_from_sensor) const;
};

/// A table beside metal: the tracker's source stands beside the picture, the metal below the table, and the zone's places are reported up to `bend_m`
/// from where they are.
struct BentTable {
    SimulatedTable table;
    Metal metal;
};
[[nodiscard]] BentTable bent_table(std::uint64_t seed, double bend_m);

} // namespace frustumscreen

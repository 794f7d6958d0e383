/// Seeded poses of prop and eye over the whole allowed zone of a kiosk's settings.
///
/// Zone     prop: anywhere on the table, any yaw, standing; its corners inside the projector's picture; every
///          face that the eye sees is lit. Eye: any azimuth, elevation from the settings' lowest to the
///          zenith (even over the solid angle), distance from the prop's foot between the settings' nearest
///          and farthest.
/// Frames   table frame, metres.
/// Threads  pure; any. The same settings, count and seed give the same poses on every machine.
#pragma once

#include "app/bench/truth/truth.h"
#include "app/settings/settings.h"

#include <cstdint>
#include <vector>

namespace frustumscreen::bench {

struct BenchPose {
    geometry::RigidTransform table_from_prop;
    glm::dvec3 eye_m{0.0}; ///< table frame
};

/// Whether the prop stands on the table and inside the picture, and every face turned to the eye is lit.
[[nodiscard]] bool in_zone(const settings::Settings& settings, const geometry::PropShape& prop,
                           const BenchPose& pose);

/// Errors: the settings leave no such pose (too small a picture, no lit faces).
[[nodiscard]] Result<std::vector<BenchPose>> draw_poses(const settings::Settings& settings,
                                                        const geometry::PropShape& prop, int count,
                                                        std::uint64_t seed);

/// The situation in the prop's frame.
[[nodiscard]] TruthView view_of(const settings::Settings& settings, const BenchPose& pose);

} // namespace frustumscreen::bench

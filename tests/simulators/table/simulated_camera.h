/// A ray-cast camera that looks at a prop with tags on a table under a projector's striped pictures, with the
/// faults of real captures.
///
/// Shares no arithmetic with the code under test, as in simulated_table.h; like a projector, it knows only
/// the stripes that are shown.
/// Frames   table T; camera pixels follow the convention of the projector's: the centre of the top left one
///          is (0.5, 0.5).
/// Threads  values; any.
#pragma once

#include "app/calibration/gray_code.h"
#include "tests/simulators/table/capture_optics.h"
#include "tests/simulators/table/simulated_rests.h"

namespace frustumscreen::simulators {

struct SimulatedCamera {
    int width = 1280;
    int height = 960;
    double focal_px = 1500.0;
    double k1 = -0.08; ///< of its lens; unknown to the code under test
    glm::dmat4 camera_from_table{1.0};

    [[nodiscard]] glm::dvec2 pixel(const glm::dvec3& table_point) const;
    /// A direction in T. Inverts the lens by fixed-point iteration, which converges for its slight
    /// distortion.
    [[nodiscard]] glm::dvec3 ray(const glm::dvec2& pixel) const;
    [[nodiscard]] glm::dvec3 eye() const { return glm::dvec3(glm::inverse(camera_from_table)[3]); }
};
/// A camera next to the projector, looking at the table's middle.
[[nodiscard]] SimulatedCamera some_camera(const SimulatedTable& table);

/// The captures of one rest, restricted to the part of the camera's picture that contains the tags, with
/// their truth.
struct SimulatedCaptures {
    int width = 0;
    int height = 0;
    std::vector<std::vector<std::uint8_t>> pictures; ///< one per pattern
    std::vector<glm::dvec2> true_pixels;             ///< per camera pixel; NaN where it is unlit
    /// Corners found in the camera's picture; NaN for tags outside it.
    std::vector<glm::dvec2> corners;
};
[[nodiscard]] SimulatedCaptures simulated_captures(const SimulatedTable& table, const SimulatedCamera& camera,
                                                   const TagCorners& tags, const glm::dmat4& table_from_prop,
                                                   const calibration::StripeSetup& stripes,
                                                   const CaptureFaults& faults, SeededNumbers& numbers);

} // namespace frustumscreen::simulators

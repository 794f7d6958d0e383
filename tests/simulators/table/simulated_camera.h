/// A camera that looks at a prop with tags on a table under a projector's striped pictures: ray cast, with what spoils real captures.
///
/// The arithmetic is its own, as in simulated_table.h; of the stripes it knows what is shown, as a projector does.
/// Frames   table T; the camera's pixels as the projector's: the centre of the top left one is (0.5, 0.5).
/// Threads  values; any.
#pragma once

#include "app/calibration/gray_code.h"
#include "tests/simulators/table/capture_optics.h"
#include "tests/simulators/table/simulated_rests.h"

namespace frustumscreen {

struct SimulatedCamera {
    int width = 1280;
    int height = 960;
    double focal_px = 1500.0;
    double k1 = -0.08; ///< of its lens; nobody is told
    glm::dmat4 camera_from_table{1.0};

    [[nodiscard]] glm::dvec2 pixel(const glm::dvec3& table_point) const;
    /// A direction in T. The lens is undone by a fixed point, which its slight distortion allows.
    [[nodiscard]] glm::dvec3 ray(const glm::dvec2& pixel) const;
    [[nodiscard]] glm::dvec3 eye() const { return glm::dvec3(glm::inverse(camera_from_table)[3]); }
};
/// Beside the projector, looking at the table's middle.
[[nodiscard]] SimulatedCamera some_camera(const SimulatedTable& table);

/// The captures of one rest, of that part of the camera's picture in which the tags are; and what is true of them.
struct SimulatedCaptures {
    int width = 0;
    int height = 0;
    std::vector<std::vector<std::uint8_t>> pictures; ///< one of each pattern
    std::vector<glm::dvec2> true_pixels; ///< of each of the camera's pixels; NaN where no light comes
    std::vector<glm::dvec2>
        corners; ///< of the tags in the camera's picture, as they are found; NaN for tags out of it
};
[[nodiscard]] SimulatedCaptures simulated_captures(const SimulatedTable& table, const SimulatedCamera& camera,
                                                   const TagCorners& tags, const glm::dmat4& table_from_prop,
                                                   const StripeSetup& stripes, const CaptureFaults& faults,
                                                   SeededNumbers& numbers);

} // namespace frustumscreen

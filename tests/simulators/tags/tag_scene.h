/// A camera's view of a prop with tags on a table: the reference for the pose by tags. It shares no code with
/// the detector; only the printed tag pattern comes from the library.
///
/// Made of rays through each pixel and each moment of the exposure against table, prop and tags; light of the
/// room and the projector's picture, which covers all of it; a defocused lens with distortion; a shutter that
/// is open for a time and reads row after row; photon and sensor noise; the camera's gamma; 8 bits.
/// Frames   table T; pixels as in pinhole.h.
/// Threads  pure; any. One seed gives the same picture with the same C++ library.
#pragma once

#include "app/geometry/pinhole.h"
#include "tests/simulators/tags/scene_surfaces.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace frustumscreen::simulators {

struct SceneCamera {
    geometry::Pinhole pinhole{1280, 720, 1500.0, 1500.0, 640.0, 360.0, {-0.08, 0.02}};
    geometry::RigidTransform table_from_camera;
    double exposure_ms = 5.0;
    double rolling_ms = 0.0;  ///< from the first row's exposure to the last one's; 0: global shutter
    double defocus_px = 0.6;  ///< of the lens, standard deviation
    double read_noise = 1.5;  ///< codes, standard deviation
    double shot_noise = 0.08; ///< codes^2 per code
    double gamma = 2.2;       ///< 1: codes are linear light
};

/// table_from_prop, `t_s` after the start of the first row's exposure.
using PropMotion = std::function<geometry::RigidTransform(double t_s)>;

class TagScene {
public:
    TagScene(geometry::PropShape prop, std::vector<tags::PropTag> tags, const SceneCamera& camera,
             const SceneLight& light);

    /// [height][width], row-major.
    [[nodiscard]] std::vector<std::uint8_t> picture(const PropMotion& motion, std::uint64_t seed) const;
    /// The middle of the exposure of the row that shows the prop's origin, relative to the start of the first
    /// row's exposure.
    [[nodiscard]] double moment_s(const PropMotion& motion) const;
    [[nodiscard]] const SceneCamera& camera() const { return camera_; }
    [[nodiscard]] const std::vector<tags::PropTag>& tags() const { return surfaces_.tags(); }

private:
    [[nodiscard]] std::size_t pixel_at(int row, int column) const;
    [[nodiscard]] std::vector<double> light_seen(const PropMotion& motion) const;
    void defocus(std::vector<double>& light) const;

    SceneSurfaces surfaces_;
    SceneCamera camera_;
    std::vector<glm::dvec3> rays_; ///< [height + 1][width + 1], through the pixels' corners; table T
    std::vector<double> table_;    ///< [height][width], the background without the prop
};

} // namespace frustumscreen::simulators

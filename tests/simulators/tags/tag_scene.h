/// A prop with tags on a table as a camera sees it: the truth against which the tags' pose is held. It shares no code with what
/// finds tags; how a tag is printed alone comes from the library.
///
/// Made of  rays through each pixel and each moment of the exposure against table, prop and tags; light of the room and the
///          projector's picture, which lies on all of it; a defocused lens that distorts; a shutter that is open for a time and
///          reads row after row; noise of light and of the sensor; the camera's gamma; 8 bits.
/// Frames   table T; pixels as pinhole.h has them.
/// Threads  pure; any. The same seed gives the same picture with the same C++ library.
#pragma once

#include "app/geometry/pinhole.h"
#include "tests/simulators/tags/scene_surfaces.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace frustumscreen {

struct SceneCamera {
    Pinhole pinhole{1280, 720, 1500.0, 1500.0, 640.0, 360.0, {-0.08, 0.02}};
    RigidTransform table_from_camera;
    double exposure_ms = 5.0;
    double rolling_ms = 0.0;  ///< from the first row's exposure to the last one's; 0: all at once
    double defocus_px = 0.6;  ///< of the lens, standard deviation
    double read_noise = 1.5;  ///< codes, standard deviation
    double shot_noise = 0.08; ///< codes^2 for each code
    double gamma = 2.2;       ///< 1: codes are light
};

/// table_from_prop, `t_s` after the first row's exposure began.
using PropMotion = std::function<RigidTransform(double t_s)>;

class TagScene {
public:
    TagScene(PropShape prop, std::vector<PropTag> tags, const SceneCamera& camera, const SceneLight& light);

    /// [height][width], row-major.
    [[nodiscard]] std::vector<std::uint8_t> picture(const PropMotion& motion, std::uint64_t seed) const;
    /// The middle of the exposure of the row in which the prop's origin is seen, after the first row's exposure began.
    [[nodiscard]] double moment_s(const PropMotion& motion) const;
    [[nodiscard]] const SceneCamera& camera() const { return camera_; }
    [[nodiscard]] const std::vector<PropTag>& tags() const { return surfaces_.tags(); }

private:
    [[nodiscard]] std::size_t pixel_at(int row, int column) const;
    [[nodiscard]] std::vector<double> light_seen(const PropMotion& motion) const;
    void defocus(std::vector<double>& light) const;

    SceneSurfaces surfaces_;
    SceneCamera camera_;
    std::vector<glm::dvec3> rays_; ///< [height + 1][width + 1], through the pixels' corners; table T
    std::vector<double> table_;    ///< [height][width], what is seen where the prop is not
};

} // namespace frustumscreen

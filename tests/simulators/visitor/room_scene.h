/// A room with a table, a prop and people, seen by a camera that looks across the table at the visitors: the
/// reference for the visitor's eye. It shares no code with the head detector.
///
/// Made of rays through each pixel, and positions of people through each moment of the exposure; the room's
/// lamps, which may be switched or dimmed; the projector's changing picture on prop and table, and its light
/// on clothes, faces and walls; people's shadows on the floor; a lens with distortion; a shutter that is open
/// for a time and reads row after row; photon and sensor noise; the camera's gamma; 8 bits.
/// Frames   table T; pixels as in pinhole.h.
/// Threads  pure; any. One seed gives the same picture with the same C++ library.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"
#include "tests/simulators/visitor/simulated_people.h"

#include <array>
#include <functional>
#include <utility>

namespace frustumscreen::simulators {

struct WatchingCamera {
    /// 640 x 360, 95 degrees wide.
    geometry::Pinhole pinhole{640, 360, 293.0, 293.0, 320.0, 180.0, {-0.06, 0.005}};
    glm::dvec3 place_m{0.0, 0.28, 0.12};
    glm::dvec3 aim_m{0.0, -0.60, 0.44};
    double exposure_ms = 15.0;
    double rolling_ms = 25.0; ///< from the first row's exposure to the last one's; 0: global shutter
    double read_noise = 1.5;  ///< codes, standard deviation
    double shot_noise = 0.08; ///< codes^2 per code
    double gamma = 2.2;
    [[nodiscard]] geometry::RigidTransform table_from_camera() const;
};

struct RoomLight {
    double room = 0.8; ///< white paper under the lamps; 1 is the camera's maximum
    /// White paper on the table under the projector's brightest picture, in addition.
    double projector = 0.6;
};

/// Light at a time, relative to the lamps' usual light and to the projector's brightest picture.
struct LightNow {
    double lamps = 1.0;
    double picture = 0.5;
};

using Lights = std::function<LightNow(double t_s)>;
/// The people present at a time, one body each.
using Bodies = std::function<std::vector<std::vector<Ball>>(double t_s)>;

class RoomScene {
public:
    RoomScene(const WatchingCamera& camera, const RoomLight& light, const glm::dvec2& table_size_m,
              const geometry::PropShape& prop, const glm::dvec3& prop_m);

    /// [height][width]; the first row's exposure begins at `t_s`.
    [[nodiscard]] std::vector<std::uint8_t> picture(const Bodies& bodies, const Lights& lights, double t_s,
                                                    std::uint64_t seed) const;
    [[nodiscard]] const WatchingCamera& camera() const { return camera_; }
    [[nodiscard]] const geometry::RigidTransform& table_from_camera() const { return table_from_camera_; }

private:
    struct Seen {
        float lamps = 0.0F, projector = 0.0F;  ///< contribution of each light
        float away_m = 0.0F;                   ///< along the ray of unit length
        bool is_floor = false, is_lit = false; ///< `is_lit`: directly lit by the projector
    };
    [[nodiscard]] Seen room(const glm::dvec3& direction) const;
    [[nodiscard]] double people_light(const Ball& ball, const glm::dvec3& point_m, const LightNow& now) const;
    [[nodiscard]] std::size_t pixel_at(int row, int column) const;
    /// The columns that may show a body.
    [[nodiscard]] std::pair<int, int> columns_of(const std::vector<Ball>& body) const;
    void meet(const std::vector<Ball>& body, const LightNow& now, std::size_t ray, float& nearest_m,
              double& light) const;
    void add_people(std::vector<double>& light, const Bodies& bodies, const Lights& lights, double t_s) const;

    WatchingCamera camera_;
    geometry::RigidTransform table_from_camera_;
    RoomLight light_;
    glm::dvec2 table_size_m_;
    geometry::PropShape prop_;
    glm::dvec3 prop_m_;
    static constexpr double codes_of_light = 4096.0;
    std::array<std::uint8_t, 4096> code_of_{}; ///< from the camera's gamma
    std::vector<glm::dvec3> rays_;             ///< [height][width], unit, table T
    std::vector<Seen> seen_;                   ///< [height][width]
};

} // namespace frustumscreen::simulators

/// People at the table, as ellipsoids for ray casting: skull, jaw, hair, neck, shoulders, trunk and the arms
/// that hold the prop.
///
/// They share nothing with the head detector: their measures are those of people (breadth, length and height
/// of heads: ANSUR II, 2012; children: Snyder 1977); hair, posture and clothes come from a seed.
/// Frames   table T, metres.
/// Threads  values; pure.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

namespace frustumscreen::simulators {

struct Ball {
    glm::dvec3 middle_m{0.0};
    glm::dmat3 unit_from_table{1.0}; ///< for directions: the surface is where the length is 1
    double radius_m = 0.0;           ///< of the bounding sphere
    double reflectance = 0.5;
};
/// `axes`: unit, orthogonal.
[[nodiscard]] Ball ball(const glm::dvec3& middle_m, const glm::dmat3& axes, const glm::dvec3& half_m,
                        double reflectance);
/// `thick_m` wide, long from end to end.
[[nodiscard]] Ball limb(const glm::dvec3& from_m, const glm::dvec3& to_m, double thick_m, double reflectance);
/// Where a ray enters the ellipsoid; `direction` of any length.
[[nodiscard]] std::optional<double> enter(const Ball& ball, const glm::dvec3& origin_m,
                                          const glm::dvec3& direction);

enum class Build : std::uint8_t { Adult, Child, Seated };
enum class Hair : std::uint8_t { Short, Long, Hat, Bald };

struct Person {
    glm::dvec3 head_m{0.152, 0.193, 0.115}; ///< breadth, length, crown to eyes
    Hair hair = Hair::Short;
    double hair_top_m = 0.02, hair_side_m = 0.012;
    double skin = 0.4, hair_reflectance = 0.1, clothes = 0.3;
    double nods = 0.6;       ///< share of the downward gaze by the head; the eyes do the rest
    double turned_rad = 0.0; ///< the head looks past the prop by this angle
    double sway_m = 0.005;   ///< RMS, per axis of the table's plane
    double phase = 0.0;
    bool holds = true; ///< holds the prop with both hands
};
[[nodiscard]] Person any_person(Build build, std::mt19937_64& random);
/// The point between the eyes of a person of this build, `outside_m` from the table's edge, seen from its
/// middle in direction `azimuth_rad` (0: the front edge's middle, counter-clockwise).
[[nodiscard]] glm::dvec3 any_eye(Build build, double azimuth_rad, double outside_m,
                                 const glm::dvec2& table_size_m, std::mt19937_64& random);
/// Displacement at a time of a person who stands still.
[[nodiscard]] glm::dvec3 sway(const Person& person, double t_s);

/// The body with the eye there, looking at the prop.
[[nodiscard]] std::vector<Ball> body_of(const Person& person, const glm::dvec3& eye_m,
                                        const glm::dvec3& prop_m);

} // namespace frustumscreen::simulators

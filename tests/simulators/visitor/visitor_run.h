/// One visit to the table: people come, stand or walk there and leave, a camera sees them, and the exhibit's
/// own code estimates the eye.
///
/// Frames   table T, metres; azimuth and picture error as seen from the prop.
/// Time     CPU time of this thread alone.
/// Threads  pure except for the clock; any. One seed gives the same visit with the same C++ library.
#pragma once

#include "tests/simulators/visitor/room_scene.h"

#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::simulators {

struct VisitorCase {
    std::string name;
    WatchingCamera camera{};
    RoomLight light{};
    Build build = Build::Adult;
    std::optional<Hair> hair;           ///< nullopt: random
    int people = 1;                     ///< the first holds the prop, the others stand next to the first
    int passers_by = 0;                 ///< people who walk along the wall behind
    double walks_m_s = 0.0;             ///< to and fro along the table
    double farthest_azimuth_deg = 35.0; ///< limit of where a person stands, from the front's middle
    double lamps_drift = 0.0;           ///< share of the lamps' light that varies within ten seconds
    bool lamps_switched = false;        ///< the lamps lose a third of their light before a person comes
    double picture_changes = 1.0;       ///< 0: the projector's picture does not change
    double camera_off_deg = 0.0;        ///< error of the camera's aim in the settings
    double coat_s = -1.0;               ///< time at which a coat is hung on a chair next to the table;
                                        ///< negative: never
};

/// Truth and the exhibit's result at one frame.
struct VisitMoment {
    double t_s = 0.0;
    bool is_there = false;  ///< a visitor has been at the table long enough to be detected
    bool was_there = false; ///< a visitor was there a moment ago
    bool stands = false;    ///< the active visitor has stood there for a second
    bool seen = false;      ///< the exhibit has an eye from the camera
    glm::dvec3 eye_m{0.0};  ///< the active visitor's
    glm::dvec3 shown_eye_m{0.0};
    double said_sd_m = 0.0;
    double ms = 0.0; ///< to read the frame
};

struct Visit {
    glm::dvec3 prop_m{0.0};
    std::vector<VisitMoment> moments;
};

inline constexpr double visit_rate_hz = 30.0;
/// A visitor comes at 2 s and has arrived at 3 s.
[[nodiscard]] Visit run_visit(const VisitorCase& of, double length_s, std::uint64_t seed);
/// No visitor comes to the table; `passers_by` walk behind, the light and the picture change.
[[nodiscard]] Visit run_empty(const VisitorCase& of, double length_s, std::uint64_t seed);

/// Distance on the prop's faces, in mm, between the picture for one eye and the correct one for another: for
/// the points of an upright ellipsoid in the prop, 90 mm wide and 140 mm high, that the true eye sees.
[[nodiscard]] std::vector<double> picture_errors_mm(const glm::dvec3& prop_m, const glm::dvec3& eye_m,
                                                    const glm::dvec3& shown_eye_m);
/// Where that ellipsoid's middle is shown, on the face through which the eye sees it.
[[nodiscard]] glm::dvec3 shown_middle_m(const glm::dvec3& prop_m, const glm::dvec3& eye_m,
                                        const glm::dvec3& shown_eye_m);

} // namespace frustumscreen::simulators

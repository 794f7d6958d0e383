/// One visit to the table: people come, stand or walk there and go, a camera sees them, and the exhibit's own code says where the eye is.
///
/// Frames   table T, metres; azimuth and picture error as seen from the prop.
/// Time     of the processor: this thread's alone.
/// Threads  pure but for the clock; any. The same seed gives the same visit with the same C++ library.
#pragma once

#include "tests/simulators/visitor/room_scene.h"

#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

struct VisitorCase {
    std::string name;
    WatchingCamera camera{};
    RoomLight light{};
    Build build = Build::Adult;
    std::optional<Hair> hair;           ///< nothing: anybody's
    int people = 1;                     ///< the first holds the prop, the others stand beside
    int passers_by = 0;                 ///< who walk along the wall behind
    double walks_m_s = 0.0;             ///< to and fro along the table
    double farthest_azimuth_deg = 35.0; ///< from the front's middle, that somebody stands
    double lamps_drift = 0.0;           ///< share of the lamps' light that comes and goes within ten seconds
    bool lamps_switched = false;        ///< a third of their light goes before anybody comes
    double picture_changes = 1.0;       ///< 0: the projector's picture stays as it is
    double camera_off_deg = 0.0;        ///< what the settings say of its aim is wrong by that
    double coat_s = -1.0;               ///< a coat is hung on a chair beside the table, from then on
};

/// What was the case, and what the exhibit made of it, at one frame.
struct VisitMoment {
    double t_s = 0.0;
    bool is_there = false;  ///< somebody is at the table, for long enough to be seen
    bool was_there = false; ///< somebody was, a moment ago
    bool stands = false;    ///< the holder has stood there for a second
    bool seen = false;      ///< the exhibit has an eye by the camera
    glm::dvec3 eye_m{0.0};  ///< the holder's
    glm::dvec3 shown_eye_m{0.0};
    double said_sd_m = 0.0;
    double ms = 0.0; ///< to read the frame
};

struct Visit {
    glm::dvec3 prop_m{0.0};
    std::vector<VisitMoment> moments;
};

inline constexpr double visit_rate_hz = 30.0;
/// Somebody comes at 2 s and has arrived at 3.
[[nodiscard]] Visit run_visit(const VisitorCase& of, double length_s, std::uint64_t seed);
/// Nobody comes to the table; `passers_by` walk behind, the light and the picture change.
[[nodiscard]] Visit run_empty(const VisitorCase& of, double length_s, std::uint64_t seed);

/// How far what is shown for one eye lies from where it should for another, mm on the prop's faces: of the points of an upright ellipsoid
/// in the prop, 90 mm wide and 140 mm high, that the true eye sees.
[[nodiscard]] std::vector<double> picture_errors_mm(const glm::dvec3& prop_m, const glm::dvec3& eye_m,
                                                    const glm::dvec3& shown_eye_m);
/// Where that ellipsoid's middle is shown on the face that the eye sees it through.
[[nodiscard]] glm::dvec3 shown_middle_m(const glm::dvec3& prop_m, const glm::dvec3& eye_m,
                                        const glm::dvec3& shown_eye_m);

} // namespace frustumscreen

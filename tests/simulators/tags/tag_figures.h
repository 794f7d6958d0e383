/// Accuracy of the pose by tags: rendered scenes of one kind each, detected and fitted like in the exhibit.
///
/// Truth    the pose in the middle of the exposure of the prop's row.
/// Time     CPU time of this thread alone: detection, and fit.
/// Threads  pure except for the clock; any. One seed gives the same poses and pictures with the same C++
///          library.
#pragma once

#include "tests/simulators/tags/skirt.h"
#include "tests/simulators/tags/tag_scene.h"

#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace frustumscreen::simulators {

struct TagCase {
    std::string name;
    Skirt skirt{};
    std::size_t tags = 0; ///< the first tags of the skirt; 0: all
    double distance_m = 1.3;
    SceneCamera camera{}; ///< its pose is set by `distance_m`
    SceneLight light{};
    double speed_m_s = 0.0;
    double turn_deg_s = 0.0;
    /// A different motion for each picture, as displacement and rotation on the table since its beginning;
    /// empty: the speeds above.
    std::function<PropMotion(std::mt19937_64&)> motion{};
    double decimate = 1.0;         ///< 2: detected at half size
    bool is_shutter_known = false; ///< compensates the rolling shutter, after three previous frames at 30 per
                                   ///< second
};

struct TagFigures {
    std::string name;
    std::size_t pictures = 0;
    double posed = 0.0;      ///< share of the pictures that give a pose
    double trusted = 0.0;    ///< share that the exhibit would follow (is_sure)
    double tags = 0.0;       ///< found, mean
    double off_mm[2]{};      ///< distance from the truth of accepted poses: median, 95th percentile
    double off_deg[2]{};     ///< angle to the truth: median, 95th percentile
    double worst_mm = 0.0;   ///< among accepted poses
    double said_mm = 0.0;    ///< median of their reported standard deviation
    double normalised = 0.0; ///< RMS of position error over reported deviation: 1 is consistent
    double find_ms[2]{};     ///< median, 95th percentile
    double fit_ms = 0.0;     ///< median
};

/// The case with its rolling time known from the settings.
[[nodiscard]] TagCase with_known_shutter(TagCase rolling);
[[nodiscard]] std::vector<TagCase> tag_cases();
[[nodiscard]] TagFigures measure(const TagCase& of, std::size_t pictures, std::uint64_t seed);
[[nodiscard]] std::string table_of(const std::vector<TagFigures>& figures);
[[nodiscard]] std::string csv_of(const std::vector<TagFigures>& figures);

} // namespace frustumscreen::simulators

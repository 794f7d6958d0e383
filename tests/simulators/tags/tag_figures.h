/// What the tags' pose is worth: rendered scenes of one kind each, found and fitted as the exhibit does.
///
/// Truth    the pose in the middle of the exposure of the prop's row.
/// Time     of the processor, of this thread alone: the finding, and the fit.
/// Threads  pure but for the clock; any. The same seed gives the same poses and pictures with the same C++ library.
#pragma once

#include "tests/simulators/tags/skirt.h"
#include "tests/simulators/tags/tag_scene.h"

#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace frustumscreen {

struct TagCase {
    std::string name;
    Skirt skirt{};
    std::size_t tags = 0; ///< the first ones of the skirt; 0: all
    double distance_m = 1.3;
    SceneCamera camera{}; ///< its pose is set by `distance_m`
    SceneLight light{};
    double speed_m_s = 0.0;
    double turn_deg_s = 0.0;
    /// Another motion for each picture, as displacement and turn on the table since its beginning; none: at the speeds above.
    std::function<PropMotion(std::mt19937_64&)> motion{};
    double decimate = 1.0;         ///< 2: searched at half size
    bool is_shutter_known = false; ///< the rolling is taken out, after three frames before at 30 a second
};

struct TagFigures {
    std::string name;
    std::size_t pictures = 0;
    double posed = 0.0;      ///< share of the pictures that give a pose
    double trusted = 0.0;    ///< share that the exhibit would follow (is_sure)
    double tags = 0.0;       ///< found, mean
    double off_mm[2]{};      ///< distance from the truth of those taken: median, 95th percentile
    double off_deg[2]{};     ///< the same of the angle
    double worst_mm = 0.0;   ///< of those taken
    double said_mm = 0.0;    ///< median of the spread that they say
    double normalised = 0.0; ///< RMS of error by said spread, of the place: 1 is honest
    double find_ms[2]{};     ///< median, 95th percentile
    double fit_ms = 0.0;     ///< median
};

/// The same, and what it rolls is in the settings.
[[nodiscard]] TagCase with_known_shutter(TagCase rolling);
[[nodiscard]] std::vector<TagCase> tag_cases();
[[nodiscard]] TagFigures measure(const TagCase& of, std::size_t pictures, std::uint64_t seed);
[[nodiscard]] std::string table_of(const std::vector<TagFigures>& figures);
[[nodiscard]] std::string csv_of(const std::vector<TagFigures>& figures);

} // namespace frustumscreen

#include "app/bench/mixed/mixed_walk.h"

#include "app/bench/truth/seeded_draw.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::bench {

namespace {

/// Between -1 and 1.
class Wave {
public:
    explicit Wave(SeededDraw& draw)
        : slow_hz_(draw.between(0.10, 0.20)), quick_hz_(draw.between(0.25, 0.40)),
          slow_(draw.between(0.0, 1.0)), quick_(draw.between(0.0, 1.0)) {}
    [[nodiscard]] double at(double seconds) const {
        const auto wave = [seconds](double hz, double phase) {
            return std::sin(2.0 * std::numbers::pi * (hz * seconds + phase));
        };
        return 0.7 * wave(slow_hz_, slow_) + 0.3 * wave(quick_hz_, quick_);
    }

private:
    double slow_hz_, quick_hz_, slow_, quick_;
};

struct Path {
    Wave x, y, yaw, azimuth, elevation, distance;
    double first_yaw, first_azimuth;

    explicit Path(SeededDraw& draw)
        : x(draw), y(draw), yaw(draw), azimuth(draw), elevation(draw), distance(draw),
          first_yaw(draw.between(-std::numbers::pi, std::numbers::pi)),
          first_azimuth(draw.between(-std::numbers::pi, std::numbers::pi)) {}

    /// `slid`: share of the table's half width and depth that the prop's middle may reach.
    [[nodiscard]] BenchPose at(double seconds, const settings::Settings& settings, double slid) const {
        const double yaw_rad = first_yaw + 0.8 * yaw.at(seconds);
        const glm::dvec3 foot(slid * 0.5 * settings.table.width_m * x.at(seconds),
                              slid * 0.5 * settings.table.depth_m * y.at(seconds), 0.0);
        const double lowest = settings.eye.lowest_elevation_deg * std::numbers::pi / 180.0;
        const double highest = 0.45 * std::numbers::pi;
        const double up = 0.5 * (lowest + highest) + 0.5 * (highest - lowest) * elevation.at(seconds);
        const double around = first_azimuth + 1.2 * azimuth.at(seconds);
        const double away_m = 0.5 * (settings.eye.nearest_m + settings.eye.farthest_m) +
                              0.5 * (settings.eye.farthest_m - settings.eye.nearest_m) * distance.at(seconds);
        const glm::dvec3 towards_eye(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around),
                                     std::sin(up));
        return {{glm::angleAxis(yaw_rad, glm::dvec3(0.0, 0.0, 1.0)), foot}, foot + away_m * towards_eye};
    }
};

} // namespace

Result<std::vector<BenchPose>> draw_walk(const settings::Settings& settings, const geometry::PropShape& prop,
                                         int frames, std::uint64_t seed) {
    constexpr int max_tries = 2000;
    SeededDraw draw(seed);
    for (int tries = 0; tries < max_tries; ++tries) {
        const Path path(draw);
        const double slid = 0.4 * (1.0 - static_cast<double>(tries) / max_tries);
        std::vector<BenchPose> poses;
        for (int frame = 0; frame < frames; ++frame) {
            poses.push_back(path.at(frame / walk_hz, settings, slid));
            if (!in_zone(settings, prop, poses.back())) {
                break;
            }
        }
        if (static_cast<int>(poses.size()) == frames &&
            (frames == 0 || in_zone(settings, prop, poses.back()))) {
            return poses;
        }
    }
    return fail(
        ErrorKind::BadConfiguration, "bench.no_lit_walk",
        "no path of {} frames keeps the prop inside the picture and every face lit that is seen; move the "
        "projector higher or make the prop smaller",
        frames);
}

} // namespace frustumscreen::bench

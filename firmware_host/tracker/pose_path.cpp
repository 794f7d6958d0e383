#include "firmware_host/tracker/pose_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <map>

namespace frustumscreen::tracker {

namespace {

constexpr Nanoseconds::rep max_periods = 1'000'000;

double seconds_of(const PoseSample& sample) {
    return to_seconds(sample.time - MonotonicTime{});
}

PoseSample between(const PoseSample& from, const PoseSample& to, MonotonicTime time) {
    const double s = to_seconds(time - from.time) / to_seconds(to.time - from.time);
    const double share = s * s * s * (10.0 + s * (6.0 * s - 15.0));
    PoseSample sample = from;
    sample.time = time;
    sample.position_m = from.position_m + share * (to.position_m - from.position_m);
    sample.rotation = glm::normalize(glm::slerp(from.rotation, to.rotation, share));
    return sample;
}

/// Adds the pose of one station at `time`; none before its first key and after its last one.
void add_pose(std::span<const PoseSample> keys, MonotonicTime time, std::vector<PoseSample>& path) {
    const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                        [](MonotonicTime t, const PoseSample& key) { return t < key.time; });
    if (after == keys.begin()) {
        return;
    }
    const PoseSample& from = *(after - 1);
    if (after == keys.end()) {
        if (from.time == time) {
            path.push_back(from);
        }
        return;
    }
    path.push_back(from.ok && after->ok ? between(from, *after, time) : from);
    path.back().time = time;
}

} // namespace

Result<std::vector<PoseSample>> pose_path(std::span<const PoseSample> keys, Nanoseconds period) {
    assert(period > Nanoseconds(0));
    std::vector<PoseSample> path;
    if (keys.empty()) {
        return path;
    }
    std::map<int, std::vector<PoseSample>> stations;
    for (const PoseSample& key : keys) {
        std::vector<PoseSample>& of_station = stations[key.station];
        if (!of_station.empty() && key.time <= of_station.back().time) {
            return bad_input(
                "poses.order",
                "a pose of station {} at {:.3f} s follows one at {:.3f} s; put them in the order of "
                "their times",
                key.station, seconds_of(key), seconds_of(of_station.back()));
        }
        of_station.push_back(key);
    }
    const auto earlier = [](const PoseSample& a, const PoseSample& b) { return a.time < b.time; };
    const auto [first, last] = std::minmax_element(keys.begin(), keys.end(), earlier);
    if ((last->time - first->time) / period > max_periods) {
        return bad_input("poses.too_many",
                         "its poses span {:.0f} s, more than {} periods; give it fewer poses a second, or a "
                         "shorter path",
                         to_seconds(last->time - first->time), max_periods);
    }
    for (MonotonicTime time = first->time; time <= last->time; time += period) {
        for (const auto& [station, of_station] : stations) {
            add_pose(of_station, time, path);
        }
    }
    return path;
}

} // namespace frustumscreen::tracker

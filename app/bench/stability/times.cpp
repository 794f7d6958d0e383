// Possible sequences of times: standing still, backwards, by a nanosecond, by ten seconds, out of order; and
// real recordings.

#include "app/bench/stability/themes.h"
#include "app/settings/settings.h"
#include "app/tracking/pose_frames.h"
#include "app/tracking/tracked_state.h"
#include "firmware_host/base/file.h"
#include "firmware_host/tracker/convert_recording.h"
#include "firmware_host/tracker/replay_tracker.h"
#include "firmware_host/tracker/simulated_tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <sstream>

namespace frustumscreen::bench {

namespace {

using std::chrono::nanoseconds;

/// Every kind of step that a clock may make, in random order.
std::vector<MonotonicTime> odd_times(std::size_t count, unsigned seed) {
    const std::array<Nanoseconds, 8> steps{Nanoseconds(0),
                                           Nanoseconds(1),
                                           Nanoseconds(-1),
                                           std::chrono::microseconds(1),
                                           std::chrono::milliseconds(16),
                                           std::chrono::seconds(10),
                                           std::chrono::seconds(-3),
                                           std::chrono::milliseconds(-20)};
    std::mt19937 random(seed);
    std::vector<MonotonicTime> times;
    MonotonicTime now = from_microseconds(1'000'000);
    for (std::size_t k = 0; k < count; ++k) {
        now += steps[random() % steps.size()];
        times.push_back(now);
    }
    return times;
}

tracker::PoseSample sample_at(MonotonicTime time, double x) {
    tracker::PoseSample sample;
    sample.time = time;
    sample.position_m = {x, 0.0, 0.0};
    return sample;
}

/// Compares with the plain rule: the latest of all samples so far, and among equal times the last one.
StabilityResult situations(const StabilityOptions&) {
    tracking::TrackedStateTracker tracker(glm::dvec3(0.0));
    double wrong = 0.0;
    std::optional<tracker::PoseSample> latest;
    double x = 0.0;
    for (const MonotonicTime time : odd_times(20'000, 3)) {
        const tracker::PoseSample sample = sample_at(time, x += 1.0);
        if (!tracker.take(sample)) {
            wrong += 1.0;
        }
        latest = !latest || sample.time >= latest->time ? sample : latest;
        const tracking::TrackedState now = tracker.at(latest->time + nanoseconds(7));
        wrong += now.table_from_prop.translation.x == latest->position_m.x && now.prop_age == nanoseconds(7)
                     ? 0
                     : 1;
    }
    return {{{"of 20000 samples with steps of 0, +-1 ns, -3 s, 10 s, other than the latest", 0.0, wrong}}};
}

/// Each sample is delivered once, in order, at its time, at any polling rate.
StabilityResult replays(const StabilityOptions&) {
    std::vector<tracker::PoseSample> recording;
    for (const MonotonicTime time : odd_times(2'000, 4)) {
        recording.push_back(sample_at(time, static_cast<double>(recording.size())));
    }
    const auto [low, high] = std::minmax_element(
        recording.begin(), recording.end(),
        [](const tracker::PoseSample& a, const tracker::PoseSample& b) { return a.time < b.time; });
    const Nanoseconds length = high->time - low->time;
    const MonotonicTime start = from_microseconds(5);
    double wrong = 0.0;
    for (const Nanoseconds step :
         {Nanoseconds(std::chrono::milliseconds(16)), Nanoseconds(std::chrono::seconds(10))}) {
        tracker::ReplayTracker tracker(recording, start, false);
        std::vector<tracker::PoseSample> samples;
        for (MonotonicTime now = start; now < start + length + step; now += step) {
            for (const Nanoseconds odd : {Nanoseconds(0), Nanoseconds(0), Nanoseconds(-1), Nanoseconds(1)}) {
                wrong += tracker.poll(now + odd, samples) ? 0.0 : 1.0;
                wrong += samples.empty() || samples.back().time <= now + nanoseconds(1) ? 0.0 : 1.0;
            }
        }
        wrong += samples.size() == recording.size() ? 0.0 : 1.0;
        wrong += std::is_sorted(samples.begin(), samples.end(),
                                [](const tracker::PoseSample& a, const tracker::PoseSample& b) {
                                    return a.time < b.time;
                                })
                     ? 0.0
                     : 1.0;
    }
    // A recording of two nanoseconds, repeated, after ten seconds: whole rounds are skipped except the latest
    // one and the one that has begun.
    constexpr double two_rounds = 2.0 * 2.0;
    tracker::ReplayTracker shortest({sample_at(start, 0.0), sample_at(start + nanoseconds(1), 1.0)}, start,
                                    true);
    std::vector<tracker::PoseSample> samples;
    wrong += shortest.poll(start + std::chrono::seconds(10), samples) ? 0.0 : 1.0;
    return {{{"samples twice, missing, early or out of order", 0.0, wrong},
             {"samples at once of a recording of 2 ns, after 10 s", two_rounds,
              static_cast<double>(samples.size())}}};
}

/// The simulated visitor is a function of time: polls at any rhythm return the same samples, which move no
/// faster than a person, also between movements.
StabilityResult simulated(const StabilityOptions&) {
    tracker::SimulatedVisitor visitor;
    visitor.rate_hz = 1000.0;
    std::array<std::vector<tracker::PoseSample>, 3> samples;
    const std::array<Nanoseconds, 3> steps{std::chrono::microseconds(731), std::chrono::milliseconds(17),
                                           std::chrono::seconds(10)};
    for (std::size_t k = 0; k < steps.size(); ++k) {
        tracker::SimulatedTracker tracker(visitor, MonotonicTime{});
        for (Nanoseconds t(0); t <= std::chrono::seconds(40); t += steps[k]) {
            (void)tracker.poll(MonotonicTime(t), samples[k]);
        }
        (void)tracker.poll(MonotonicTime(std::chrono::seconds(40)), samples[k]);
    }
    double other = 0.0;
    double fastest_m_s = 0.0;
    for (std::size_t j = 0; j < samples[0].size(); ++j) {
        for (std::size_t k = 1; k < samples.size(); ++k) {
            const bool same = samples[k].size() == samples[0].size() &&
                              samples[k][j].position_m == samples[0][j].position_m &&
                              samples[k][j].rotation == samples[0][j].rotation &&
                              samples[k][j].time == samples[0][j].time;
            other += same ? 0.0 : 1.0;
        }
        if (j >= 2) {
            fastest_m_s = std::fmax(
                fastest_m_s, glm::distance(samples[0][j].position_m, samples[0][j - 2].position_m) * 1e3);
        }
    }
    // Minimum jerk peaks at 15/8 of the mean speed (Flash and Hogan 1985). A movement takes at least 0.3 x 4
    // s; a parabola within the zone begins and ends at twice its mean rate at most, over the zone's diagonal.
    const double max_m_s = 1.875 * 2.0 * 2.0 * glm::length(visitor.half_extent_m) / (0.3 * 4.0);
    return {{{"samples other than with polls every 0.7 ms: 17 ms, 10 s", 0.0, other},
             {"fastest movement of prop and head, m/s", max_m_s, fastest_m_s}}};
}

/// The result of a curator's file of poses does not depend on the order of its rows.
StabilityResult frames(const StabilityOptions&) {
    std::vector<tracker::PoseSample> rows;
    for (int k = 0; k < 2000; ++k) {
        const int frame = k / 2;
        rows.push_back(sample_at(from_microseconds(std::int64_t{1000} * frame), frame));
        rows.back().station = k % 2 == 0 ? tracker::prop_station : tracker::head_station;
    }
    const std::vector<tracking::TrackedState> sorted = tracking::pose_frames(rows, glm::dvec3(0.0));
    std::shuffle(rows.begin(), rows.end(), std::mt19937(6));
    const std::vector<tracking::TrackedState> shuffled = tracking::pose_frames(rows, glm::dvec3(0.0));
    double wrong = sorted.size() == 1000 && shuffled.size() == 1000 ? 0.0 : 1.0;
    for (std::size_t k = 0; wrong == 0.0 && k < sorted.size(); ++k) {
        wrong += sorted[k].time == shuffled[k].time && sorted[k].eye_m == shuffled[k].eye_m &&
                         sorted[k].table_from_prop.translation == shuffled[k].table_from_prop.translation
                     ? 0.0
                     : 1.0;
    }
    return {{{"frames other than of the sorted file", 0.0, wrong}}};
}

/// Times of a recording's rows as written in the file, parsed independently.
std::vector<double> times_in(const std::string& text) {
    std::vector<double> times;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty() && line.front() != '#') {
            times.push_back(std::strtod(line.c_str(), nullptr));
        }
    }
    return times;
}

StabilityResult recordings(const StabilityOptions& options) {
    StabilityResult result;
    for (const std::string name : {"vicon_handheld_1.csv", "camera_target_handheld_1.csv",
                                   "tum_fr1_xyz_groundtruth.txt", "tum_fr1_xyz_rgbdslam.txt"}) {
        const Result<Bytes> bytes = read_file(options.recordings / name);
        if (!bytes) {
            result.left_out = "real recordings: " + bytes.error().message;
            continue;
        }
        const std::string text(as_text(*bytes));
        const Result<tracker::ConvertedRecording> recording = tracker::convert_recording(text, name, {});
        if (!recording) {
            result.rows.push_back({"refused: " + recording.error().message, 0.0, 1.0});
            continue;
        }
        const std::vector<tracker::PoseSample>& samples = recording->samples;
        double wrong = 0.0;
        double not_unit = 0.0;
        for (std::size_t k = 0; k < samples.size(); ++k) {
            not_unit = std::fmax(not_unit, std::abs(glm::length(samples[k].rotation) - 1.0));
            wrong += k == 0 || samples[k].time > samples[k - 1].time ? 0.0 : 1.0;
            wrong += k == 0 || glm::dot(samples[k].rotation, samples[k - 1].rotation) >= 0.0 ? 0.0 : 1.0;
        }
        const std::vector<double> times = times_in(text);
        std::size_t forward = times.empty() ? 0 : 1; // compared in microseconds, like poses
        std::int64_t last_us = 0;
        for (const double t : times) {
            const std::int64_t t_us = std::llround((t - times.front()) * 1e6);
            forward += t_us > last_us ? 1 : 0;
            last_us = std::max(last_us, t_us);
        }
        wrong += samples.size() == forward ? 0.0 : 1.0;
        wrong +=
            samples.size() + static_cast<std::size_t>(recording->dropped_rows) == times.size() ? 0.0 : 1.0;
        // Deliver each pair in the wrong order: the later sample of the pair counts.
        tracking::TrackedStateTracker tracker(glm::dvec3(0.0));
        for (std::size_t k = 0; k + 1 < samples.size(); k += 2) {
            wrong += tracker.take(samples[k + 1]) && tracker.take(samples[k]) ? 0.0 : 1.0;
            wrong += tracker.at(samples[k + 1].time).table_from_prop.translation == samples[k + 1].position_m
                         ? 0
                         : 1;
        }
        result.rows.push_back(
            {fmt::format("{}, {} poses: out of order, flipped, lost", name, samples.size()), 0.0, wrong});
        result.rows.push_back({fmt::format("{}: quaternions off unit", name), 4 * 0x1p-53, not_unit});
    }
    return result;
}

/// A panel script that would repeat endlessly within a frame is refused.
StabilityResult scripts(const StabilityOptions&) {
    double wrong = 0.0;
    for (const std::string repeat : {"1e-9", "1e-6", "0.01", "-1.0", "nan", "inf"}) {
        wrong += settings::parse_settings("[panel]\nrepeat_s = " + repeat +
                                              "\n[[panel.script]]\nat_s = 0.0\nbutton = 1\n",
                                          "kiosk.toml")
                     ? 1.0
                     : 0.0;
    }
    const auto usual = settings::parse_settings(
        "[panel]\nrepeat_s = 2.0\n[[panel.script]]\nat_s = 0.5\nbutton = 1\n", "kiosk.toml");
    wrong += usual ? 0.0 : 1.0;
    return {{{"repeated every 1 ns to 10 ms, taken, or a usual one refused", 0.0, wrong}}};
}

} // namespace

std::vector<StabilityCase> time_cases() {
    const std::string theme = "time";
    return {{theme, "samples at odd times", FloatingPoint::Strict, situations},
            {theme, "replayed recordings", FloatingPoint::Strict, replays},
            {theme, "the simulated visitor", FloatingPoint::Strict, simulated},
            {theme, "pose files out of order", FloatingPoint::Strict, frames},
            {theme, "a panel's script", FloatingPoint::Free, scripts},
            {theme, "real recordings", FloatingPoint::Strict, recordings}};
}

} // namespace frustumscreen::bench

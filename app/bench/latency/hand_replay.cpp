#include "app/bench/latency/hand_replay.h"

#include "app/bench/latency/best_weights.h"
#include "app/tracking/held_filter.h"
#include "firmware_host/base/quantile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <utility>

namespace frustumscreen::bench {

namespace {

constexpr double turn_m = 0.010;
constexpr double around_turn_s = 0.12;

struct Turn {
    std::size_t picture = 0;
    double sign = 1.0; ///< 1: a maximum
};

/// Where `values` turn back: the extremes between two ways of at least `turn_m`.
std::vector<Turn> turns_of(const std::vector<double>& values) {
    std::vector<Turn> turns;
    std::size_t extreme[2] = {0, 0}; // the lowest and the highest since the latest turn
    int rises = 0;                   // 0: not known yet
    for (std::size_t k = 0; k < values.size(); ++k) {
        extreme[0] = values[k] < values[extreme[0]] ? k : extreme[0];
        extreme[1] = values[k] > values[extreme[1]] ? k : extreme[1];
        const bool fell = values[extreme[1]] - values[k] > turn_m;
        const bool rose = values[k] - values[extreme[0]] > turn_m;
        if (rises >= 0 && fell) {
            if (rises > 0) {
                turns.push_back({extreme[1], 1.0});
            }
            rises = -1;
            extreme[0] = extreme[1] = k;
        } else if (rises <= 0 && rose) {
            if (rises < 0) {
                turns.push_back({extreme[0], -1.0});
            }
            rises = 1;
            extreme[0] = extreme[1] = k;
        }
    }
    return turns;
}

Slip slip_from(const std::vector<double>& values) {
    const double count = static_cast<double>(std::max<std::size_t>(values.size(), 1));
    return {std::accumulate(values.begin(), values.end(), 0.0) / count, quantile(values, 0.95),
            std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) / count)};
}

HandMotion faster(const std::vector<RecordedPose>& poses, double times) {
    return [hand = recorded(poses), begin_s = poses.front().t_s, times](double t_s) {
        return hand(begin_s + times * t_s);
    };
}

std::vector<ComparedFilter> compared_hand_filters(double lever_m) {
    using tracking::MotionFilter, tracking::PoseNoise;
    return {
        {"for the table",
         [](const PoseNoise& noise) {
             return std::make_unique<MotionFilter>(tracking::exhibit_filter(noise));
         }},
        {"constant velocity",
         [](const PoseNoise& noise) {
             return std::make_unique<MotionFilter>(tracking::constant_velocity_filter(noise));
         }},
        {"for the hand",
         [](const PoseNoise& noise) { return std::make_unique<MotionFilter>(tracking::hand_filter(noise)); }},
        {"exhibit, as shown",
         [lever_m](const PoseNoise& noise) { return std::make_unique<tracking::HeldFilter>(noise, lever_m); },
         true, true}};
}

} // namespace

Slip overshoot_at_turns(std::span<const LitPicture> pictures) {
    std::vector<double> beyond_mm;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> truth;
        for (const LitPicture& picture : pictures) {
            truth.push_back(picture.truth.translation[axis]);
        }
        for (const Turn& turn : turns_of(truth)) {
            double beyond = 0.0;
            for (const LitPicture& picture : pictures) {
                if (std::abs(picture.lit_s - pictures[turn.picture].lit_s) < around_turn_s) {
                    beyond = std::fmax(beyond,
                                       turn.sign * (picture.drawn.translation[axis] - truth[turn.picture]));
                }
            }
            beyond_mm.push_back(1e3 * beyond);
        }
    }
    return slip_from(beyond_mm);
}

std::vector<ReplayResult> replay(const PoseRecording& recording, const TrackedBy& tracker,
                                 const LatencyOptions& options) {
    std::vector<ReplayResult> results;
    const double lever_m = options.setting.lever_m;
    for (const double times : {1.0, 2.0, 4.0}) {
        const double length_s = (recording.poses.back().t_s - recording.poses.front().t_s) / times;
        const HandMotion hand = faster(recording.poses, times);
        for (const bool on_table : {false, true}) {
            const HandMotion motion = on_table ? slid(hand, 0.0) : hand;
            const auto add = [&](const std::string& filter_name, const std::vector<LitPicture>& pictures) {
                results.push_back({.tracker = tracker.name,
                                   .recording = recording.name,
                                   .filter_name = filter_name,
                                   .times = times,
                                   .on_table = on_table,
                                   .slip = slip_of(pictures, lever_m),
                                   .overshoot = overshoot_at_turns(pictures)});
            };
            for (const ComparedFilter& compared : compared_hand_filters(lever_m)) {
                add(compared.name,
                    lit_pictures(motion, length_s, tracker, options.setting, compared, options.seed));
            }
            add("best weights",
                pictures_by_best_weights(tracked_samples(motion, length_s, tracker, options.seed), motion,
                                         length_s, tracker, options.setting));
        }
    }
    return results;
}

std::string replay_table(std::span<const ReplayResult> results) {
    std::string text =
        "recordings in the hand and flattened onto the table, mm: slip mean, 95th percentile, RMS; "
        "overshoot mean, 95th percentile\n";
    std::string before;
    for (const ReplayResult& result : results) {
        const std::string head = fmt::format("{}, {}, {:g} times, {}\n", result.tracker, result.recording,
                                             result.times, result.on_table ? "on the table" : "in the hand");
        text += head != before ? head : std::string();
        before = head;
        text += fmt::format("  {:<29} {:6.2f} {:6.2f} {:6.2f}   {:6.2f} {:6.2f}\n", result.filter_name,
                            result.slip.mean, result.slip.p95, result.slip.rms, result.overshoot.mean,
                            result.overshoot.p95);
    }
    return text;
}

std::string replay_csv(std::span<const ReplayResult> results) {
    std::string text = "tracker,recording,contestant,times,where,slip_mean_mm,slip_p95_mm,slip_rms_mm,"
                       "overshoot_mean_mm,overshoot_p95_mm\n";
    for (const ReplayResult& result : results) {
        text += fmt::format("\"{}\",\"{}\",\"{}\",{:g},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}\n",
                            result.tracker, result.recording, result.filter_name, result.times,
                            result.on_table ? "table" : "hand", result.slip.mean, result.slip.p95,
                            result.slip.rms, result.overshoot.mean, result.overshoot.p95);
    }
    return text;
}

} // namespace frustumscreen::bench

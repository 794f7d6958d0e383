/// Frame times of several techniques, taken in one interleaved run: disturbances of the machine then affect
/// all of them alike. The order is shuffled for every pose.
///
/// Cost     one time = one full redraw with glFinish, no read-back. Wall time is the measure of
///          docs/conventions.md; the process's CPU time over all threads is kept too, because other programs
///          on the machine lengthen the wall time. A ratio below 1 is possible: the floor textures the whole
///          prop, a slender artifact only its own pixels.
/// Threads  the one whose context is current.
#pragma once

#include "app/bench/techniques/technique.h"
#include "app/render/read_back.h"

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

namespace frustumscreen::bench {

/// Called repeatedly with the completed share, 0..1.
using Progress = std::function<void(double done)>;

struct Spread {
    double median = 0.0;
    double p10 = 0.0;
    double p90 = 0.0;
};
[[nodiscard]] Spread spread_of(const std::vector<double>& values);

/// Processor time of this process, all threads.
[[nodiscard]] double cpu_now_ms();

/// Processor time until what `draw` draws is complete.
template <typename Draw> [[nodiscard]] double ms_of(const Draw& draw) {
    const double start_ms = cpu_now_ms();
    draw();
    render::wait_until_drawn();
    return cpu_now_ms() - start_ms;
}
/// `min_ms`: a frame's least time of several passes, first infinite.
template <typename Draw> void keep_min_ms(double& min_ms, const Draw& draw) {
    min_ms = std::min(min_ms, ms_of(draw));
}

struct TimingPlan {
    int rounds = 3; ///< how often every technique draws each pose
    int warm_up = 2;
};

struct FrameTimes {
    std::vector<double> wall_ms; ///< one per round and pose
    std::vector<double> cpu_ms;
};
/// One entry per technique.
[[nodiscard]] std::vector<FrameTimes> time_interleaved(std::span<Technique* const> techniques,
                                                       std::span<const BenchPose> poses,
                                                       const TimingPlan& plan, const Progress& progress);

} // namespace frustumscreen::bench

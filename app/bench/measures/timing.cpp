#include "app/bench/measures/timing.h"

#include "firmware_host/base/quantile.h"
#include "firmware_host/gl/gl_handle.h"

#include <chrono>
#include <ctime>
#include <numeric>
#include <random>
#include <utility>

namespace frustumscreen::bench {

double cpu_now_ms() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

namespace {

void time_one(Technique& technique, const BenchPose& pose, FrameTimes& times) {
    const double cpu_start_ms = cpu_now_ms();
    const auto start = std::chrono::steady_clock::now();
    technique.draw_timed(pose);
    glFinish();
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    times.wall_ms.push_back(wall.count());
    times.cpu_ms.push_back(cpu_now_ms() - cpu_start_ms);
}

/// A new order for every pose, equal on every machine, so no technique always follows the heaviest one.
void shuffle(std::vector<std::size_t>& order, std::mt19937_64& engine) {
    for (std::size_t k = order.size(); k > 1; --k) {
        std::swap(order[k - 1], order[engine() % k]);
    }
}

} // namespace

Spread spread_of(const std::vector<double>& values) {
    return {quantile(values, 0.5), quantile(values, 0.1), quantile(values, 0.9)};
}

std::vector<FrameTimes> time_interleaved(std::span<Technique* const> techniques,
                                         std::span<const BenchPose> poses, const TimingPlan& plan,
                                         const Progress& progress) {
    std::vector<FrameTimes> times(techniques.size());
    if (poses.empty()) {
        return times;
    }
    glFinish();
    for (Technique* technique : techniques) {
        for (int k = 0; k < plan.warm_up; ++k) {
            technique->draw_timed(poses.front());
            glFinish();
        }
    }
    std::mt19937_64 engine(1);
    std::vector<std::size_t> order(techniques.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (int round = 0; round < plan.rounds; ++round) {
        for (std::size_t pose = 0; pose < poses.size(); ++pose) {
            shuffle(order, engine);
            for (const std::size_t k : order) {
                time_one(*techniques[k], poses[pose], times[k]);
            }
            const double done = (round + static_cast<double>(pose + 1) / static_cast<double>(poses.size()));
            progress(done / plan.rounds);
        }
    }
    return times;
}

} // namespace frustumscreen::bench

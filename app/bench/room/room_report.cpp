#include "app/bench/room/room_bench.h"
#include "firmware_host/base/quantile.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace frustumscreen::bench {

namespace {

std::vector<double> all_ms(const RoomTimes& times) {
    std::vector<double> ms;
    for (const RoomFrameTime& frame : times.frames) {
        ms.push_back(frame.ms);
    }
    return ms;
}

double rate_of(double ms) {
    return ms > 0.0 ? 1e3 / ms : 0.0;
}

/// Median time of `ours` in the frames that `peer` draws too.
double ours_where(const RoomTimes& ours, const RoomTimes& peer) {
    std::map<std::pair<std::size_t, std::size_t>, double> of_frame;
    for (const RoomFrameTime& frame : ours.frames) {
        of_frame[{frame.walk, frame.frame}] = frame.ms;
    }
    std::vector<double> ms;
    for (const RoomFrameTime& frame : peer.frames) {
        const auto found = of_frame.find({frame.walk, frame.frame});
        if (found != of_frame.end()) {
            ms.push_back(found->second);
        }
    }
    return quantile(ms, 0.5);
}

} // namespace

double RoomTimes::ms_p50() const {
    return quantile(all_ms(*this), 0.5);
}
double RoomTimes::ms_p99() const {
    return quantile(all_ms(*this), 0.99);
}
double RoomTimes::fps_min() const {
    return rate_of(quantile(all_ms(*this), 1.0));
}
double RoomTimes::wall_fps_min() const {
    double slowest_ms = 0.0;
    for (const RoomFrameTime& frame : frames) {
        slowest_ms = std::max(slowest_ms, frame.wall_ms);
    }
    return rate_of(slowest_ms);
}

std::string room_csv(const RoomResult& result) {
    std::string csv = "technique,objects,triangles,ms_p50,ms_p99,fps_min,error_mm_mean\n";
    for (const RoomRow& row : result.rows) {
        csv += fmt::format("{},{},{},{:.3f},{:.3f},{:.3f},{:.5f}\n", row.technique, result.objects,
                           result.triangles, row.times.ms_p50(), row.times.ms_p99(), row.times.fps_min(),
                           row.error.mean_mm);
    }
    return csv;
}

std::string room_frames_csv(const RoomResult& result) {
    std::string csv = "technique,walk,seconds,ms,wall_ms\n";
    for (const RoomRow& row : result.rows) {
        for (const RoomFrameTime& frame : row.times.frames) {
            csv += fmt::format("{},{},{:.2f},{:.3f},{:.3f}\n", row.technique, result.walks[frame.walk],
                               static_cast<double>(frame.frame) / room_walk_hz, frame.ms, frame.wall_ms);
        }
    }
    return csv;
}

std::string room_paper_csv(const RoomResult& result) {
    std::string csv = "technique,polygons_s,polygons_p50,polygons_max,ms_p50,fps_min,error_mm_mean\n";
    for (const RoomPaperRow& row : result.paper) {
        csv += fmt::format("{},{:.0f},{:.0f},{:.0f},{:.3f},{:.3f},{:.5f}\n", row.technique, row.polygons_s,
                           row.polygons_p50, row.polygons_max, row.times.ms_p50(), row.times.fps_min(),
                           row.error.mean_mm);
    }
    return csv;
}

std::string room_table(const RoomResult& result) {
    std::string table = fmt::format(
        "{} objects, {:.1f} million source triangles; the paper's weights: u {:g}, v {:g}, w {:g}, x {:g}\n",
        result.objects, 1e-6 * static_cast<double>(result.triangles), result.weights.u, result.weights.v,
        result.weights.w, result.weights.x);
    table += fmt::format("{:>10}{:>9}{:>9}{:>9}{:>15}{:>10}{:>9}  {}\n", "technique", "p50 ms", "p99 ms",
                         "fps min", "by the clock", "error mm", "p95 mm", "setting");
    for (const RoomRow& row : result.rows) {
        table += fmt::format("{:>10}{:>9.1f}{:>9.1f}{:>9.1f}{:>15.1f}{:>10.4f}{:>9.4f}  {}\n", row.technique,
                             row.times.ms_p50(), row.times.ms_p99(), row.times.fps_min(),
                             row.times.wall_fps_min(), row.error.mean_mm, row.error.p95_mm, row.setting);
    }
    table += fmt::format("{:>10}{:>14}{:>16}{:>9}{:>9}{:>10}\n", "technique", "polygons/s", "a frame, most",
                         "p50 ms", "fps min", "error mm");
    for (const RoomPaperRow& row : result.paper) {
        table += fmt::format("{:>10}{:>14}{:>16.0f}{:>9.1f}{:>9.1f}{:>10.4f}\n", row.technique,
                             row.polygons_s > 0.0 ? fmt::format("{:.0f}", row.polygons_s) : "any",
                             row.polygons_max, row.times.ms_p50(), row.times.fps_min(), row.error.mean_mm);
    }
    return table;
}

std::string room_verdicts(const RoomResult& result) {
    if (result.rows.empty()) {
        return {};
    }
    constexpr double steady = 1.2;
    constexpr double cheaper = 3.0;
    const RoomRow& ours = result.rows.front();
    const auto line = [](bool held, const std::string& what) {
        return fmt::format("{} {}\n", held ? "held " : "unmet", what);
    };
    const double ratio = ours.times.ms_p99() / ours.times.ms_p50();
    std::string lines =
        line(ratio <= steady, fmt::format("ours is steady: p99 / p50 <= {:g} ({:.2f})", steady, ratio));
    lines += line(
        ours.times.fps_min() >= paper_min_fps,
        fmt::format("ours never falls below {:g} frames/s of processor time ({:.1f}; by the clock {:.1f})",
                    paper_min_fps, ours.times.fps_min(), ours.times.wall_fps_min()));
    const RoomRow* best = nullptr; // the cheapest of all, also of those that err more at their finest
    double best_times = 0.0;
    for (std::size_t k = 1; k < result.rows.size(); ++k) {
        const double times = result.rows[k].times.ms_p50() / ours_where(ours.times, result.rows[k].times);
        if (best == nullptr || times < best_times) {
            best = &result.rows[k];
            best_times = times;
        }
    }
    if (best != nullptr) {
        lines += line(
            best_times >= cheaper,
            fmt::format("ours is >= {:g} times cheaper than the best of the others ({}: {:.2f} times, error "
                        "{:.4f} mm; ours {:.4f} mm)",
                        cheaper, best->technique, best_times, best->error.mean_mm, ours.error.mean_mm));
    }
    return lines;
}

} // namespace frustumscreen::bench

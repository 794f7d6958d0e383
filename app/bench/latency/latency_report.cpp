#include "app/bench/latency/latency_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace frustumscreen::bench {

namespace {

constexpr double min_gain = 0.4;
constexpr double judged_speed_m_s = 0.25;
constexpr double max_rest_mm = 0.15;
constexpr double overshoot_margin_mm = 0.5;
constexpr double max_tremble_mm = 0.5;
constexpr double fastest_calm_m_s = 0.05; ///< fastest slide that must not tremble

const FilterResult& named(const TrackerResult& result, const std::string& name) {
    const auto found = std::find_if(result.filters.begin(), result.filters.end(),
                                    [&](const FilterResult& filter) { return filter.name == name; });
    assert(found != result.filters.end());
    return *found;
}

const Slip* at_speed(const FilterResult& filter, double speed_m_s) {
    const auto found = std::find_if(filter.strokes.begin(), filter.strokes.end(),
                                    [&](const SpeedSlip& stroke) { return stroke.speed_m_s == speed_m_s; });
    return found != filter.strokes.end() ? &found->slip : nullptr;
}

/// Worst tremble of the slides up to `fastest_calm_m_s`.
double worst_tremble_mm(const FilterResult& filter) {
    double worst = 0.0;
    for (const SpeedSlip& slide : filter.trembles) {
        worst = slide.speed_m_s <= fastest_calm_m_s ? std::fmax(worst, slide.slip.rms) : worst;
    }
    return worst;
}

} // namespace

std::vector<LimitVerdict> judge(const TrackerResult& result, const LatencyOptions& options) {
    std::vector<LimitVerdict> verdicts;
    const FilterResult& shown = named(result, "exhibit, as shown");
    const Slip* with = at_speed(shown, judged_speed_m_s);
    const Slip* without = at_speed(named(result, "exhibit"), judged_speed_m_s);
    if (with != nullptr && without != nullptr && without->rms > 0.0) {
        const double gain = 1.0 - with->rms / without->rms;
        verdicts.push_back(
            {.what = fmt::format("RMS slip at {:g} m/s at least {:g} % below the same filter's without "
                                 "prediction",
                                 judged_speed_m_s, 100.0 * min_gain),
             .found = fmt::format("{:.2f} mm against {:.2f} mm, {:.0f} % below", with->rms, without->rms,
                                  100.0 * gain),
             .held = gain >= min_gain});
    }
    verdicts.push_back({.what = fmt::format("rest jitter <= {:g} mm RMS", max_rest_mm),
                        .found = fmt::format("{:.3f} mm against the truth", shown.rest.rms),
                        .held = shown.rest.rms <= max_rest_mm});
    verdicts.push_back(
        {.what = fmt::format(
             "jitter <= {:g} mm RMS from picture to picture while the prop slides at {:g} m/s at most",
             max_tremble_mm, fastest_calm_m_s),
         .found = fmt::format("{:.2f} mm at the worst speed", worst_tremble_mm(shown)),
         .held = worst_tremble_mm(shown) <= max_tremble_mm});
    const double total_s = 1e-3 * (result.tracker.latency_ms + options.setting.display_latency_ms);
    const double limit_mm = 1e3 * 0.5 * stop_braking_m_s2 * total_s * total_s + overshoot_margin_mm;
    verdicts.push_back(
        {.what = fmt::format("overshoot when stopping from {:g} m/s at {:g} m/s^2 <= {:.2f} mm",
                             stop_speed_m_s, stop_braking_m_s2, limit_mm),
         .found = fmt::format("95th percentile of the stops {:.2f} mm, mean {:.2f}, worst {:.2f}",
                              shown.stop.p95, shown.stop.mean, shown.stop.worst),
         .held = shown.stop.p95 <= limit_mm});
    return verdicts;
}

std::string latency_table(const TrackerResult& result, const LatencyOptions& options) {
    const TrackedBy& tracker = result.tracker;
    std::string text =
        fmt::format("{}: {:g} Hz, {:g} ms + {:g} ms, {:g} mm, {:.2f} degrees\n"
                    "mm: mean, 95th percentile, RMS\n{:<29}",
                    tracker.name, tracker.rate_hz, tracker.latency_ms, options.setting.display_latency_ms,
                    1e3 * tracker.noise.place_m, glm::degrees(tracker.noise.turn_rad), "");
    for (const double speed_m_s : options.speeds_m_s) {
        text += fmt::format(" {:>19}", fmt::format("{:g} m/s", speed_m_s));
    }
    text += fmt::format(" {:>6} {:>13} {:>13} ", "rest", "overshoot", "runs ahead");
    for (const double speed_m_s : options.slides_m_s) {
        text += fmt::format(" {:>6}", fmt::format("{:g}", speed_m_s));
    }
    text += " m/s: jitter, RMS\n";
    for (const FilterResult& filter : result.filters) {
        text += fmt::format("{:<29}", filter.name);
        for (const SpeedSlip& stroke : filter.strokes) {
            text +=
                fmt::format("   {:5.2f} {:5.2f} {:5.2f}", stroke.slip.mean, stroke.slip.p95, stroke.slip.rms);
        }
        text += fmt::format(" {:6.3f} {:6.2f} {:6.2f} {:6.2f} {:6.2f} ", filter.rest.rms, filter.stop.mean,
                            filter.stop.p95, filter.stop.ahead_mean, filter.stop.ahead_p95);
        for (const SpeedSlip& slide : filter.trembles) {
            text += fmt::format(" {:6.2f}", slide.slip.rms);
        }
        text += "\n";
    }
    return text;
}

std::string recordings_table(std::span<const RecordingResult> recordings) {
    std::string text = "recordings, mm: mean, 95th percentile, RMS\n";
    for (const RecordingResult& recording : recordings) {
        text += recording.name + "\n";
        for (const auto& [name, slip] : recording.slips) {
            text += fmt::format("  {:<29} {:6.2f} {:6.2f} {:6.2f}\n", name, slip.mean, slip.p95, slip.rms);
        }
    }
    return text;
}

std::string latency_csv(std::span<const TrackerResult> results, std::span<const RecordingResult> recordings) {
    std::string text = "source,contestant,motion,speed_m_s,latency_ms,mean_mm,p95_mm,rms_mm\n";
    const auto row = [&](const std::string& source, const std::string& filter_name, const char* motion,
                         double speed_m_s, double latency_ms, const Slip& slip) {
        text += fmt::format("\"{}\",\"{}\",{},{:g},{:g},{:.4f},{:.4f},{:.4f}\n", source, filter_name, motion,
                            speed_m_s, latency_ms, slip.mean, slip.p95, slip.rms);
    };
    for (const TrackerResult& result : results) {
        for (const FilterResult& filter : result.filters) {
            const std::string& source = result.tracker.name;
            for (const SpeedSlip& stroke : filter.strokes) {
                row(source, filter.name, "strokes", stroke.speed_m_s, result.total_ms, stroke.slip);
            }
            for (const SpeedSlip& slide : filter.trembles) {
                row(source, filter.name, "tremble", slide.speed_m_s, result.total_ms, slide.slip);
            }
            for (const LatencySlip& latency : filter.latencies) {
                row(source, filter.name, "latency", latency_speed_m_s, latency.total_ms, latency.slip);
            }
            row(source, filter.name, "rest", 0.0, result.total_ms, filter.rest);
            const Overshoot& stop = filter.stop;
            row(source, filter.name, "stop_overshoot", stop_speed_m_s, result.total_ms,
                {stop.mean, stop.p95, stop.rms});
            row(source, filter.name, "stop_ahead", stop_speed_m_s, result.total_ms,
                {stop.ahead_mean, stop.ahead_p95, stop.ahead_rms});
        }
    }
    for (const RecordingResult& recording : recordings) {
        for (const auto& [name, slip] : recording.slips) {
            row(recording.name, name, "recording", 0.0, recording.total_ms, slip);
        }
    }
    return text;
}

} // namespace frustumscreen::bench

#include "tests/simulators/museum/museum_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>

namespace frustumscreen::simulators {

namespace {

double share(const MuseumRun& run, VisibleState shown) {
    const MuseumTime all = std::accumulate(run.open.begin(), run.open.end(), MuseumTime{0});
    return all == 0
               ? 0.0
               : static_cast<double>(run.open.at(static_cast<std::size_t>(shown))) / static_cast<double>(all);
}

std::size_t count_of(std::span<const FaultEvent> fault_events, std::size_t fault) {
    return static_cast<std::size_t>(
        std::count_if(fault_events.begin(), fault_events.end(), [&](const FaultEvent& fault_event) {
            return fault_event.fault == static_cast<FaultKind>(fault);
        }));
}

/// Formats as 45 s, 12 min or 3.2 h, easy to compare.
std::string length_of(MuseumTime seconds) {
    const auto value = static_cast<double>(seconds);
    return seconds < 120    ? fmt::format("{} s", seconds)
           : seconds < 7200 ? fmt::format("{:.0f} min", value / 60.0)
                            : fmt::format("{:.1f} h", value / 3600.0);
}

} // namespace

std::size_t false_alarms(const MuseumRun& run) {
    return static_cast<std::size_t>(std::count_if(run.steps.begin(), run.steps.end(),
                                                  [](const TakenStep& step) { return step.is_false_alarm; }));
}

std::size_t count_of(const MuseumRun& run, watch::Step step) {
    return static_cast<std::size_t>(std::count_if(
        run.steps.begin(), run.steps.end(), [&](const TakenStep& taken) { return taken.act.step == step; }));
}

std::string museum_table(std::span<const MuseumRun> runs, std::span<const FaultEvent> fault_events) {
    std::string text = fmt::format("{:24} {:>9} {:>9} {:>9} {:>9} {:>9} {:>12} {:>6} {:>8} {:>6}\n",
                                   "in opening hours, %", "whole", "untracked", "built in", "words", "dark",
                                   "longest dark", "steps", "reboots", "false");
    auto out = std::back_inserter(text);
    for (const MuseumRun& run : runs) {
        fmt::format_to(out, "{:24} {:9.3f} {:9.3f} {:9.3f} {:9.3f} {:9.3f} {:>12} {:6} {:8} {:6}\n",
                       name_of(run.policy), 100.0 * share(run, VisibleState::Whole),
                       100.0 * share(run, VisibleState::Untracked), 100.0 * share(run, VisibleState::BuiltIn),
                       100.0 * share(run, VisibleState::Words), 100.0 * share(run, VisibleState::Dark),
                       length_of(run.longest_dark_s), run.steps.size(), count_of(run, watch::Step::Reboot),
                       false_alarms(run));
    }
    fmt::format_to(out, "\n{:24} {:>6}", "longest dark after", "times");
    for (const MuseumRun& run : runs) {
        fmt::format_to(out, " {:>24}", name_of(run.policy));
    }
    text += "\n";
    for (std::size_t k = 0; k < fault_kind_count; ++k) {
        fmt::format_to(out, "{:24} {:6}", kind_of(static_cast<FaultKind>(k)).name, count_of(fault_events, k));
        for (const MuseumRun& run : runs) {
            fmt::format_to(out, " {:>24}", length_of(run.longest.at(k)));
        }
        text += "\n";
    }
    return text;
}

std::string museum_csv(std::span<const MuseumRun> runs, int days) {
    std::string csv = "policy,days,whole,untracked,built_in,words,dark,longest_dark_s,steps,reboots,most_"
                      "reboots_in_day,false_alarms\n";
    for (const MuseumRun& run : runs) {
        fmt::format_to(std::back_inserter(csv), "{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{},{},{},{},{}\n",
                       name_of(run.policy), days, share(run, VisibleState::Whole),
                       share(run, VisibleState::Untracked), share(run, VisibleState::BuiltIn),
                       share(run, VisibleState::Words), share(run, VisibleState::Dark), run.longest_dark_s,
                       run.steps.size(), count_of(run, watch::Step::Reboot), run.max_reboots_in_day,
                       false_alarms(run));
    }
    return csv;
}

std::string dark_times_csv(std::span<const MuseumRun> runs, int days) {
    constexpr double days_a_year = 365.25;
    std::string csv = "policy,longer_than_s,times_a_year\n";
    for (const MuseumRun& run : runs) {
        std::vector<MuseumTime> lengths = run.dark_times;
        std::sort(lengths.begin(), lengths.end());
        for (std::size_t k = 0; k < lengths.size(); ++k) {
            if (k == 0 || lengths[k] != lengths[k - 1]) {
                fmt::format_to(std::back_inserter(csv), "{},{},{:.4f}\n", name_of(run.policy), lengths[k],
                               static_cast<double>(lengths.size() - k) * days_a_year / days);
            }
        }
    }
    return csv;
}

std::string faults_csv(std::span<const MuseumRun> runs, std::span<const FaultEvent> fault_events) {
    std::string csv = "ailment,times,policy,longest_dark_s\n";
    for (std::size_t k = 0; k < fault_kind_count; ++k) {
        for (const MuseumRun& run : runs) {
            fmt::format_to(std::back_inserter(csv), "{},{},{},{}\n", kind_of(static_cast<FaultKind>(k)).name,
                           count_of(fault_events, k), name_of(run.policy), run.longest.at(k));
        }
    }
    return csv;
}

} // namespace frustumscreen::simulators

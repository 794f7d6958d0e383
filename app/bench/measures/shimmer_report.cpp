#include "app/bench/measures/shimmer.h"
#include "app/bench/truth/csv_fields.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::bench {

namespace {

/// Mean and maximum of a value over the sequences of one level.
struct Spans {
    double mean = 0.0;
    double worst = 0.0;
};

Spans spans(const std::vector<const ShimmerRow*>& rows, double (*figure)(const ShimmerRow&)) {
    Spans found;
    for (const ShimmerRow* row : rows) {
        found.mean += figure(*row) / static_cast<double>(rows.size());
        found.worst = std::max(found.worst, figure(*row));
    }
    return found;
}

double of_rms(const ShimmerRow& row) {
    return row.shimmer.rms_ratio();
}
double of_q999(const ShimmerRow& row) {
    return row.shimmer.q999_ratio();
}
double of_excess(const ShimmerRow& row) {
    return row.shimmer.excess_percent();
}

std::vector<std::pair<std::string, std::vector<const ShimmerRow*>>> by_level(const ShimmerResult& result) {
    std::vector<std::pair<std::string, std::vector<const ShimmerRow*>>> levels;
    for (const ShimmerRow& row : result.rows) {
        const auto level = std::find_if(levels.begin(), levels.end(),
                                        [&row](const auto& other) { return other.first == row.technique; });
        if (level == levels.end()) {
            levels.push_back({row.technique, {&row}});
        } else {
            level->second.push_back(&row);
        }
    }
    return levels;
}

EdgeSparkle all_edges(const ShimmerResult& result) {
    EdgeSparkle all;
    for (const SparkleRow& row : result.edges) {
        all.add(row.sparkle);
    }
    return all;
}

constexpr int jump_codes = 25; ///< a change that catches the eye

std::string edge_lines(const EdgeSparkle& edges) {
    std::string lines = fmt::format(
        "default level in even light: changes of pixels from one step of 0.1 mm to the next, codes\n"
        "{:<34}{:<14}{:<8}{:<8}{:<10}over {}, %\n",
        "", "changes", "RMS", "99.9 %", "largest", jump_codes);
    const auto line = [&lines](const char* name, const ChangeHistogram& changes) {
        lines +=
            fmt::format("{:<34}{:<14}{:<8.2f}{:<8}{:<10}{:.3f}\n", name, changes.changes(), changes.rms(),
                        changes.q999(), changes.largest(), changes.percent_over(jump_codes));
    };
    line("shared by two faces, sharp", edges.sharp);
    line("shared by two faces, feathered", edges.feathered);
    line("beside these, sharp", edges.beside_sharp);
    line("beside these, feathered", edges.beside_feathered);
    return lines;
}

std::string change_fields(const ChangeHistogram& changes) {
    return fmt::format("{},{:.4f},{},{},{:.4f}", changes.changes(), changes.rms(), changes.q999(),
                       changes.largest(), changes.percent_over(jump_codes));
}

} // namespace

std::string edge_sparkle_csv(std::span<const ShimmerResult> results) {
    std::string csv =
        fmt::format("set_up,pose,{},direction,pixels,edges,changes,rms,q999,largest,percent_over_{}\n",
                    pose_columns, jump_codes);
    for (const ShimmerResult& result : results) {
        for (const SparkleRow& row : result.edges) {
            const auto add = [&](const char* pixels, const char* edges, const ChangeHistogram& changes) {
                csv += fmt::format("{},{},{},{},{},{},{}\n", result.name, row.pose,
                                   pose_fields(result.poses[static_cast<std::size_t>(row.pose)]),
                                   row.along_x ? "x" : "y", pixels, edges, change_fields(changes));
            };
            add("shared", "sharp", row.sparkle.sharp);
            add("shared", "feathered", row.sparkle.feathered);
            add("beside", "sharp", row.sparkle.beside_sharp);
            add("beside", "feathered", row.sparkle.beside_feathered);
        }
    }
    return csv;
}

std::vector<LimitVerdict> judge(const ShimmerResult& result) {
    std::vector<LimitVerdict> verdicts;
    const auto add = [&verdicts](const std::string& what, const Spans& found, double most, const char* unit) {
        verdicts.push_back(
            {.what = fmt::format("{} <= {:g}{}", what, most, unit),
             .found = fmt::format("worst {:.3f}{}, mean {:.3f}{}", found.worst, unit, found.mean, unit),
             .held = found.worst <= most});
    };
    for (const auto& [name, rows] : by_level(result)) {
        add(name + ": shimmer / one ray's, RMS", spans(rows, of_rms), max_ratio, "");
        add(name + ": shimmer / one ray's, 99.9 % of the pixels", spans(rows, of_q999), max_ratio, "");
        add(name + ": pixels that shimmer where the ray cast does not", spans(rows, of_excess),
            max_excess_percent, " %");
    }
    const EdgeSparkle edges = all_edges(result);
    if (edges.sharp.changes() > 0) {
        const double ratio = edges.feathered.rms() / edges.sharp.rms();
        verdicts.push_back({.what = "edges between faces: changes, feathered / sharp, RMS <= 1",
                            .found = fmt::format("{:.3f}; beside them {:.3f}", ratio,
                                                 edges.beside_feathered.rms() / edges.sharp.rms()),
                            .held = ratio <= 1.0});
    }
    return verdicts;
}

std::string shimmer_csv(std::span<const ShimmerResult> results) {
    std::string csv =
        fmt::format("set_up,pose,{},direction,technique,judged_pixels,rms,q999,rms_1_ray,q999_1_ray,"
                    "rms_16_rays,q999_16_rays,rms_ratio,q999_ratio,excess_pixels\n",
                    pose_columns);
    for (const ShimmerResult& result : results) {
        for (const ShimmerRow& row : result.rows) {
            csv += fmt::format("{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},", result.name, row.pose,
                               pose_fields(result.poses[static_cast<std::size_t>(row.pose)]),
                               row.direction == PushDirection::Row ? "row" : "column", row.technique,
                               row.shimmer.judged_pixels, row.shimmer.drawn.rms, row.shimmer.drawn.q999,
                               row.shimmer.one_ray.rms, row.shimmer.one_ray.q999);
            csv += row.shimmer.sixteen_rays ? fmt::format("{:.4f},{:.4f},", row.shimmer.sixteen_rays->rms,
                                                          row.shimmer.sixteen_rays->q999)
                                            : std::string(",,");
            csv += fmt::format("{:.4f},{:.4f},{}\n", row.shimmer.rms_ratio(), row.shimmer.q999_ratio(),
                               row.shimmer.excess_pixels);
        }
    }
    return csv;
}

std::string shimmer_table(const ShimmerResult& result) {
    std::string table = fmt::format(
        "{} set-up, {} poses, 2 directions; shimmer in codes, RMS / 99.9 %, mean over the sequences\n"
        "{:<20}{:<18}{:<18}{:<18}{}\n",
        result.name, result.poses.size(), "level", "drawn", "1 ray", "16 rays", "excess %, worst");
    for (const auto& [name, rows] : by_level(result)) {
        const auto text = [&rows = rows](double (*rms)(const ShimmerRow&),
                                         double (*q999)(const ShimmerRow&)) {
            return fmt::format("{:.2f} / {:.1f}", spans(rows, rms).mean, spans(rows, q999).mean);
        };
        const bool sixteen = rows.front()->shimmer.sixteen_rays.has_value();
        table +=
            fmt::format("{:<20}{:<18}{:<18}{:<18}{:.3f}\n", name,
                        text([](const ShimmerRow& row) { return row.shimmer.drawn.rms; },
                             [](const ShimmerRow& row) { return row.shimmer.drawn.q999; }),
                        text([](const ShimmerRow& row) { return row.shimmer.one_ray.rms; },
                             [](const ShimmerRow& row) { return row.shimmer.one_ray.q999; }),
                        sixteen ? text([](const ShimmerRow& row) { return row.shimmer.sixteen_rays->rms; },
                                       [](const ShimmerRow& row) { return row.shimmer.sixteen_rays->q999; })
                                : std::string("-"),
                        spans(rows, of_excess).worst);
    }
    return table + edge_lines(all_edges(result)) + lines_of(judge(result));
}

} // namespace frustumscreen::bench

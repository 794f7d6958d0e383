#include "app/bench/measures/projection.h"
#include "app/bench/truth/csv_fields.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::bench {

namespace {

struct Share {
    double mean_percent = 0.0;
    double worst_percent = 100.0;
    int worst_pose = 0;

    void add(double percent, int pose) {
        mean_percent += percent; // holds the sum until all poses are added
        if (percent < worst_percent) {
            worst_percent = percent;
            worst_pose = pose;
        }
    }
};

/// The rows of one technique.
struct Summary {
    std::string technique;
    int level = -1;
    int poses = 0;
    Share one_ray;
    Share sixteen_rays;
    Share artifact; ///< 16 rays
};

std::vector<Summary> by_technique(const ProjectionResult& result) {
    std::vector<Summary> summaries;
    for (const ProjectionRow& row : result.rows) {
        auto summary = std::find_if(summaries.begin(), summaries.end(), [&row](const Summary& other) {
            return other.technique == row.technique;
        });
        if (summary == summaries.end()) {
            Summary fresh;
            fresh.technique = row.technique;
            fresh.level = row.level;
            summary = summaries.insert(summaries.end(), std::move(fresh));
        }
        summary->poses += 1;
        summary->one_ray.add(row.one_ray.prop_percent(), row.pose);
        summary->sixteen_rays.add(row.sixteen_rays.prop_percent(), row.pose);
        summary->artifact.add(row.sixteen_rays.artifact_percent(), row.pose);
    }
    for (Summary& summary : summaries) {
        for (Share* share : {&summary.one_ray, &summary.sixteen_rays, &summary.artifact}) {
            share->mean_percent /= summary.poses;
        }
    }
    return summaries;
}

} // namespace

std::vector<LimitVerdict> judge(const ProjectionResult& result) {
    std::vector<LimitVerdict> verdicts;
    const std::vector<Summary> summaries = by_technique(result);
    for (const Summary& summary : summaries) {
        if (summary.level < 0) {
            continue;
        }
        for (const auto& [share, rays] :
             {std::pair{&Summary::sixteen_rays, "16 rays"}, std::pair{&Summary::one_ray, "1 ray"}}) {
            const Share& found = summary.*share;
            verdicts.push_back(
                {.what = fmt::format("{}: >= {:g} % of the prop's pixels within {} codes, {} a pixel",
                                     summary.technique, min_right_percent, max_codes_off, rays),
                 .found = fmt::format(
                     "worst pose {:.2f} %, mean {:.2f} %; the ray-cast picture {:.2f} %, {:.2f} %",
                     found.worst_percent, found.mean_percent, (summaries.front().*share).worst_percent,
                     (summaries.front().*share).mean_percent),
                 .held = found.worst_percent >= min_right_percent});
        }
    }
    double span = result.rows.empty() ? 0.0 : result.rows.front().min_span_px;
    for (const ProjectionRow& row : result.rows) {
        span = std::min(span, row.min_span_px);
    }
    verdicts.push_back({.what = "the visitor's pixels are no finer than the projector's on the prop",
                        .found = fmt::format("the finest spans {:.2f} projector pixels", span),
                        .held = span >= 1.0});
    return verdicts;
}

std::string projection_csv(std::span<const ProjectionResult> results) {
    std::string csv =
        fmt::format("set_up,pose,{},technique,width,height,least_span_px,prop_pixels,right_percent,"
                    "artifact_pixels,artifact_right_percent,right_16_rays_percent,"
                    "artifact_right_16_rays_percent\n",
                    pose_columns);
    for (const ProjectionResult& result : results) {
        for (const ProjectionRow& row : result.rows) {
            csv += fmt::format("{},{},{},{},{},{},{:.4f},{},{:.4f},{},{:.4f},{:.4f},{:.4f}\n", result.name,
                               row.pose, pose_fields(result.poses[static_cast<std::size_t>(row.pose)]),
                               row.technique, row.size_px.x, row.size_px.y, row.min_span_px,
                               row.one_ray.prop_pixels, row.one_ray.prop_percent(),
                               row.one_ray.artifact_pixels, row.one_ray.artifact_percent(),
                               row.sixteen_rays.prop_percent(), row.sixteen_rays.artifact_percent());
        }
    }
    return csv;
}

std::string projection_table(const ProjectionResult& result) {
    std::string table =
        fmt::format("{} set-up, {} poses; % within {} codes, mean / worst pose\n{:<20}{:<20}{:<20}"
                    "{:<22}{}\n",
                    result.name, result.poses.size(), max_codes_off, "projector's picture", "16 rays",
                    "1 ray", "artifact's, 16 rays", "worst pose");
    for (const Summary& summary : by_technique(result)) {
        const auto text = [](const Share& share) {
            return fmt::format("{:.2f} / {:.2f}", share.mean_percent, share.worst_percent);
        };
        table += fmt::format("{:<20}{:<20}{:<20}{:<22}{}\n", summary.technique, text(summary.sixteen_rays),
                             text(summary.one_ray), text(summary.artifact), summary.sixteen_rays.worst_pose);
    }
    return table + lines_of(judge(result));
}

} // namespace frustumscreen::bench

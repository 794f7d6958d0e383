#include "app/bench/projection.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen {

namespace {

/// The rows of one level, and what they have in common.
struct LevelSummary {
    std::string technique;
    int poses = 0;
    double mean_percent = 0.0;
    const ProjectionRow* worst = nullptr; ///< one ray
    double worst_sixteen_percent = 100.0;
    double worst_artifact_percent = 100.0;
};

std::vector<LevelSummary> by_level(const ProjectionResult& result) {
    std::vector<LevelSummary> levels;
    for (const ProjectionRow& row : result.rows) {
        auto level = std::find_if(levels.begin(), levels.end(), [&row](const LevelSummary& summary) {
            return summary.technique == row.technique;
        });
        if (level == levels.end()) {
            LevelSummary fresh;
            fresh.technique = row.technique;
            level = levels.insert(levels.end(), std::move(fresh));
        }
        level->poses += 1;
        level->mean_percent += row.one_ray.prop_percent();
        level->worst_sixteen_percent =
            std::min(level->worst_sixteen_percent, row.sixteen_rays.prop_percent());
        level->worst_artifact_percent =
            std::min(level->worst_artifact_percent, row.one_ray.artifact_percent());
        if (level->worst == nullptr || row.one_ray.prop_percent() < level->worst->one_ray.prop_percent()) {
            level->worst = &row;
        }
    }
    for (LevelSummary& level : levels) {
        level.mean_percent /= level.poses;
    }
    return levels;
}

} // namespace

std::vector<Verdict> judge(const ProjectionResult& result) {
    std::vector<Verdict> verdicts;
    for (const LevelSummary& level : by_level(result)) {
        const double worst = level.worst->one_ray.prop_percent();
        verdicts.push_back({fmt::format("{}: >= {:g} % of the prop's pixels within {} codes", level.technique,
                                        least_right_percent, most_codes_off),
                            fmt::format("worst pose {:.2f} %, mean {:.2f} %", worst, level.mean_percent),
                            worst >= least_right_percent});
    }
    double covered = result.rows.empty() ? 0.0 : result.rows.front().least_covered;
    for (const ProjectionRow& row : result.rows) {
        covered = std::min(covered, row.least_covered);
    }
    verdicts.push_back({"the visitor's pixels are no finer than the projector's on the prop",
                        fmt::format("the finest covers {:.2f} projector pixels", covered), covered >= 1.0});
    return verdicts;
}

std::string projection_csv(std::span<const ProjectionResult> results) {
    std::string csv =
        "set_up,pose,px_m,py_m,qw,qz,eye_x_m,eye_y_m,eye_z_m,technique,width,height,least_covered,"
        "prop_pixels,right_percent,artifact_pixels,artifact_right_percent,right_16_rays_percent,"
        "artifact_right_16_rays_percent\n";
    for (const ProjectionResult& result : results) {
        for (const ProjectionRow& row : result.rows) {
            const BenchPose& pose = result.poses[static_cast<std::size_t>(row.pose)];
            const RigidTransform& prop = pose.table_from_prop;
            csv += fmt::format("{},{},{:.6f},{:.6f},{:.9f},{:.9f},{:.6f},{:.6f},{:.6f},{},{},{},{:.4f},{},{:."
                               "4f},{},{:.4f},{:.4f},"
                               "{:.4f}\n",
                               result.name, row.pose, prop.translation.x, prop.translation.y, prop.rotation.w,
                               prop.rotation.z, pose.eye_m.x, pose.eye_m.y, pose.eye_m.z, row.technique,
                               row.size_px.x, row.size_px.y, row.least_covered, row.one_ray.prop_pixels,
                               row.one_ray.prop_percent(), row.one_ray.artifact_pixels,
                               row.one_ray.artifact_percent(), row.sixteen_rays.prop_percent(),
                               row.sixteen_rays.artifact_percent());
        }
    }
    return csv;
}

std::string projection_table(const ProjectionResult& result) {
    std::string table =
        fmt::format("{} set-up, {} poses; % within {} codes\n{:<20}{:>10}{:>10}{:>14}{:>15}{:>12}"
                    "{:>13}\n",
                    result.name, result.poses.size(), most_codes_off, "level", "mean", "worst", "w. 16 rays",
                    "w. artifact", "worst pose", "visitor px");
    for (const LevelSummary& level : by_level(result)) {
        table += fmt::format("{:<20}{:>10.2f}{:>10.2f}{:>14.2f}{:>15.2f}{:>12}{:>13}\n", level.technique,
                             level.mean_percent, level.worst->one_ray.prop_percent(),
                             level.worst_sixteen_percent, level.worst_artifact_percent, level.worst->pose,
                             fmt::format("{} x {}", level.worst->size_px.x, level.worst->size_px.y));
    }
    return table + lines_of(judge(result));
}

} // namespace frustumscreen

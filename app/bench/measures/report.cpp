#include "app/bench/measures/report.h"

#include "app/bench/measures/dominance.h"
#include "app/bench/truth/csv_fields.h"
#include "firmware_host/base/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace frustumscreen::bench {

namespace {

constexpr double not_shown = std::numeric_limits<double>::quiet_NaN();
double of_shown(const PictureError& error, double ShownError::*figure) {
    return error.shown ? *error.shown.*figure : not_shown;
}

/// The errors of one picture, or of a summary, in the order of the columns.
struct Figure {
    const char* name;
    double (*of)(const PictureError&);
};
constexpr std::array figures = {
    Figure{"silhouette_percent", [](const PictureError& e) { return e.silhouette_percent; }},
    Figure{"outline_shift_px", [](const PictureError& e) { return e.outline_shift_px; }},
    Figure{"picture_shift_px", [](const PictureError& e) { return e.picture_shift_px; }},
    Figure{"drawn_shift_px", [](const PictureError& e) { return e.drawn_shift_px; }},
    Figure{"geometric_mean_mm", [](const PictureError& e) { return e.geometric_mean_mm; }},
    Figure{"geometric_p95_mm", [](const PictureError& e) { return e.geometric_p95_mm; }},
    Figure{"rmse_1_ray", [](const PictureError& e) { return e.one_ray.rmse; }},
    Figure{"bad_1_ray_percent", [](const PictureError& e) { return e.one_ray.bad_percent; }},
    Figure{"rmse_16_rays", [](const PictureError& e) { return e.sixteen_rays.rmse; }},
    Figure{"bad_16_rays_percent", [](const PictureError& e) { return e.sixteen_rays.bad_percent; }},
    Figure{"shown_cover_px", [](const PictureError& e) { return of_shown(e, &ShownError::cover_px); }},
    Figure{"shown_cover_of_samples_px",
           [](const PictureError& e) { return of_shown(e, &ShownError::cover_of_samples_px); }},
    Figure{"shown_cover_bias_px",
           [](const PictureError& e) { return of_shown(e, &ShownError::cover_bias_px); }},
    Figure{"shown_shift_px", [](const PictureError& e) { return of_shown(e, &ShownError::shift_px); }},
    Figure{"shown_rmse", [](const PictureError& e) { return e.shown ? e.shown->colour.rmse : not_shown; }},
    Figure{"shown_bad_percent",
           [](const PictureError& e) { return e.shown ? e.shown->colour.bad_percent : not_shown; }},
};

/// The field is empty if the kiosk shows no such picture.
std::string field(double figure) {
    return std::isnan(figure) ? std::string() : fmt::format("{:.6f}", figure);
}

nlohmann::json json_of(const PictureError& error) {
    nlohmann::json json;
    for (const Figure& figure : figures) {
        json[figure.name] = figure.of(error);
    }
    return json;
}

nlohmann::json json_of(const TechniqueResult& technique) {
    nlohmann::json json = {{"name", technique.name},
                           {"kind", name_of(technique.kind)},
                           {"triangles", technique.triangles},
                           {"bytes", technique.bytes},
                           {"samples", technique.samples},
                           {"median_ms", technique.time_ms.median},
                           {"p10_ms", technique.time_ms.p10},
                           {"p90_ms", technique.time_ms.p90},
                           {"times_floor", technique.times_floor},
                           {"cpu_ms", technique.cpu_ms},
                           {"cpu_times_floor", technique.cpu_times_floor}};
    if (technique.kind == TechniqueKind::PackLevel) {
        json["level"] = technique.level;
    }
    if (technique.kind != TechniqueKind::Floor) {
        json["mean"] = json_of(technique.error.mean);
        json["worst"] = json_of(technique.error.worst);
        json["worst_pose"] = technique.error.worst_pose;
    }
    return json;
}

nlohmann::json json_of(std::span<const LimitVerdict> verdicts) {
    nlohmann::json json = nlohmann::json::array();
    for (const LimitVerdict& verdict : verdicts) {
        json.push_back({{"what", verdict.what},
                        {"found", verdict.found},
                        {"held", verdict.held},
                        {"wished", verdict.wished}});
    }
    return json;
}

/// Some names contain a comma.
std::string field(const std::string& text) {
    return text.find(',') != std::string::npos ? quoted(text) : text;
}

} // namespace

std::string summary_csv(std::span<const SetUpResult> results) {
    std::string csv = "set_up,technique,kind,triangles,bytes,samples,median_ms,p10_ms,p90_ms,times_floor,cpu_"
                      "ms,cpu_times_floor";
    for (const char* which : {"mean", "worst"}) {
        for (const Figure& figure : figures) {
            csv += fmt::format(",{}_{}", which, figure.name);
        }
    }
    csv += ",worst_pose,best_eye_image,dominated_in_shape_by,dominated_in_colour_by\n";
    for (const SetUpResult& result : results) {
        const std::vector<const TechniqueResult*> best = at_best_eye_images(result);
        for (const TechniqueResult& technique : result.techniques) {
            csv += fmt::format("{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}", result.name,
                               field(technique.name), name_of(technique.kind), technique.triangles,
                               technique.bytes > 0 ? std::to_string(technique.bytes) : std::string(),
                               technique.samples, technique.time_ms.median, technique.time_ms.p10,
                               technique.time_ms.p90, technique.times_floor, technique.cpu_ms,
                               technique.cpu_times_floor);
            for (const PictureError* error : {&technique.error.mean, &technique.error.worst}) {
                for (const Figure& figure : figures) {
                    csv += "," + (technique.errors.empty() ? std::string() : field(figure.of(*error)));
                }
            }
            csv +=
                technique.errors.empty() ? std::string(",") : fmt::format(",{}", technique.error.worst_pose);
            csv += std::find(best.begin(), best.end(), &technique) != best.end() ? ",1" : ",0";
            for (const Dominance by : {Dominance::Shape, Dominance::Colour}) {
                const bool judged = is_judged_level(technique.kind);
                csv += "," + field(judged ? dominated_by(result, technique, by) : std::string());
            }
            csv += "\n";
        }
    }
    return csv;
}

std::string limits_csv() {
    std::string csv = "level,silhouette_percent,outline_shift_px,geometric_mean_mm,colour_rmse,times_floor\n";
    for (const auto& [level, limits] : {std::pair{"default level", default_level_limits},
                                        {"finest level", finest_level_limits},
                                        {"default level pushed", pushed_default_limits},
                                        {"fine level", fine_level_limits}}) {
        csv += fmt::format("{},{:g},{:g},{:g},{:g},", level, limits.silhouette_percent,
                           limits.outline_shift_px, limits.geometric_mean_mm, limits.colour_rmse);
        csv += limits.times_floor > 0.0 ? fmt::format("{:g}\n", limits.times_floor) : "\n";
    }
    return csv;
}

std::string poses_csv(std::span<const SetUpResult> results) {
    std::string csv = fmt::format("set_up,pose,{},technique,truth_pixels,outline_pixels", pose_columns);
    for (const Figure& figure : figures) {
        csv += fmt::format(",{}", figure.name);
    }
    csv += "\n";
    for (const SetUpResult& result : results) {
        for (const TechniqueResult& technique : result.techniques) {
            for (std::size_t k = 0; k < technique.errors.size(); ++k) {
                csv += fmt::format("{},{},{},{},{},{}", result.name, k, pose_fields(result.poses[k]),
                                   field(technique.name), technique.errors[k].truth_pixels,
                                   technique.errors[k].outline_pixels);
                for (const Figure& figure : figures) {
                    csv += "," + field(figure.of(technique.errors[k]));
                }
                csv += "\n";
            }
        }
    }
    return csv;
}

std::string report_json(std::span<const SetUpResult> results, const std::string& pack_title,
                        std::span<const LimitVerdict> pack_figures) {
    nlohmann::json json = {
        {"pack", pack_title}, {"pack_figures", json_of(pack_figures)}, {"set_ups", nlohmann::json::array()}};
    for (const SetUpResult& result : results) {
        nlohmann::json set_up = {{"name", result.name},
                                 {"driver", result.driver},
                                 {"poses", result.poses.size()},
                                 {"default_level", result.default_level},
                                 {"techniques", nlohmann::json::array()},
                                 {"verdicts", json_of(judge(result))}};
        for (const TechniqueResult& technique : result.techniques) {
            set_up["techniques"].push_back(json_of(technique));
        }
        json["set_ups"].push_back(std::move(set_up));
    }
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string verdicts_csv(std::span<const SetUpResult> results, std::span<const LimitVerdict> pack_figures) {
    std::string csv = "set_up,what,found,verdict\n";
    const auto add = [&csv](const std::string& set_up, std::span<const LimitVerdict> verdicts) {
        for (const LimitVerdict& verdict : verdicts) {
            csv += fmt::format("{},{},{},{}\n", set_up, quoted(verdict.what), quoted(verdict.found),
                               verdict.held ? "held" : (verdict.wished ? "unmet" : "missed"));
        }
    };
    add("pack", pack_figures);
    for (const SetUpResult& result : results) {
        add(result.name, judge(result));
    }
    return csv;
}

std::string console_table(const SetUpResult& result) {
    std::string table = fmt::format(
        "{} set-up, {} poses; mean / worst pose\n{:<32}{:>10}{:>9}{:>15}{:>9}{:>10}  "
        "{:<17}{:<17}{:<18}{:<15}{:<15}{:<15}\n",
        result.name, result.poses.size(), "technique", "triangles", "ms", "p10..p90", "x floor", "CPU x fl.",
        "silhouette %", "outline px", "geometric mm", "RMSE 16 rays", "RMSE lit", "cover px");
    for (const TechniqueResult& technique : result.techniques) {
        table += fmt::format("{:<32}{:>10}{:>9.2f}{:>15}{:>9.2f}{:>10.2f}", technique.name,
                             technique.triangles, technique.time_ms.median,
                             fmt::format("{:.1f}..{:.1f}", technique.time_ms.p10, technique.time_ms.p90),
                             technique.times_floor, technique.cpu_times_floor);
        if (!technique.errors.empty()) {
            const PictureError& mean = technique.error.mean;
            const PictureError& worst = technique.error.worst;
            table +=
                fmt::format("  {:<17}{:<17}{:<18}{:<15}",
                            fmt::format("{:.3f} / {:.3f}", mean.silhouette_percent, worst.silhouette_percent),
                            fmt::format("{:.3f} / {:.3f}", mean.outline_shift_px, worst.outline_shift_px),
                            fmt::format("{:.4f} / {:.4f}", mean.geometric_mean_mm, worst.geometric_mean_mm),
                            fmt::format("{:.2f} / {:.2f}", mean.sixteen_rays.rmse, worst.sixteen_rays.rmse));
            if (mean.shown) {
                table += fmt::format(
                    "{:<15}{:<15}",
                    fmt::format("{:.2f} / {:.2f}", mean.shown->colour.rmse, worst.shown->colour.rmse),
                    fmt::format("{:.3f} / {:.3f}", mean.shown->cover_px, worst.shown->cover_px));
            }
        }
        table += "\n";
    }
    return table + lines_of(judge(result));
}

} // namespace frustumscreen::bench

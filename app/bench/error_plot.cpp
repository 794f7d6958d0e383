#include "app/bench/error_plot.h"

#include "app/bench/attainment.h"
#include "app/bench/measures/dominance.h"
#include "app/bench/measures/verdicts.h"
#include "app/bench/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace frustumscreen {

namespace {

constexpr const char* cost_label = "median frame time / that of the floor";
constexpr double faint = 0.3;

/// Techniques that share a line.
struct Family {
    TechniqueKind kind;
    const char* name;
    PlotLook look;
};
constexpr std::array families = {
    Family{TechniqueKind::PackLevel, "pack's levels", {0, PlotMark::Disc, 2.5}},
    Family{TechniqueKind::TwoPass, "two-pass, full mesh", {1, PlotMark::Square}},
    Family{TechniqueKind::TwoPassLod, "two-pass, LODs", {3, PlotMark::Square}},
    Family{TechniqueKind::FullMesh, "one pass, full mesh", {5, PlotMark::Diamond}},
    Family{TechniqueKind::Lod, "one pass, LODs", {2, PlotMark::Triangle}},
    Family{TechniqueKind::Relief, "relief images", {7, PlotMark::Diamond}},
    Family{TechniqueKind::RayCast, "ray cast (reference)", {4, PlotMark::Cross}},
};

/// One of the three errors.
struct Measure {
    const char* name;
    const char* unit;
    double (*of)(const PictureError&);
    double least; ///< the axis goes no lower: no visitor sees less
    double Limits::*limit;
};
constexpr std::array measures = {
    Measure{"Silhouette error", "% of the artifact's pixels",
            [](const PictureError& e) { return e.silhouette_percent; }, 0.01, &Limits::silhouette_percent},
    Measure{"Geometric error", "mean distance, mm", [](const PictureError& e) { return e.geometric_mean_mm; },
            0.001, &Limits::geometric_mean_mm},
    Measure{"Colour error", "RMSE against 16 rays, 8-bit codes",
            [](const PictureError& e) { return e.sixteen_rays.rmse; }, 1.0, &Limits::colour_rmse},
};

std::string label_of(const TechniqueResult& technique) {
    const bool lod = technique.kind == TechniqueKind::Lod || technique.kind == TechniqueKind::TwoPassLod;
    return lod ? fmt::format("{:.0f}k", static_cast<double>(technique.triangles) / 1000.0) : technique.name;
}

/// The family's front as a line; beside it, what is not on the front.
void add_family(const SetUpResult& result, const Family& family, const Measure& measure, Plot& plot) {
    std::vector<const TechniqueResult*> members = at_best_eye_images(result);
    std::erase_if(members, [&](const TechniqueResult* one) { return one->kind != family.kind; });
    std::stable_sort(members.begin(), members.end(), [](const TechniqueResult* a, const TechniqueResult* b) {
        return a->times_floor < b->times_floor;
    });
    const auto place = [&measure](const TechniqueResult& one) {
        return glm::dvec2(one.times_floor, measure.of(one.error.mean));
    };
    std::vector<glm::dvec2> places;
    places.reserve(members.size());
    for (const TechniqueResult* one : members) {
        places.push_back(place(*one));
    }
    const std::vector<glm::dvec2> front = pareto_front(places);
    PlotSeries on_front{family.name, {}, true, family.look};
    PlotSeries beside{family.name, {}, false, family.look};
    beside.look.opacity = faint;
    beside.look.in_legend = false;
    for (const TechniqueResult* one : members) {
        const bool best = std::find(front.begin(), front.end(), place(*one)) != front.end();
        (best ? on_front : beside).points.push_back({place(*one), label_of(*one)});
    }
    for (PlotSeries* series : {&on_front, &beside}) {
        if (!series->points.empty()) {
            plot.series.push_back(std::move(*series));
        }
    }
}

void add_worst_pose(const SetUpResult& result, const Measure& measure, Plot& plot) {
    PlotSeries worst{"the same, worst pose", {}, true, {6, PlotMark::Ring, 1.0, true}};
    for (const TechniqueResult& technique : result.techniques) {
        if (technique.kind == TechniqueKind::PackLevel) {
            worst.points.push_back({{technique.times_floor, measure.of(technique.error.worst)}});
        }
    }
    std::stable_sort(worst.points.begin(), worst.points.end(),
                     [](const PlotPoint& a, const PlotPoint& b) { return a.at.x < b.at.x; });
    plot.series.push_back(std::move(worst));
}

Plot plot_of(const Measure& measure, std::string title) {
    Plot plot{std::move(title), cost_label, measure.unit, true, true, {}, {}};
    plot.y_least = measure.least;
    return plot;
}

/// A family's points of every artifact in one set-up.
std::vector<std::vector<glm::dvec2>> points_of(std::span<const ArtifactResults> artifacts,
                                               const std::string& set_up, const Family& family,
                                               const Measure& measure) {
    std::vector<std::vector<glm::dvec2>> all;
    for (const ArtifactResults& artifact : artifacts) {
        for (const SetUpResult& result : artifact.set_ups) {
            if (result.name != set_up) {
                continue;
            }
            std::vector<glm::dvec2> points;
            for (const TechniqueResult* one : at_best_eye_images(result)) {
                if (one->kind == family.kind) {
                    points.emplace_back(one->times_floor, measure.of(one->error.mean));
                }
            }
            if (!points.empty()) { // a small mesh has no LODs: nothing to be counted against
                all.push_back(std::move(points));
            }
        }
    }
    return all;
}

Plot overall_plot(std::span<const ArtifactResults> artifacts, const std::string& set_up,
                  const Measure& measure) {
    Plot plot = plot_of(measure, fmt::format("{}, {} set-up", measure.name, set_up));
    plot.corner = "better ↙";
    std::vector<PlotSeries> lines;
    for (const Family& family : families) {
        const std::vector<std::vector<glm::dvec2>> all = points_of(artifacts, set_up, family, measure);
        PlotSeries members{family.name, {}, false, family.look};
        members.look.opacity = faint;
        members.look.in_legend = false;
        for (const std::vector<glm::dvec2>& points : all) {
            for (const glm::dvec2& point : points) {
                members.points.push_back({point});
            }
        }
        PlotSeries line{family.name, {}, true, family.look};
        line.look.line_px = family.kind == TechniqueKind::PackLevel ? 3.5 : 2.0;
        line.look.stepped = true;
        for (const glm::dvec2& point : median_attainment(all)) {
            line.points.push_back({point});
        }
        plot.series.push_back(std::move(members));
        lines.push_back(std::move(line));
    }
    plot.series.insert(plot.series.begin(), std::make_move_iterator(lines.begin()),
                       std::make_move_iterator(lines.end()));
    std::erase_if(plot.series, [](const PlotSeries& series) { return series.points.empty(); });
    return plot;
}

} // namespace

std::string error_time_svg(const SetUpResult& result, const std::string& pack_title) {
    std::vector<Plot> plots;
    for (const Measure& measure : measures) {
        Plot plot = plot_of(measure, fmt::format("{}: {}, {} set-up", measure.name, pack_title, result.name));
        for (const Family& family : families) {
            add_family(result, family, measure, plot);
            if (family.kind == TechniqueKind::PackLevel) {
                add_worst_pose(result, measure, plot);
            }
        }
        plot.limits = {{default_level_limits.*measure.limit, "default level's limit"},
                       {finest_level_limits.*measure.limit, "finest level's limit"}};
        plots.push_back(std::move(plot));
    }
    return svg_of(plots);
}

std::string overall_svg(std::span<const ArtifactResults> artifacts) {
    std::vector<std::string> set_ups;
    for (const ArtifactResults& artifact : artifacts) {
        for (const SetUpResult& result : artifact.set_ups) {
            if (std::find(set_ups.begin(), set_ups.end(), result.name) == set_ups.end()) {
                set_ups.push_back(result.name);
            }
        }
    }
    std::vector<Plot> plots;
    for (const std::string& set_up : set_ups) {
        for (const Measure& measure : measures) {
            plots.push_back(overall_plot(artifacts, set_up, measure));
        }
    }
    std::string titles;
    for (const ArtifactResults& artifact : artifacts) {
        titles += (titles.empty() ? "" : ", ") + artifact.title;
    }
    const std::array notes = {
        std::string(
            "Lines: the error that at least half of the artifacts reach at that cost. Faint marks: each "
            "technique on each artifact, mean of all poses. Two-pass at its best eye image; peers take one "
            "sample a pixel."),
        "Artifacts: " + titles + "."};
    return svg_sheet(
        fmt::format("Error against cost, {} artifact{}", artifacts.size(), artifacts.size() == 1 ? "" : "s"),
        plots, measures.size(), notes);
}

} // namespace frustumscreen

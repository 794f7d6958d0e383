#include "app/bench/torch/torch_bench.h"

#include "app/bench/measures/timing.h"
#include "firmware_host/base/quantile.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

namespace frustumscreen::bench {

namespace {

constexpr std::array edge_lengths_m{0.032, 0.008, 0.004, 0.002};
constexpr double steered_from_m =
    0.002; ///< the frame time that is held is what this length takes in the median
struct NamedBound {
    const char* name;
    double tolerance;
};
constexpr std::array bounds{NamedBound{"paper_curvature_2pct", 0.02},
                            NamedBound{"paper_curvature_0.5pct", 0.005}};

TorchWay paper_way(std::string name, std::size_t frames, double tolerance,
                   torch::Splitting::By by = torch::Splitting::By::Length) {
    return {.name = std::move(name),
            .kind = TorchWay::Kind::Paper,
            .by = by,
            .tolerances = std::vector<double>(frames, tolerance)};
}

/// One scene and its techniques.
class SceneRun {
public:
    SceneRun(TorchSet& set, const TorchScene& scene, const std::vector<TorchFrame>& sweep, int passes)
        : set_(set), scene_(scene), sweep_(sweep), beam_(sweep_beam()), passes_(passes) {}

    [[nodiscard]] Result<void> add(TorchWay way) {
        TRY(std::unique_ptr<TorchTechnique> technique,
            TorchTechnique::create(set_, scene_, beam_, std::move(way)));
        timed_.push_back({std::move(technique),
                          std::vector<double>(sweep_.size(), std::numeric_limits<double>::infinity()),
                          std::vector<std::size_t>(sweep_.size(), 0),
                          {}});
        return {};
    }
    /// Those from `first` on, in turn. The driver compiles its own programs in each one's first pictures.
    void time(std::size_t first, const std::function<void(double)>& progress) {
        for (std::size_t k = first; k < timed_.size(); ++k) {
            warm_up(*timed_[k].technique);
        }
        const double all = static_cast<double>(passes_) * static_cast<double>(timed_.size() - first);
        double done = 0.0;
        for (int pass = 0; pass < passes_; ++pass) {
            for (std::size_t k = first; k < timed_.size(); ++k) {
                time_pass(timed_[k]);
                progress(++done / all);
            }
        }
    }
    /// Live, frame by frame; leaves its tolerances in the technique.
    [[nodiscard]] Result<void> steer(double frame_ms) {
        TRY_VOID(add(paper_way("paper_steered", sweep_.size(), steered_from_m)));
        Timed& steered = timed_.back();
        warm_up(*steered.technique);
        torch::ToleranceControl control(frame_ms, steered_from_m, {0.0005, 0.05});
        for (std::size_t frame = 0; frame < sweep_.size(); ++frame) {
            steered.technique->set_tolerance(frame, control.tolerance());
            const double ms = ms_of([&] { steered.technique->draw(sweep_[frame], frame, false); });
            steered.frame_ms[frame] = std::min(steered.frame_ms[frame], ms);
            (void)control.next(ms);
        }
        return {};
    }
    void measure_errors(int count, const std::function<void(double)>& progress) {
        const std::size_t frames = std::min(sweep_.size(), static_cast<std::size_t>(count));
        image::Image8 drawn;
        const DrawnSurface drawn_surface(scene_.drawn.parts);
        const DrawnSurface polygons(scene_.polygons.parts);
        for (std::size_t k = 0; k < frames; ++k) {
            const std::size_t frame = (2 * k + 1) * sweep_.size() / (2 * frames);
            const geometry::RigidTransform prop_from_torch =
                sweep_[frame].pose.table_from_prop.inverse() * sweep_[frame].table_from_torch;
            const glm::dvec3 eye_m =
                sweep_[frame].pose.table_from_prop.inverse().point(sweep_[frame].pose.eye_m);
            std::array<std::optional<TorchTruth>, 2> truths; // of the scene, and of its polygons
            for (Timed& timed : timed_) {
                TorchTechnique& technique = *timed.technique;
                if (technique.way().samples > 1) {
                    continue;
                }
                technique.draw(sweep_[frame], frame, true);
                set_.cells().read_colour_into(drawn);
                const bool is_paper = technique.way().kind == TorchWay::Kind::Paper;
                std::optional<TorchTruth>& own = truths.at(is_paper ? 1 : 0);
                if (!own) {
                    own =
                        cast_torch(is_paper ? polygons : drawn_surface,
                                   set_.cells().hit_points(technique.plan()), eye_m, prop_from_torch, beam_);
                }
                timed.error.add(*own, drawn);
            }
            progress(static_cast<double>(k + 1) / static_cast<double>(frames));
        }
    }
    [[nodiscard]] std::vector<TorchRow> rows() const {
        std::vector<TorchRow> rows;
        for (const Timed& timed : timed_) {
            rows.push_back(
                {scene_.name, timed.technique->way(), timed.frame_ms, timed.triangles, timed.error});
        }
        return rows;
    }
    [[nodiscard]] std::size_t count() const { return timed_.size(); }

private:
    struct Timed {
        std::unique_ptr<TorchTechnique> technique;
        std::vector<double> frame_ms;
        std::vector<std::size_t> triangles;
        IntensityError error;
    };
    void warm_up(TorchTechnique& technique) {
        for (std::size_t frame = 0; frame < std::min<std::size_t>(sweep_.size(), 4); ++frame) {
            (void)ms_of([&] { technique.draw(sweep_[frame], frame, false); });
        }
    }
    void time_pass(Timed& timed) {
        for (std::size_t frame = 0; frame < sweep_.size(); ++frame) {
            keep_min_ms(timed.frame_ms[frame], [&] { timed.technique->draw(sweep_[frame], frame, false); });
            timed.triangles[frame] = timed.technique->lit_triangles();
        }
    }

    TorchSet& set_;
    const TorchScene& scene_;
    const std::vector<TorchFrame>& sweep_;
    torch::Beam beam_;
    int passes_;
    std::vector<Timed> timed_;
};

double mean_of(const std::vector<double>& values) {
    return values.empty()
               ? 0.0
               : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Result<std::vector<TorchRow>> measure_scene(TorchSet& set, const TorchScene& scene,
                                            const std::vector<TorchFrame>& sweep, const TorchOptions& options,
                                            const TorchProgress& progress) {
    const auto step = [&](const char* what) {
        return [&progress, name = scene.name + ", " + what](double done) { progress(name, done); };
    };
    SceneRun run(set, scene, sweep, options.passes);
    for (const int samples : {1, set.samples()}) {
        TRY_VOID(run.add({.name = "none", .kind = TorchWay::Kind::None, .samples = samples}));
        TRY_VOID(run.add({.name = "ours", .kind = TorchWay::Kind::Ours, .samples = samples}));
        TRY_VOID(
            run.add({.name = "ours_no_shadow", .kind = TorchWay::Kind::OursNoShadow, .samples = samples}));
        if (set.samples() == 1) {
            break;
        }
    }
    for (const double length_m : edge_lengths_m) {
        TRY_VOID(run.add(paper_way("paper", sweep.size(), length_m)));
    }
    for (const NamedBound& bound : bounds) {
        TRY_VOID(run.add(paper_way(bound.name, sweep.size(), bound.tolerance, torch::Splitting::By::Bound)));
    }
    run.time(0, step("times"));
    double steered_ms = 0.0;
    for (const TorchRow& row : run.rows()) {
        if (row.way.name == "paper" && row.way.tolerances.front() == steered_from_m) {
            steered_ms = row.ms_p50();
        }
    }
    const std::size_t steered = run.count();
    TRY_VOID(run.steer(steered_ms));
    TRY_VOID(run.add(paper_way("paper_fixed", sweep.size(), mean_of(run.rows().back().way.tolerances))));
    run.time(steered, step("a steered tolerance"));
    run.measure_errors(options.errors, step("errors"));
    return run.rows();
}

} // namespace

double TorchRow::ms_p50() const {
    return quantile(frame_ms, 0.5);
}
double TorchRow::ms_p99() const {
    return quantile(frame_ms, 0.99);
}
double TorchRow::tolerance_mm() const {
    return way.by == torch::Splitting::By::Length ? 1e3 * mean_of(way.tolerances) : 0.0;
}

Result<TorchResult> measure_torch(TorchSet& set, const TorchOptions& options, const TorchProgress& progress) {
    TRY(const std::vector<TorchFrame> sweep,
        draw_sweep(set.settings(), set.prop(), set.box(), options.frames, options.seed));
    TorchResult result;
    for (const TorchScene& scene : set.scenes()) {
        TRY(const std::vector<TorchRow> rows, measure_scene(set, scene, sweep, options, progress));
        for (const TorchRow& row : rows) {
            (row.way.samples > 1 ? result.samples : result.rows).push_back(row);
        }
    }
    return result;
}

} // namespace frustumscreen::bench

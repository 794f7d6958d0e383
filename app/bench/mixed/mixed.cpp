#include "app/bench/mixed/mixed.h"

#include "app/bench/measures/timing.h"
#include "app/bench/mixed/mixed_techniques.h"
#include "app/bench/mixed/mixed_walk.h"
#include "app/bench/mixed/popping.h"
#include "app/bench/truth/lit_source.h"
#include "app/pack/pack_file.h"
#include "firmware_host/base/quantile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace frustumscreen::bench {

namespace {

using StepProgress = std::function<void(const std::string& step, double done)>;

/// One pass over the walk: keeps each frame's least time, milliseconds.
void time_pass(MixedTechnique& technique, const std::vector<BenchPose>& walk, std::vector<double>& min_ms) {
    min_ms.resize(walk.size(), std::numeric_limits<double>::infinity());
    technique.begin();
    for (std::size_t frame = 0; frame < walk.size(); ++frame) {
        keep_min_ms(min_ms[frame], [&] { technique.draw(frame, walk[frame]); });
    }
}

std::vector<BenchPose> every(std::size_t step, const std::vector<BenchPose>& walk) {
    std::vector<BenchPose> thin;
    for (std::size_t k = 0; k < walk.size(); k += step) {
        thin.push_back(walk[k]);
    }
    return thin;
}

/// All cells drawn alike.
struct Uniformly {
    double share = 0.0;
    bool relief = false;
};
constexpr std::array uniform_ways{Uniformly{0.0, false}, Uniformly{0.33, false}, Uniformly{0.67, false},
                                  Uniformly{1.0, false}, Uniformly{0.0, true},   Uniformly{0.5, true},
                                  Uniformly{1.0, true}};

struct Learned {
    scene::FrameCost cost;
    double finest_ms = 0.0, cheapest_ms = 0.0; ///< 99th percentiles
};

Learned learn_times(CellSet& set, const std::vector<BenchPose>& poses, int passes,
                    const StepProgress& progress) {
    std::vector<scene::QualityLevelTime> times;
    Learned learned;
    for (std::size_t k = 0; k < uniform_ways.size(); ++k) {
        const Uniformly& way = uniform_ways.at(k);
        const std::unique_ptr<MixedTechnique> technique = make_uniform(set, way.share, way.relief);
        std::vector<double> ms;
        time_pass(*technique, poses, ms);
        ms.clear(); // the driver compiled its own programs
        for (int pass = 0; pass < passes; ++pass) {
            time_pass(*technique, poses, ms);
        }
        for (std::size_t pose = 0; pose < poses.size(); ++pose) {
            times.push_back({.samples = set.whole().samples,
                             .work = uniform_work(set, way.share, way.relief, poses[pose]),
                             .ms = ms[pose],
                             .relief = way.relief,
                             .on_gpu = false});
        }
        const double p99 = quantile(ms, 0.99);
        learned.finest_ms = k == 0 ? p99 : learned.finest_ms;
        learned.cheapest_ms = k == 0 ? p99 : std::min(learned.cheapest_ms, p99);
        progress("the time model", static_cast<double>(k + 1) / uniform_ways.size());
    }
    learned.cost = scene::cost_of(times);
    return learned;
}

/// From `high` to `low`, in equal ratios.
std::vector<double> spread(double high, double low, int count) {
    std::vector<double> values;
    for (int k = 0; k < count; ++k) {
        values.push_back(high * std::pow(low / high, count > 1 ? static_cast<double>(k) / (count - 1) : 0.0));
    }
    return values;
}

/// A technique at one step of its own budget, ascending.
struct Step {
    std::unique_ptr<MixedTechnique> technique;
    std::vector<double> frame_ms;
    std::size_t switches = 0;

    [[nodiscard]] double ms_p99() const { return quantile(frame_ms, 0.99); }
};

/// The steps take turns, so that a disturbance of the machine meets none of them in all passes.
void time_steps(std::span<Step* const> steps, const std::vector<BenchPose>& walk, int passes,
                const StepProgress& progress) {
    for (int pass = 0; pass < passes; ++pass) {
        for (std::size_t k = 0; k < steps.size(); ++k) {
            progress("times", (pass + static_cast<double>(k) / static_cast<double>(steps.size())) / passes);
            time_pass(*steps[k]->technique, walk, steps[k]->frame_ms);
            steps[k]->switches = steps[k]->technique->switches();
        }
    }
}

std::size_t largest_within(const std::vector<Step>& steps, double budget_ms) {
    for (std::size_t k = steps.size(); k-- > 0;) {
        if (steps[k].ms_p99() <= budget_ms) {
            return k;
        }
    }
    const auto quickest = std::min_element(
        steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.ms_p99() < b.ms_p99(); });
    return static_cast<std::size_t>(quickest - steps.begin());
}

/// The least 99th percentile, and that of every cell at its finest.
std::pair<double, double> range_of(const std::vector<Step>& ours, const std::vector<Step>& papers) {
    std::vector<double> all_ms;
    for (const auto* const steps : {&ours, &papers}) {
        for (const Step& step : *steps) {
            all_ms.push_back(step.ms_p99());
        }
    }
    const auto least = std::min_element(all_ms.begin(), all_ms.end());
    constexpr double kept_by_both = 1.03; // the cheapest of the two ways differ by as much as times do
    return {kept_by_both * *least, std::max(kept_by_both * papers.back().ms_p99(), kept_by_both * *least)};
}

/// The picture's errors over a walk.
struct WalkErrors {
    Popping popping;
    double error_mm = 0.0, silhouette_percent = 0.0; ///< sums
    int judged = 0;
};

/// All steps side by side, so that each frame is cast once.
Result<std::vector<WalkErrors>> measure_errors(CellSet& set, const Truth& truth, std::span<Step* const> steps,
                                               const std::vector<BenchPose>& walk, int error_every,
                                               const StepProgress& progress) {
    std::vector<WalkErrors> errors(steps.size());
    for (Step* step : steps) {
        step->technique->begin();
    }
    Drawn drawn;
    for (std::size_t frame = 0; frame < walk.size(); ++frame) {
        progress("errors", static_cast<double>(frame) / static_cast<double>(walk.size()));
        const TruthPicture picture = truth.cast(set.prop(), view_of(set.settings(), walk[frame]), true);
        for (std::size_t k = 0; k < steps.size(); ++k) {
            steps[k]->technique->draw(frame, walk[frame]);
            set.read_colour_into(drawn.colour);
            errors[k].popping.add(drawn.colour, picture.colour16, picture.prop);
            if (frame % static_cast<std::size_t>(error_every) == 0) {
                drawn.point_m = set.hit_points(steps[k]->technique->plan());
                const PictureError error = measure(picture, drawn);
                errors[k].error_mm += error.geometric_mean_mm;
                errors[k].silhouette_percent += error.silhouette_percent;
                ++errors[k].judged;
            }
        }
    }
    return errors;
}

/// Polygons of all cells at their finest.
double all_polygons(const CellSet& set) {
    double sum = 0.0;
    for (const CellWays& cell : set.cells()) {
        sum += static_cast<double>(cell.meshes.front().polygons);
    }
    return sum;
}

PaperWeights weights_for(const CellSet& set, const std::vector<BenchPose>& poses) {
    std::vector<std::vector<PaperCell>> frames;
    for (const BenchPose& pose : poses) {
        frames.push_back(paper_cells(set, pose));
    }
    const double all = all_polygons(set);
    const std::array budgets{0.25 * all, 0.5 * all, 0.75 * all};
    return find_weights(frames, budgets);
}

} // namespace

Result<MixedResult> measure_mixed(const settings::Settings& settings, const std::filesystem::path& pack,
                                  const std::shared_ptr<const bake::SourceMesh>& mesh,
                                  const MixedOptions& options, const StepProgress& progress) {
    TRY(const std::unique_ptr<CellSet> set, CellSet::open(settings, pack, options.samples));
    TRY(const std::vector<BenchPose> walk, draw_walk(settings, set->prop(), options.frames, options.seed));
    TRY(const std::vector<BenchPose> other,
        draw_walk(settings, set->prop(), options.frames, options.seed + 1));
    TRY(const pack::VerifiedPack whole, pack::load_pack(pack));
    TRY(Truth truth, Truth::build(mesh, pack::place(*whole, set->prop()).prop_from_artifact));
    if (!whole->unlit) {
        truth.light_by(std::make_shared<const LitSource>(mesh, whole->box_from_file));
    }

    const Learned learned = learn_times(*set, every(10, other), options.passes, progress);
    MixedResult result;
    result.cells = set->cells().size();
    result.weights = weights_for(*set, every(10, other));

    std::vector<Step> ours;
    std::vector<Step> papers;
    for (int k = 0; k <= options.steps; ++k) {
        const double share = static_cast<double>(k) / options.steps;
        constexpr double beyond = 2.0; // the model may be wrong, and one walk's frames dearer than another's
        const double low_ms = learned.cheapest_ms / beyond;
        const double deadline_ms = low_ms * std::pow(beyond * learned.finest_ms / low_ms, share);
        ours.push_back({make_ours(*set, deadline_ms, learned.cost), {}, 0});
        papers.push_back({make_paper(*set, result.weights, share * all_polygons(*set)), {}, 0});
    }
    std::vector<Step*> in_turn;
    for (std::size_t k = 0; k < ours.size(); ++k) {
        in_turn.push_back(&ours[k]);
        in_turn.push_back(&papers[k]);
    }
    time_steps(in_turn, walk, options.passes, progress);

    const auto [cheapest_ms, dearest_ms] = range_of(ours, papers);
    std::vector<Step*> taken;
    for (const double budget_ms : spread(dearest_ms, cheapest_ms, options.budgets)) {
        for (auto* const steps : {&ours, &papers}) {
            Step& step = (*steps)[largest_within(*steps, budget_ms)];
            taken.push_back(&step);
            result.rows.push_back({.technique = steps == &ours ? "ours" : "paper",
                                   .budget_us = 1e3 * budget_ms,
                                   .frame_ms = step.frame_ms,
                                   .pop_codes = {},
                                   .error_mm_mean = 0.0,
                                   .silhouette_percent = 0.0,
                                   .switches = step.switches});
        }
    }
    std::vector<Step*> once = taken;
    std::sort(once.begin(), once.end());
    once.erase(std::unique(once.begin(), once.end()), once.end());
    TRY(const std::vector<WalkErrors> errors,
        measure_errors(*set, truth, once, walk, options.error_every, progress));
    for (std::size_t row = 0; row < taken.size(); ++row) {
        const auto at = std::lower_bound(once.begin(), once.end(), taken[row]) - once.begin();
        const WalkErrors& found = errors[static_cast<std::size_t>(at)];
        result.rows[row].pop_codes = found.popping.codes();
        result.rows[row].error_mm_mean = found.error_mm / std::max(1, found.judged);
        result.rows[row].silhouette_percent = found.silhouette_percent / std::max(1, found.judged);
    }
    return result;
}

} // namespace frustumscreen::bench

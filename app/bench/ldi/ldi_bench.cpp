#include "app/bench/ldi/ldi_bench.h"

#include "app/bench/ldi/gpu_windows.h"
#include "app/bench/ldi/plan_windows.h"
#include "app/bench/ldi/splat_windows.h"
#include "app/bench/measures/timing.h"
#include "app/bench/truth/truth.h"
#include "firmware_host/base/quantile.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace frustumscreen::bench {

namespace {

using Techniques = std::vector<std::unique_ptr<WindowTechnique>>;

/// Times one pass over the frames of one technique.
void time_pass(WindowSet& set, WindowTechnique& technique, std::span<const WindowFrame> path, LdiRow& row) {
    for (std::size_t k = 0; k < path.size(); ++k) {
        const WindowFrame& frame = path[k];
        const double begun_ms = cpu_now_ms();
        set.draw_alone(frame.eyes_m.front());
        render::wait_until_drawn();
        for (std::size_t windows = 0;; ++windows) {
            double& min_ms = row.frame_ms.at(windows)[k];
            min_ms = std::min(min_ms, cpu_now_ms() - begun_ms);
            if (windows == frame.eyes_m.size()) {
                break;
            }
            technique.draw(frame.eyes_m.at(windows));
            render::wait_until_drawn();
        }
    }
}

/// Compares the pictures of one set with rays.
class Errors {
public:
    Errors(WindowSet& set, const Truth& truth) : set_(set), truth_(truth) {}
    /// The error of each technique for one eye.
    [[nodiscard]] std::vector<PictureError> at(const Techniques& techniques, const glm::dvec3& eye_m) {
        const scene::FlatScreen& screen = set_.screen();
        const TruthPicture truth = truth_.cast(
            screen.surface,
            {.projector = screen.pinhole, .prop_from_projector = screen.table_from_pinhole, .eye_m = eye_m},
            false);
        std::vector<PictureError> errors;
        for (const std::unique_ptr<WindowTechnique>& technique : techniques) {
            technique->draw(eye_m);
            render::wait_until_drawn();
            Drawn drawn{.colour = set_.read_colour(), .point_m = {}};
            drawn.point_m = technique->hit_points(eye_m);
            errors.push_back(measure(truth, drawn));
        }
        return errors;
    }

private:
    WindowSet& set_;
    const Truth& truth_;
};

std::vector<LdiRow> measure_times(WindowSet& set, const Techniques& techniques, const Truth& truth,
                                  const LdiOptions& options, const std::function<void(double)>& progress) {
    const std::vector<WindowFrame> path = window_path(options.frames, options.seed);
    std::vector<LdiRow> rows;
    for (const std::unique_ptr<WindowTechnique>& technique : techniques) {
        LdiRow& row = rows.emplace_back();
        row.triangles = set.scene().triangles;
        row.technique = technique->name();
        row.mb = static_cast<double>(technique->bytes()) / 1e6;
        row.make_ms = technique->make_ms();
        for (std::vector<double>& of : row.frame_ms) {
            of.assign(path.size(), std::numeric_limits<double>::infinity());
        }
    }
    Errors errors(set, truth);
    const auto count = static_cast<std::size_t>(std::min(options.errors, options.frames));
    for (std::size_t k = 0; k < count;
         ++k) { // before the times, so that the driver has compiled all programs by then
        const WindowFrame& frame = path[(2 * k + 1) * path.size() / (2 * count)];
        const std::vector<PictureError> of = errors.at(techniques, frame.eyes_m.at(k % frame.eyes_m.size()));
        for (std::size_t technique = 0; technique < rows.size(); ++technique) {
            rows[technique].error.add(of[technique]);
        }
        progress(0.3 * static_cast<double>(k) / static_cast<double>(count));
    }
    const double all = static_cast<double>(options.passes) * static_cast<double>(techniques.size());
    double done = 0.0;
    for (int pass = 0; pass < options.passes; ++pass) {
        for (std::size_t k = 0; k < techniques.size(); ++k) {
            time_pass(set, *techniques[k], path, rows[k]);
            progress(0.3 + 0.7 * ++done / all);
        }
    }
    for (LdiRow& row : rows) {
        row.error = row.error.mean();
    }
    return rows;
}

void measure_patches(WindowSet& set, const Techniques& techniques, const Truth& truth,
                     const LdiOptions& options, std::vector<LdiPatchRow>& rows,
                     const std::function<void(double)>& progress) {
    const ldi::Hemisphere hemisphere(frozen_from_m);
    Errors errors(set, truth);
    for (std::size_t patch = 0; patch < ldi::patch_count; ++patch) {
        std::vector<LdiError> sums(techniques.size());
        for (const glm::dvec3& eye_m :
             eyes_in_patch(hemisphere, patch, options.eyes_in_patch, options.seed)) {
            const std::vector<PictureError> of = errors.at(techniques, eye_m);
            for (std::size_t k = 0; k < sums.size(); ++k) {
                sums[k].add(of[k]);
            }
        }
        for (std::size_t k = 0; k < sums.size(); ++k) {
            rows.push_back(
                {set.scene().triangles, techniques[k]->name(), set.pixels(), patch, sums[k].mean()});
        }
        progress(static_cast<double>(patch + 1) / static_cast<double>(ldi::patch_count));
    }
}

std::vector<LdiPicture> take_pictures(WindowSet& set, const Techniques& techniques,
                                      const LdiOptions& options) {
    const glm::dvec3 eye_m = window_path(options.frames, options.seed).front().eyes_m.front();
    set.draw_alone(eye_m);
    std::vector<LdiPicture> pictures{{"alone", set.read_alone()}};
    for (const std::unique_ptr<WindowTechnique>& technique : techniques) {
        technique->draw(eye_m);
        pictures.push_back({technique->name(), set.read_colour()});
    }
    return pictures;
}

} // namespace

void LdiError::add(const PictureError& error) {
    silhouette_pct += error.silhouette_percent;
    error_mm += error.geometric_mean_mm;
    rmse += error.one_ray.rmse;
    ++pictures;
}
LdiError LdiError::mean() const {
    const double share = pictures > 0 ? 1.0 / pictures : 0.0;
    return {share * silhouette_pct, share * error_mm, share * rmse, pictures};
}

double LdiRow::ms_p50(std::size_t windows) const {
    return quantile(frame_ms.at(windows), 0.5);
}
double LdiRow::ms_p99(std::size_t windows) const {
    return quantile(frame_ms.at(windows), 0.99);
}
double LdiRow::window_ms() const {
    std::vector<double> extra;
    for (std::size_t frame = 0; frame < frame_ms.front().size(); ++frame) {
        extra.push_back((frame_ms.back()[frame] - frame_ms.front()[frame]) / max_windows);
    }
    return quantile(extra, 0.5);
}

Result<Techniques> window_techniques(WindowSet& set, bool coarse) {
    Techniques techniques;
    techniques.push_back(make_window_geometry(set));
    TRY(techniques.emplace_back(), make_window_lod(set));
    techniques.push_back(make_window_relief(set));
    techniques.push_back(make_window_ours(set));
    techniques.push_back(make_window_patches(set, 1));
    if (coarse) {
        techniques.push_back(make_window_patches(set, 2));
        techniques.push_back(make_window_patches(set, 4));
    }
    techniques.push_back(make_multi_ldi(set));
    techniques.push_back(make_single_ldi(set));
    techniques.push_back(make_image_based_object(set));
    TRY(techniques.emplace_back(), make_window_points(set));
    TRY(techniques.emplace_back(), make_cube_depth(set));
    TRY(techniques.emplace_back(), make_view_depth(set));
    return techniques;
}

Result<LdiResult> measure_ldi(const settings::Settings& settings, const LdiOptions& options,
                              const LdiProgress& progress) {
    LdiResult result;
    const std::size_t largest = *std::max_element(options.triangles.begin(), options.triangles.end());
    for (const std::size_t triangles : options.triangles) {
        const auto step = [&](const std::string& what) {
            const std::string name = fmt::format("{} triangles, {}", triangles, what);
            progress(name, 0.0);
            return [&progress, name](double done) { progress(name, done); };
        };
        (void)step("the scene");
        const WindowScene scene = make_window_scene(triangles, options.seed);
        TRY(const Truth truth, Truth::build(scene.mesh, scene.window_from_site));
        std::vector<int> resolutions{options.pixels};
        if (triangles == largest) {
            std::copy_if(options.resolutions.begin(), options.resolutions.end(),
                         std::back_inserter(resolutions),
                         [&](int pixels) { return pixels != options.pixels; });
        }
        for (const int pixels : resolutions) {
            (void)step(fmt::format("windows of {} pixels are made", pixels));
            TRY(const std::unique_ptr<WindowSet> set, WindowSet::open(settings, scene, pixels));
            TRY(const Techniques techniques, window_techniques(*set, options.coarse));
            if (pixels == options.pixels) {
                std::vector<LdiRow> rows = measure_times(*set, techniques, truth, options, step("times"));
                std::move(rows.begin(), rows.end(), std::back_inserter(result.rows));
            }
            if (triangles == largest && pixels == options.pixels) {
                result.pictures = take_pictures(*set, techniques, options);
            }
            if (triangles == largest && !options.resolutions.empty()) {
                measure_patches(*set, techniques, truth, options, result.by_patch,
                                step(fmt::format("errors at {} pixels", pixels)));
            }
        }
    }
    return result;
}

} // namespace frustumscreen::bench

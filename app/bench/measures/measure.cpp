#include "app/bench/measures/measure.h"

#include "app/bench/measures/picture_shift.h"
#include "firmware_host/base/quantile.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::bench {

namespace {

bool is_hit(const image::ImageFloat& points, int x, int y) {
    return !std::isnan(points.at(x, y).x);
}

bool on_outline(const image::Image<std::uint8_t>& hit, int x, int y) {
    const auto missed = [&hit](int column, int row) {
        return column < 0 || row < 0 || column >= hit.width || row >= hit.height || hit.at(column, row) == 0;
    };
    return missed(x - 1, y) || missed(x + 1, y) || missed(x, y - 1) || missed(x, y + 1);
}

class ColourSum {
public:
    void add(const glm::u8vec4& drawn, const glm::u8vec4& truth) {
        const glm::ivec3 off = glm::abs(glm::ivec3(drawn) - glm::ivec3(truth));
        squares_ += off.r * off.r + off.g * off.g + off.b * off.b;
        bad_ += std::max({off.r, off.g, off.b}) > 16 ? 1 : 0;
        ++pixels_;
    }
    [[nodiscard]] ColourError error() const {
        if (pixels_ == 0) {
            return {};
        }
        const auto pixels = static_cast<double>(pixels_);
        return {std::sqrt(static_cast<double>(squares_) / (3.0 * pixels)),
                100.0 * static_cast<double>(bad_) / pixels};
    }

private:
    std::int64_t squares_ = 0;
    std::int64_t bad_ = 0;
    std::int64_t pixels_ = 0;
};

} // namespace

PictureError measure(const TruthPicture& truth, const Drawn& drawn) {
    PictureError error;
    ColourSum one_ray;
    ColourSum sixteen_rays;
    std::vector<double> distances_mm;
    for (int y = 0; y < truth.hit.height; ++y) {
        for (int x = 0; x < truth.hit.width; ++x) {
            const bool hit = truth.hit.at(x, y) != 0;
            error.mismatched_pixels += hit != is_hit(drawn.point_m, x, y) ? 1 : 0;
            if (!hit) {
                continue;
            }
            ++error.truth_pixels;
            error.outline_pixels += on_outline(truth.hit, x, y) ? 1 : 0;
            if (!is_hit(drawn.point_m, x, y)) {
                continue;
            }
            const glm::dvec3 off_m = glm::dvec3(drawn.point_m.at(x, y)) - glm::dvec3(truth.point_m.at(x, y));
            distances_mm.push_back(1000.0 * glm::length(off_m));
            one_ray.add(drawn.colour.at(x, y), truth.colour.at(x, y));
            if (truth.colour16.width > 0) {
                sixteen_rays.add(drawn.colour.at(x, y), truth.colour16.at(x, y));
            }
        }
    }
    double sum_mm = 0.0;
    for (const double distance_mm : distances_mm) {
        sum_mm += distance_mm;
    }
    error.geometric_mean_mm = distances_mm.empty() ? 0.0 : sum_mm / static_cast<double>(distances_mm.size());
    error.geometric_p95_mm = quantile(std::move(distances_mm), 0.95);
    const auto mismatched = static_cast<double>(error.mismatched_pixels);
    error.silhouette_percent =
        100.0 * mismatched / static_cast<double>(std::max<std::int64_t>(error.truth_pixels, 1));
    error.outline_shift_px =
        mismatched / static_cast<double>(std::max<std::int64_t>(error.outline_pixels, 1));
    if (truth.colour16.width > 0) {
        error.picture_shift_px =
            glm::length(picture_shift(truth.colour16, drawn.colour).value_or(glm::dvec2(0.0)));
    }
    error.one_ray = one_ray.error();
    error.sixteen_rays = sixteen_rays.error();
    return error;
}

ShownError measure_shown(const TruthPicture& truth, const ShownImages& shown,
                         const image::Image<float>& cover_of_samples, const image::ImageFloat& points_m) {
    const std::array<float, 256>& linear = image::linear_from_srgb8();
    ShownError error;
    ColourSum colour;
    std::int64_t outline_pixels = 0;
    for (int y = 0; y < truth.hit.height; ++y) {
        for (int x = 0; x < truth.hit.width; ++x) {
            const double cover = truth.met_by_16.at(x, y) / 16.0;
            const double off = static_cast<double>(linear[shown.white.at(x, y).g]) - cover;
            error.cover_px += std::abs(off);
            error.cover_bias_px += off;
            error.cover_of_samples_px += std::abs(static_cast<double>(cover_of_samples.at(x, y)) - cover);
            if (truth.hit.at(x, y) == 0) {
                continue;
            }
            outline_pixels += on_outline(truth.hit, x, y) ? 1 : 0;
            if (is_hit(points_m, x, y)) {
                colour.add(shown.colour.at(x, y), truth.shown16.at(x, y));
            }
        }
    }
    const double share = 1.0 / static_cast<double>(std::max<std::int64_t>(outline_pixels, 1));
    error.cover_px *= share;
    error.cover_of_samples_px *= share;
    error.cover_bias_px = share * std::abs(error.cover_bias_px);
    error.colour = colour.error();
    error.shift_px = glm::length(picture_shift(truth.shown16, shown.colour).value_or(glm::dvec2(0.0)));
    return error;
}

ErrorSummary summarise(std::span<const PictureError> errors) {
    constexpr std::array figures = {&PictureError::geometric_mean_mm,  &PictureError::geometric_p95_mm,
                                    &PictureError::silhouette_percent, &PictureError::outline_shift_px,
                                    &PictureError::picture_shift_px,   &PictureError::drawn_shift_px};
    constexpr std::array counts = {&PictureError::truth_pixels, &PictureError::outline_pixels,
                                   &PictureError::mismatched_pixels};
    constexpr std::array colours = {&PictureError::one_ray, &PictureError::sixteen_rays};
    constexpr std::array shown_figures = {&ShownError::cover_px, &ShownError::cover_of_samples_px,
                                          &ShownError::cover_bias_px, &ShownError::shift_px};
    ErrorSummary summary;
    const double share = errors.empty() ? 0.0 : 1.0 / static_cast<double>(errors.size());
    const auto add = [share](double& mean, double& worst, double value) {
        mean += share * value;
        worst = std::max(worst, value);
    };
    const auto add_colour = [&add](ColourError& mean, ColourError& worst, const ColourError& one) {
        add(mean.rmse, worst.rmse, one.rmse);
        add(mean.bad_percent, worst.bad_percent, one.bad_percent);
    };
    for (std::size_t k = 0; k < errors.size(); ++k) {
        const PictureError& error = errors[k];
        if (k == 0 || error.silhouette_percent > summary.worst.silhouette_percent) {
            summary.worst_pose = static_cast<int>(k);
        }
        for (const auto figure : figures) {
            add(summary.mean.*figure, summary.worst.*figure, error.*figure);
        }
        for (const auto colour : colours) {
            add_colour(summary.mean.*colour, summary.worst.*colour, error.*colour);
        }
        if (error.shown) {
            if (!summary.mean.shown) {
                summary.mean.shown.emplace();
                summary.worst.shown.emplace();
            }
            for (const auto figure : shown_figures) {
                add(*summary.mean.shown.*figure, *summary.worst.shown.*figure, *error.shown.*figure);
            }
            add_colour(summary.mean.shown->colour, summary.worst.shown->colour, error.shown->colour);
        }
        for (const auto count : counts) {
            summary.mean.*count += error.*count;
            summary.worst.*count = std::max(summary.worst.*count, error.*count);
        }
    }
    for (const auto count : counts) {
        summary.mean.*count /= std::max<std::int64_t>(std::ssize(errors), 1);
    }
    return summary;
}

} // namespace frustumscreen::bench

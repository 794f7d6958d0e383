#include "app/bench/torch/torch_truth.h"

#include "app/scene/frame_plan.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::bench {

namespace {

constexpr double slack_m = 0.001;

class Caster {
public:
    Caster(const Truth& truth, const geometry::RigidTransform& prop_from_torch, const torch::Beam& beam)
        : truth_(truth), prop_from_torch_(prop_from_torch), torch_from_prop_(prop_from_torch.inverse()),
          beam_(beam), half_extent_(torch::half_extent(beam)), reach_m_(torch::reach_m(beam)) {}

    [[nodiscard]] TorchPlace place_of(const glm::dvec3& point_m, double& intensity) const {
        const glm::dvec3 point = torch_from_prop_.point(point_m);
        if (!near_the_beam(point)) {
            return TorchPlace::Outside;
        }
        intensity = torch::intensity_at(beam_, point);
        const glm::dvec2 step = 2.0 * half_extent_ * point.z / static_cast<double>(scene::torch_picture_px);
        const double way_m = glm::length(point);
        const std::array beside{glm::dvec2(0.0), glm::dvec2(1.0, 0.0), glm::dvec2(-1.0, 0.0),
                                glm::dvec2(0.0, 1.0), glm::dvec2(0.0, -1.0)};
        int lit = 0;
        int shadow = 0;
        for (const glm::dvec2& each : beside) {
            const glm::dvec3 at(glm::dvec2(point) + each * step, point.z);
            if (!torch::place_in_content(beam_, at) || !torch::place_in_content(beam_, 1.01 * at)) {
                return TorchPlace::Unclear;
            }
            const double met_m = way_to_surface(at);
            lit += met_m >= way_m - slack_m ? 1 : 0;
            shadow += met_m < way_m - 3.0 * slack_m ? 1 : 0;
        }
        constexpr int all = 5;
        return lit == all ? TorchPlace::Lit : shadow == all ? TorchPlace::Shadow : TorchPlace::Unclear;
    }

private:
    [[nodiscard]] bool near_the_beam(const glm::dvec3& point) const {
        if (!(point.z > 0.0) || glm::length(point) > reach_m_) {
            return false;
        }
        constexpr double wider = 1.0 + 4.0 / scene::torch_picture_px;
        const glm::dvec2 at = glm::abs(glm::dvec2(point)) / (point.z * half_extent_);
        return beam_.shape == torch::Shape::Round ? glm::length(at) < wider : std::max(at.x, at.y) < wider;
    }
    /// Infinite if the ray meets nothing.
    [[nodiscard]] double way_to_surface(const glm::dvec3& at) const {
        Truth::Hit hit;
        const glm::dvec3 origin = prop_from_torch_.translation;
        return truth_.first_hit(origin, prop_from_torch_.direction(at), hit)
                   ? glm::distance(origin, hit.point_m)
                   : std::numeric_limits<double>::infinity();
    }

    const Truth& truth_;
    geometry::RigidTransform prop_from_torch_, torch_from_prop_;
    torch::Beam beam_;
    glm::dvec2 half_extent_;
    double reach_m_;
};

} // namespace

TorchTruth cast_torch(const Truth& truth, const image::ImageFloat& points_m,
                      const geometry::RigidTransform& prop_from_torch, const torch::Beam& beam) {
    TorchTruth result{.place = {points_m.width, points_m.height},
                      .intensity = {points_m.width, points_m.height}};
    const Caster caster(truth, prop_from_torch, beam);
    const auto width = static_cast<std::size_t>(points_m.width);
    parallel_for(static_cast<std::size_t>(points_m.height), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin * width; k < end * width; ++k) {
            if (std::isnan(points_m.texels[k].x)) {
                continue;
            }
            double intensity = 0.0;
            result.place.texels[k] = caster.place_of(glm::dvec3(points_m.texels[k]), intensity);
            result.intensity.texels[k] = static_cast<float>(intensity);
        }
    });
    return result;
}

void IntensityError::add(const TorchTruth& truth, const image::Image8& drawn) {
    for (std::size_t k = 0; k < drawn.texels.size(); ++k) {
        const TorchPlace place = truth.place.texels[k];
        const double seen = static_cast<double>(image::linear_from_srgb8()[drawn.texels[k].r]);
        if (place == TorchPlace::Lit) {
            const double off = std::abs(seen - static_cast<double>(truth.intensity.texels[k]));
            squares_ += off * off;
            max_ = std::max(max_, off);
            ++pixels_;
        } else if (place == TorchPlace::Shadow) {
            ++shadow_;
            leaks_ += seen > 0.5 * torch::min_intensity ? 1 : 0;
        }
    }
}

double IntensityError::rmse() const {
    return pixels_ > 0 ? 100.0 * std::sqrt(squares_ / static_cast<double>(pixels_)) : 0.0;
}

double IntensityError::leak() const {
    return shadow_ > 0 ? 100.0 * static_cast<double>(leaks_) / static_cast<double>(shadow_) : 0.0;
}

} // namespace frustumscreen::bench

#include "app/bench/torch/torch_truth.h"

#include "app/scene/frame_plan.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::bench {

namespace {

constexpr double rounding_m = 1e-6;
constexpr double same_point_m = 1e-4;
constexpr double edge_on = 0.0175; ///< cosine: one degree

class Caster {
public:
    Caster(const DrawnSurface& surface, const glm::dvec3& eye_m,
           const geometry::RigidTransform& prop_from_torch, const torch::Beam& beam)
        : surface_(surface), eye_m_(eye_m), prop_from_torch_(prop_from_torch),
          torch_from_prop_(prop_from_torch.inverse()), beam_(beam), half_extent_(torch::half_extent(beam)),
          reach_m_(torch::reach_m(beam)) {}

    [[nodiscard]] TorchPlace place_of(const glm::dvec3& point_m, double& intensity) const {
        const glm::dvec3 point = torch_from_prop_.point(point_m);
        if (!near_the_beam(point)) {
            return TorchPlace::Outside;
        }
        intensity = torch::intensity_at(beam_, point);
        const DrawnSurface::Hit seen = surface_.first_hit(eye_m_, point_m - eye_m_);
        if (!seen.hit || glm::distance(seen.point_m, point_m) > same_point_m) {
            return TorchPlace::Unclear;
        }
        const glm::dvec3 to_torch = glm::normalize(prop_from_torch_.translation - point_m);
        const double cosine = glm::dot(seen.normal, to_torch);
        if (std::abs(cosine) < edge_on) {
            return TorchPlace::Unclear;
        }
        const bool turned_away = cosine * glm::dot(seen.normal, eye_m_ - point_m) < 0.0;
        const glm::dvec3 normal = cosine > 0.0 ? seen.normal : -seen.normal; // towards the torch
        int lit = 0;
        int shadow = 0;
        for (int k = 0; k < rays; ++k) {
            const glm::dvec3 at = beside(point, k);
            if (!torch::place_in_content(beam_, at) || !torch::place_in_content(beam_, 1.01 * at)) {
                return TorchPlace::Unclear;
            }
            const Light light = light_at(point_m, normal, at);
            lit += light == Light::Full ? 1 : 0;
            shadow += light == Light::None ? 1 : 0;
        }
        const bool is_shadow = shadow == rays || (turned_away && lit == rays);
        return is_shadow ? TorchPlace::Shadow : lit == rays ? TorchPlace::Lit : TorchPlace::Unclear;
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
    /// The point, eight places around it, half a pixel of the torch's own picture away, and eight a whole pixel away; torch's frame.
    [[nodiscard]] glm::dvec3 beside(const glm::dvec3& point, int ray) const {
        const double angle = 0.25 * std::numbers::pi * ray;
        const double away = ray == 0 ? 0.0 : ray <= 8 ? 1.0 : 2.0;
        const glm::dvec2 half_pixel = half_extent_ * point.z / static_cast<double>(scene::torch_picture_px);
        return point + glm::dvec3(away * half_pixel * glm::dvec2(std::cos(angle), std::sin(angle)), 0.0);
    }
    enum class Light : std::uint8_t { Full, Unsure, None };
    /// The light that the ray through `at`, torch's frame, brings to the plane through a point.
    [[nodiscard]] Light light_at(const glm::dvec3& point_m, const glm::dvec3& normal,
                                 const glm::dvec3& at) const {
        const glm::dvec3 direction = prop_from_torch_.direction(at);
        const DrawnSurface::Hit met = surface_.first_hit(prop_from_torch_.translation, direction);
        if (!met.hit || glm::dot(normal, met.point_m - point_m) < rounding_m) {
            return Light::Full;
        }
        const double plane =
            glm::dot(normal, point_m - prop_from_torch_.translation) / glm::dot(normal, direction);
        if (!(plane > 0.0)) { // the ray goes away from the plane
            return Light::Unsure;
        }
        const double z = torch_from_prop_.point(met.point_m).z;
        const double pixel =
            2.0 * std::max(half_extent_.x, half_extent_.y) / static_cast<double>(scene::torch_picture_px);
        if (z >= plane * at.z * (1.0 - 0.5 * pixel)) {
            return Light::Full;
        }
        return z < plane * at.z * (1.0 - pixel) ? Light::None : Light::Unsure;
    }

    static constexpr int rays = 17;
    const DrawnSurface& surface_;
    glm::dvec3 eye_m_;
    geometry::RigidTransform prop_from_torch_, torch_from_prop_;
    torch::Beam beam_;
    glm::dvec2 half_extent_;
    double reach_m_;
};

} // namespace

TorchTruth cast_torch(const DrawnSurface& surface, const image::ImageFloat& points_m, const glm::dvec3& eye_m,
                      const geometry::RigidTransform& prop_from_torch, const torch::Beam& beam) {
    TorchTruth result{.place = {points_m.width, points_m.height},
                      .intensity = {points_m.width, points_m.height}};
    const Caster caster(surface, eye_m, prop_from_torch, beam);
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
        } else if (place == TorchPlace::Unclear) {
            ++unclear_;
        }
    }
}

double IntensityError::rmse() const {
    return pixels_ > 0 ? 100.0 * std::sqrt(squares_ / static_cast<double>(pixels_)) : 0.0;
}

double IntensityError::unclear() const {
    const std::size_t all = pixels_ + shadow_ + unclear_;
    return all > 0 ? 100.0 * static_cast<double>(unclear_) / static_cast<double>(all) : 0.0;
}

double IntensityError::leak() const {
    return shadow_ > 0 ? 100.0 * static_cast<double>(leaks_) / static_cast<double>(shadow_) : 0.0;
}

} // namespace frustumscreen::bench

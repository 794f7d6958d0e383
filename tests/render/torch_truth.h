/// Which places a torch lights, and how brightly, by rays that meet the objects' triangles. Nothing of app/torch, of the plan or of
/// the renderer is used: the beam is an angle to its axis, a shadow is a triangle on the way, and the light ends where its
/// intensity falls below a hundredth.
///
/// Frames   prop P, metres.
/// Threads  pure; any.
#pragma once

#include "app/scene/placed_torch.h"
#include "tests/render/interlocked.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace frustumscreen::synthetic {

/// The first place that a ray meets from the front: objects that are cut open are seen through from within.
inline SeenPart front_on(const Interlocked& world, glm::dvec3 from, const glm::dvec3& direction) {
    constexpr double step_m = 1e-7;
    SeenPart first = world.first_on(from, direction);
    while (first.part >= 0 && glm::dot(first.normal, direction) > 0.0) {
        from = first.point + step_m * glm::normalize(direction);
        first = world.first_on(from, direction);
    }
    return first;
}

class TorchTruth {
public:
    /// `cut`: nothing before it is on the way of a torch before it.
    TorchTruth(const Interlocked& world, const scene::PlacedTorch& torch, const TestTable& table,
               const std::optional<geometry::Plane>& cut = {})
        : world_(world), beam_(torch.beam),
          prop_from_torch_(table.table_from_prop.inverse() * torch.table_from_torch), cut_(cut) {}

    /// By the distance alone.
    [[nodiscard]] double fallen(double distance_m) const {
        const double full = beam_.full_m;
        const double left = (beam_.dark_m - distance_m) / (beam_.dark_m - full); // 1 at full light
        if (distance_m < full) {
            return 1.0;
        }
        switch (beam_.attenuation) {
        case torch::Attenuation::InverseSquare:
            return std::pow(distance_m / full, -2.0);
        case torch::Attenuation::Linear:
            return std::fmax(0.0, left);
        case torch::Attenuation::SmoothStep:
            return left < 0.0 ? 0.0 : left * left * (3.0 - 2.0 * left);
        case torch::Attenuation::None:
            break;
        }
        return 1.0;
    }
    [[nodiscard]] double distance_to(const glm::dvec3& point) const { return glm::distance(point, origin()); }

    /// Whether the beam holds a place that is not too far, whatever is on the way.
    [[nodiscard]] bool in_beam(const glm::dvec3& point) const {
        const glm::dvec3 q = prop_from_torch_.inverse().point(point);
        const double right = std::atan2(q.x, q.z);
        const double down = std::atan2(q.y, q.z);
        const double half = 0.5 * beam_.opening_rad;
        const double half_down = std::atan(beam_.height_per_width * std::tan(half));
        const bool inside = beam_.shape == torch::Shape::Rectangle
                                ? std::fabs(right) <= half && std::fabs(down) <= half_down
                                : std::fabs(right) < 0.5 * std::numbers::pi &&
                                      std::hypot(std::tan(right) / std::tan(half),
                                                 std::tan(down) / std::tan(half_down)) <= 1.0;
        return inside && fallen(distance_to(point)) >= 0.01;
    }
    /// In the beam, on the side that the torch is on, and nothing on the way.
    [[nodiscard]] bool lights(const SeenPart& place, const glm::dvec3& eye) const {
        return in_beam(place.point) && faces(place, eye) && is_free(place.point);
    }
    [[nodiscard]] bool faces(const SeenPart& place, const glm::dvec3& eye) const {
        return glm::dot(place.normal, origin() - place.point) * glm::dot(place.normal, eye - place.point) >
               0.0;
    }
    [[nodiscard]] bool is_free(const glm::dvec3& point) const {
        const SeenPart first = first_on(point - origin());
        if (is_in_object(first, point - origin())) {
            return false;
        }
        return first.part < 0 || distance_to(first.point) > distance_to(point) * (1.0 - 1e-9) - 1e-9;
    }

    /// The verdict of the rays through the torch's own picture within `radius` of its pixels on a place: all meet something at least
    /// `margin_m` before it; none meets anything before the surface there; or neither.
    enum class Around { Shadow, Lit, Edge };
    [[nodiscard]] Around around(const SeenPart& place, double radius, double margin_m) const {
        const glm::dvec3 q = prop_from_torch_.inverse().point(place.point);
        if (!(q.z > 0.0)) {
            return Around::Edge;
        }
        const double pixel = 2.0 * std::tan(0.5 * beam_.opening_rad) / 512.0;
        bool all_blocked = true;
        bool all_free = true;
        for (int k = 0; k < 48; ++k) {
            const double angle = k * std::numbers::pi / 8.0;
            const double r = radius * pixel * static_cast<double>(k / 16 + 1) / 3.0;
            const glm::dvec3 to = prop_from_torch_.direction(
                {q.x / q.z + r * std::cos(angle), q.y / q.z + r * std::sin(angle), 1.0});
            const SeenPart hit = first_on(to);
            const double depth = is_in_object(hit, to) ? 0.0
                                 : hit.part < 0
                                     ? 1e9
                                     : prop_from_torch_.inverse().point(hit.point).z; // before the torch
            const double surface =
                glm::dot(place.normal, place.point - origin()) / glm::dot(place.normal, to);
            all_blocked = all_blocked && depth < q.z * (1.0 - 0.5 * pixel) - margin_m; // half a pixel bends
            all_free = all_free && surface > 0.0 && depth > surface - margin_m;
        }
        return all_blocked ? Around::Shadow : all_free ? Around::Lit : Around::Edge;
    }

private:
    [[nodiscard]] SeenPart first_on(const glm::dvec3& to) const {
        const double before = cut_ ? cut_->distance(origin()) : 0.0;
        if (!(before > 0.0)) {
            return world_.first_on(origin(), to);
        }
        const double down = -glm::dot(cut_->normal, to);
        return down > 0.0 ? world_.first_on(origin() + before / down * to, to) : SeenPart{};
    }
    /// A ray that begins in an object that is cut open meets it from behind.
    [[nodiscard]] bool is_in_object(const SeenPart& first, const glm::dvec3& to) const {
        return cut_ && cut_->distance(origin()) > 0.0 && first.part >= 0 && glm::dot(first.normal, to) > 0.0;
    }
    [[nodiscard]] const glm::dvec3& origin() const { return prop_from_torch_.translation; }

    const Interlocked& world_;
    torch::Beam beam_;
    geometry::RigidTransform prop_from_torch_;
    std::optional<geometry::Plane> cut_;
};

/// IEC 61966-2-1, linear light of 0..1 and codes of 0..255.
[[nodiscard]] inline double code_of_light(double linear) {
    const double light = std::clamp(linear, 0.0, 1.0);
    return 255.0 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055);
}
[[nodiscard]] inline double light_of_code(double code) {
    const double share = code / 255.0;
    return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
}

} // namespace frustumscreen::synthetic

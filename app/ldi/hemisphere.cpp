#include "app/ldi/hemisphere.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace frustumscreen::ldi {

namespace {

constexpr std::size_t ring_count = patch_count - 1;
constexpr double whole_turn = 2.0 * std::numbers::pi;
constexpr double ring_width_rad = whole_turn / static_cast<double>(ring_count);
constexpr std::size_t centre_cameras = 5;
constexpr std::size_t ring_cameras = 3;
constexpr std::size_t max_seeing = 13;

/// The middle azimuth of a ring patch.
double azimuth_of(std::size_t patch) {
    return static_cast<double>(patch - 1) * ring_width_rad;
}

glm::dvec3 direction_at(double polar_cos, double azimuth_rad) {
    const double polar_sin = std::sqrt(std::max(0.0, 1.0 - polar_cos * polar_cos));
    return {polar_sin * std::cos(azimuth_rad), polar_sin * std::sin(azimuth_rad), polar_cos};
}

constexpr std::size_t first_camera_of(std::size_t patch) {
    return patch == 0 ? 0 : centre_cameras + ring_cameras * (patch - 1);
}
constexpr std::size_t inner_camera_of(std::size_t patch) {
    return first_camera_of(patch);
}
/// `side` 0 is at the lesser azimuth.
constexpr std::size_t outer_camera_of(std::size_t patch, std::size_t side) {
    return first_camera_of(patch) + 1 + side;
}
constexpr std::size_t next_in_ring(std::size_t patch) {
    return patch % ring_count + 1;
}
constexpr std::size_t previous_in_ring(std::size_t patch) {
    return (patch + ring_count - 2) % ring_count + 1;
}

struct Seeing {
    std::size_t count = 0;
    std::array<std::size_t, max_seeing> numbers{};
    constexpr void add(std::size_t number) { numbers[count++] = number; }
};

/// The centre's cameras 1 to 4 stand on borders of two ring patches each, from the first one's end on in steps of a quarter
/// turn, so each ring patch has one of them nearest.
constexpr std::size_t centre_camera_beside(std::size_t patch) {
    return 1 + (patch - 1) / 2;
}

constexpr auto seeing = [] {
    std::array<Seeing, patch_count> all{};
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        for (std::size_t k = 0; k < (patch == 0 ? centre_cameras : ring_cameras); ++k) {
            all[patch].add(first_camera_of(patch) + k);
        }
        if (patch == 0) {
            for (std::size_t other = 1; other < patch_count; ++other) {
                all[patch].add(inner_camera_of(other));
            }
        } else {
            all[patch].add(centre_camera_beside(patch));
            all[patch].add(outer_camera_of(previous_in_ring(patch), 1));
            all[patch].add(outer_camera_of(next_in_ring(patch), 0));
        }
    }
    return all;
}();

constexpr auto neighbours = [] {
    std::array<std::array<std::size_t, ring_count>, patch_count> all{};
    for (std::size_t patch = 1; patch < patch_count; ++patch) {
        all[0][patch - 1] = patch;
        all[patch][1] = previous_in_ring(patch);
        all[patch][2] = next_in_ring(patch);
    }
    return all;
}();

/// The directions of a ring patch, with the cone around the middle that holds them. Along each side of a patch the angle from the
/// middle is largest at an end, so a corner is farthest.
PatchDirections ring_directions(std::size_t patch, double inner_cos, double outer_cos) {
    PatchDirections directions{std::acos(inner_cos),
                               std::acos(outer_cos),
                               azimuth_of(patch),
                               0.5 * ring_width_rad,
                               direction_at(0.5 * (inner_cos + outer_cos), azimuth_of(patch)),
                               0.0};
    double min_cos = 1.0;
    for (const double polar_cos : {inner_cos, outer_cos}) {
        const glm::dvec3 corner =
            direction_at(polar_cos, directions.middle_azimuth_rad + directions.half_width_rad);
        min_cos = std::min(min_cos, glm::dot(corner, directions.axis));
    }
    directions.cone_rad = std::acos(min_cos) + 1e-9;
    return directions;
}

} // namespace

Hemisphere::Hemisphere(double radius_m, double cap_rad, const CameraShares& shares)
    : radius_m_(radius_m), cap_rad_(cap_rad), cap_cos_(std::cos(0.5 * cap_rad)),
      centre_cos_(1.0 - (1.0 - cap_cos_) / static_cast<double>(patch_count)) {
    assert(std::isfinite(radius_m) && radius_m > 0.0);
    assert(cap_rad > 0.0 && cap_rad <= max_cap_rad);
    const double centre_rad = std::acos(centre_cos_);
    directions_[0] = {0.0, centre_rad, 0.0, std::numbers::pi, {0.0, 0.0, 1.0}, centre_rad + 1e-9};
    for (std::size_t patch = 1; patch < patch_count; ++patch) {
        directions_[patch] = ring_directions(patch, centre_cos_, cap_cos_);
    }

    const auto camera_at = [&](double polar_cos, double azimuth_rad) {
        return radius_m * direction_at(polar_cos, azimuth_rad);
    };
    cameras_[0] = {0.0, 0.0, radius_m};
    for (std::size_t k = 1; k < centre_cameras; ++k) {
        cameras_[k] = camera_at(std::lerp(1.0, centre_cos_, shares.centre),
                                (2.0 * static_cast<double>(k - 1) + 0.5) * ring_width_rad);
    }
    for (std::size_t patch = 1; patch < patch_count; ++patch) {
        const double middle = azimuth_of(patch);
        const double outer_cos = std::lerp(centre_cos_, cap_cos_, shares.outer);
        cameras_[inner_camera_of(patch)] = camera_at(std::lerp(centre_cos_, cap_cos_, shares.inner), middle);
        cameras_[outer_camera_of(patch, 0)] = camera_at(outer_cos, middle - 0.25 * ring_width_rad);
        cameras_[outer_camera_of(patch, 1)] = camera_at(outer_cos, middle + 0.25 * ring_width_rad);
    }
}

std::optional<std::size_t> Hemisphere::patch_of(const glm::dvec3& eye) const {
    if (!std::isfinite(eye.x) || !std::isfinite(eye.y) || !std::isfinite(eye.z) || !(eye.z > 0.0)) {
        return std::nullopt;
    }
    const double largest = std::max({std::fabs(eye.x), std::fabs(eye.y), eye.z});
    const glm::dvec3 scaled = eye / largest; // neither overflows nor vanishes when it is squared
    const double length = glm::length(scaled);
    if (scaled.z < cap_cos_ * length) {
        return std::nullopt;
    }
    if (scaled.z >= centre_cos_ * length) {
        return 0;
    }
    const double widths = std::atan2(scaled.y, scaled.x) / ring_width_rad + 0.5; // -3.5 to 4.5
    return 1 + static_cast<std::size_t>(std::floor(widths) + static_cast<double>(ring_count)) % ring_count;
}

ImagePlane Hemisphere::image_plane_of(std::size_t patch) const {
    if (patch == 0) {
        return {};
    }
    const glm::dvec3& first = cameras_[inner_camera_of(patch)];
    glm::dvec3 normal = glm::normalize(
        glm::cross(cameras_[outer_camera_of(patch, 0)] - first, cameras_[outer_camera_of(patch, 1)] - first));
    if (normal.z < 0.0) {
        normal = -normal;
    }
    const glm::dvec3 x(1.0, 0.0, 0.0);
    const glm::dvec3 right = glm::normalize(x - glm::dot(x, normal) * normal);
    return {right, glm::cross(normal, right), normal};
}

std::span<const std::size_t> Hemisphere::neighbours_of(std::size_t patch) const {
    return std::span(neighbours[patch]).first(patch == 0 ? ring_count : 3);
}

std::span<const std::size_t> Hemisphere::own_cameras_of(std::size_t patch) const {
    return cameras_of(patch).first(patch == 0 ? centre_cameras : ring_cameras);
}

std::span<const std::size_t> Hemisphere::cameras_of(std::size_t patch) const {
    return std::span(seeing[patch].numbers).first(seeing[patch].count);
}

} // namespace frustumscreen::ldi

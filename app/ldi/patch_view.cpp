#include "app/ldi/patch_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::ldi {

namespace {

/// Eyes may be this share of the frozen eye's distance nearer or farther than that eye.
constexpr double distance_share = 0.1;

/// Sample eyes all over the patch, with its borders and corners.
std::vector<glm::dvec3> eyes_of(const Hemisphere& hemisphere, std::size_t patch) {
    const PatchDirections& directions = hemisphere.directions_of(patch);
    constexpr int polar_steps = 4;
    const int azimuth_steps = patch == 0 ? 32 : 8;
    std::vector<glm::dvec3> eyes;
    for (int i = 0; i <= polar_steps; ++i) {
        const double polar =
            std::lerp(directions.min_polar_rad, directions.max_polar_rad, double(i) / polar_steps);
        for (int j = 0; j <= azimuth_steps; ++j) {
            const double azimuth =
                directions.middle_azimuth_rad + directions.half_width_rad * (2.0 * j / azimuth_steps - 1.0);
            const glm::dvec3 direction(std::sin(polar) * std::cos(azimuth),
                                       std::sin(polar) * std::sin(azimuth), std::cos(polar));
            eyes.push_back((1.0 - distance_share) * hemisphere.radius_m() * direction);
            eyes.push_back((1.0 + distance_share) * hemisphere.radius_m() * direction);
        }
    }
    for (const std::size_t camera : hemisphere.own_cameras_of(patch)) {
        eyes.push_back(hemisphere.cameras()[camera]);
    }
    return eyes;
}

glm::dmat3 patch_from_window(const Hemisphere& hemisphere, std::size_t patch,
                             const glm::dvec2& half_extent_m) {
    const ImagePlane plane = hemisphere.image_plane_of(patch);
    const double beside_rad = std::atan(glm::length(half_extent_m) / hemisphere.radius_m());
    const double angle_rad =
        std::min(0.5 * std::numbers::pi, hemisphere.directions_of(patch).cone_rad + beside_rad);
    return glm::transpose(glm::dmat3(plane.right, plane.up, std::sin(angle_rad) * plane.normal));
}

std::array<glm::dvec3, 3> corners_of(const TriangleWorld& world, std::uint32_t triangle) {
    const std::uint32_t* indices = &world.indices[3 * std::size_t{triangle}];
    return {glm::dvec3(world.positions[indices[0]]), glm::dvec3(world.positions[indices[1]]),
            glm::dvec3(world.positions[indices[2]])};
}

/// Adds the directions that see a surface with this unit normal, patch frame.
void add_directions(FacingTriangle& facing, const glm::dvec3& normal) {
    constexpr double preferred = 0.05;     // cosine in favour of the direction towards the eyes
    constexpr double shared_cosine = 0.06; // as the bake's
    constexpr double rim_cosine = 0.45;    // a direction that sees it worse by more does not cross it at all
    constexpr double min_cosine = 0.12;    // as the bake's
    std::array<double, grid_directions> merit{};
    double best = 0.0;
    for (std::size_t k = 0; k < grid_directions; ++k) {
        const double cosine = (k % 2 == 0 ? 1.0 : -1.0) * normal[static_cast<int>(k / 2)];
        merit[k] = cosine < min_cosine ? -1.0 : cosine + (k == toward_eyes ? preferred : 0.0);
        best = std::max(best, merit[k]);
    }
    for (std::size_t k = 0; k < grid_directions; ++k) {
        const auto bit = static_cast<std::uint8_t>(1U << k);
        if (merit[k] > 0.0 && merit[k] >= best - rim_cosine) {
            facing.drawn = static_cast<std::uint8_t>(facing.drawn | bit);
        }
        if (merit[k] > 0.0 && merit[k] >= best - shared_cosine) {
            facing.own = static_cast<std::uint8_t>(facing.own | bit);
        }
    }
}

} // namespace

PatchView::PatchView(const Hemisphere& hemisphere, std::size_t patch, const glm::dvec2& half_extent_m,
                     double texel_m)
    : patch_from_window_(ldi::patch_from_window(hemisphere, patch, half_extent_m)),
      clip_(eyes_of(hemisphere, patch), half_extent_m), margin_m_(4.0 * texel_m),
      radius_m_(hemisphere.radius_m()), axis_(hemisphere.middle_of(patch)),
      cone_cos_(std::cos(hemisphere.directions_of(patch).cone_rad)),
      cone_sin_(std::sin(hemisphere.directions_of(patch).cone_rad)) {}

unsigned PatchView::sides_seen(const glm::dvec3& normal, const glm::dvec3& corner) const {
    // The eyes lie in a cone around the axis, at about the radius from the window.
    const double cosine = glm::dot(normal, axis_);
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double middle = cosine * cone_cos_;
    const double highest = cosine > cone_cos_ ? 1.0 : middle + sine * cone_sin_;
    const double lowest = -cosine > cone_cos_ ? -1.0 : middle - sine * cone_sin_;
    const double at = glm::dot(normal, corner);
    const double nearer = 1.0 - distance_share;
    const double farther = 1.0 + distance_share;
    const double max_above = radius_m_ * std::max(highest * nearer, highest * farther) - at;
    const double min_above = radius_m_ * std::min(lowest * nearer, lowest * farther) - at;
    return (max_above > 0.0 ? 1U : 0U) | (min_above < 0.0 ? 2U : 0U);
}

FacingTriangle PatchView::facing(const TriangleWorld& world, std::uint32_t triangle) const {
    FacingTriangle facing{triangle, 0, 0};
    const std::array<glm::dvec3, 3> corners = corners_of(world, triangle);
    if ((clip_.beyond(corners[0], margin_m_) & clip_.beyond(corners[1], margin_m_) &
         clip_.beyond(corners[2], margin_m_)) != 0) {
        return facing;
    }
    const glm::dvec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double length = glm::length(cross);
    if (!(length > 0.0) || !std::isfinite(length)) {
        return facing;
    }
    const glm::dvec3 normal = cross / length;
    const unsigned sides = sides_seen(normal, corners[0]) & (world.one_sided ? 1U : 3U);
    const glm::dvec3 in_patch = glm::normalize(glm::inverse(glm::transpose(patch_from_window_)) * normal);
    if ((sides & 1U) != 0) {
        add_directions(facing, in_patch);
    }
    if ((sides & 2U) != 0) {
        add_directions(facing, -in_patch);
    }
    return facing;
}

void PatchView::widen(const TriangleWorld& world, std::uint32_t triangle, glm::dvec3& low,
                      glm::dvec3& high) const {
    const std::array<glm::dvec3, 3> corners = corners_of(world, triangle);
    glm::dvec3 own_low = patch_from_window_ * corners[0];
    glm::dvec3 own_high = own_low;
    glm::dvec3 seen_low = corners[0];
    glm::dvec3 seen_high = corners[0];
    unsigned beyond = 0;
    for (const glm::dvec3& corner : corners) {
        own_low = glm::min(own_low, patch_from_window_ * corner);
        own_high = glm::max(own_high, patch_from_window_ * corner);
        seen_low = glm::min(seen_low, corner);
        seen_high = glm::max(seen_high, corner);
        beyond |= clip_.beyond(corner, margin_m_);
    }
    if (beyond != 0) { // only the part that the window shows
        seen_high.z = std::min(seen_high.z, clip_.max_z());
        seen_low.z = std::min(seen_low.z, seen_high.z);
        glm::dvec4 around = clip_.rectangle(seen_low.z);
        for (const double z : {seen_high.z, std::clamp(0.0, seen_low.z, seen_high.z)}) {
            const glm::dvec4 at = clip_.rectangle(z);
            around = {std::min(around.x, at.x), std::min(around.y, at.y), std::max(around.z, at.z),
                      std::max(around.w, at.w)};
        }
        for (int axis = 0; axis < 2; ++axis) {
            seen_low[axis] = std::max(seen_low[axis], around[axis] - margin_m_);
            seen_high[axis] =
                std::max(seen_low[axis], std::min(seen_high[axis], around[axis + 2] + margin_m_));
        }
        glm::dvec3 part_low(std::numeric_limits<double>::infinity());
        glm::dvec3 part_high = -part_low;
        for (unsigned k = 0; k < 8; ++k) {
            const glm::dvec3 at = patch_from_window_ * glm::dvec3((k & 1U) != 0 ? seen_high.x : seen_low.x,
                                                                  (k & 2U) != 0 ? seen_high.y : seen_low.y,
                                                                  (k & 4U) != 0 ? seen_high.z : seen_low.z);
            part_low = glm::min(part_low, at);
            part_high = glm::max(part_high, at);
        }
        own_low = glm::max(own_low, part_low);
        own_high = glm::max(own_low, glm::min(own_high, part_high));
    }
    low = glm::min(low, own_low);
    high = glm::max(high, own_high);
}

} // namespace frustumscreen::ldi

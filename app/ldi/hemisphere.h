/// The hemisphere of eyes before a window: nine patches of equal area, and the 29 cameras that see for them.
///
/// Frames   window (triangle_world.h).
/// Units    metres, radians. Polar angles are from the window's normal, azimuths counter-clockwise from x.
/// Errors   none: an eye beyond the cap, behind the window or not finite has no patch. A radius or cap out of its range
///          asserts.
/// Threads  immutable; any.
/// Source   the multi-LDI report, 5.4. It says that the patches cover 2/3 of the hemisphere 'corresponding to an angle of
///          120 degrees'. The two exclude each other: a cap of 120 degrees has half of the area, and 2/3 need 141. Here the
///          angle holds, and is a parameter (`two_thirds_cap_rad`). Where the cameras stand in their patches is only drawn
///          there; here they are where each direction of the cap is near one (`CameraShares`).
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>

namespace frustumscreen::ldi {

inline constexpr std::size_t patch_count = 9; ///< 0 is the centre; 1 to 8 the ring, counter-clockwise from x
inline constexpr std::size_t camera_count =
    29; ///< 0 to 4 are the centre's; ring patch k has the three from 3 k + 2 on
inline constexpr double default_cap_rad = std::numbers::pi / 1.5; ///< 120 degrees
inline constexpr double two_thirds_cap_rad = 2.4619188346815495;  ///< 2 acos(1/3): 2/3 of the area
inline constexpr double max_cap_rad =
    175.0 / 180.0 * std::numbers::pi; ///< beyond, a ring patch's cameras graze the window

/// Where cameras stand: the share of their patch's area that is nearer to the axis. With these no direction of a cap of 120
/// degrees is farther than 14.2 degrees from a camera, the least of a search in steps of 1/100 (1/20 for the centre).
struct CameraShares {
    double centre = 0.25; ///< of the four that are not on the axis
    double inner = 0.18;  ///< of a ring patch's camera in the middle of its azimuths
    double outer = 0.66;  ///< of its two others, a quarter of its width from its sides
};

/// The directions of a patch: polar angles between two, azimuths at most `half_width_rad` from the middle one.
struct PatchDirections {
    double min_polar_rad = 0.0, max_polar_rad = 0.0;
    double middle_azimuth_rad = 0.0, half_width_rad = 0.0;
    glm::dvec3 axis{0.0, 0.0, 1.0}; ///< unit; of the cone that holds all of them
    double cone_rad = 0.0;          ///< from that axis to the cone's side, rounded up
};

/// Through the window's middle; `right`, `up` and `normal` are orthonormal.
struct ImagePlane {
    glm::dvec3 right{1.0, 0.0, 0.0}, up{0.0, 1.0, 0.0}, normal{0.0, 0.0, 1.0};
};

class Hemisphere {
public:
    /// `radius_m`: the distance of the eye from the window's middle when the window is frozen, above 0.
    /// `cap_rad`: the cone's whole opening, above 0, at most `max_cap_rad`.
    explicit Hemisphere(double radius_m, double cap_rad = default_cap_rad, const CameraShares& shares = {});

    [[nodiscard]] double radius_m() const { return radius_m_; }
    [[nodiscard]] double cap_rad() const { return cap_rad_; }

    /// The patch of an eye, by its direction alone. On a border it is one of the two patches, always the same.
    [[nodiscard]] std::optional<std::size_t> patch_of(const glm::dvec3& eye) const;
    [[nodiscard]] const PatchDirections& directions_of(std::size_t patch) const { return directions_[patch]; }
    /// The unit direction in the middle of a patch's azimuths that halves its area.
    [[nodiscard]] glm::dvec3 middle_of(std::size_t patch) const { return directions_[patch].axis; }
    /// Parallel to the plane of the patch's own cameras; the centre's is the window's. `right` lies in the plane of the
    /// window's x and the normal.
    [[nodiscard]] ImagePlane image_plane_of(std::size_t patch) const;
    /// The patches that have a border with it.
    [[nodiscard]] std::span<const std::size_t> neighbours_of(std::size_t patch) const;

    /// Positions of all cameras, on the sphere.
    [[nodiscard]] const std::array<glm::dvec3, camera_count>& cameras() const { return cameras_; }
    /// Numbers of the cameras that stand in the patch: five, or three.
    [[nodiscard]] std::span<const std::size_t> own_cameras_of(std::size_t patch) const;
    /// Numbers of the cameras that see for the patch: its own, then of each neighbour the one that is nearest to their
    /// border, so that both sides of a border know what is seen from there. The centre has 13, a ring patch 6.
    [[nodiscard]] std::span<const std::size_t> cameras_of(std::size_t patch) const;

private:
    double radius_m_;
    double cap_rad_;
    double cap_cos_;    ///< of the cap's polar angle
    double centre_cos_; ///< of the border between centre and ring
    std::array<PatchDirections, patch_count> directions_;
    std::array<glm::dvec3, camera_count> cameras_{};
};

} // namespace frustumscreen::ldi

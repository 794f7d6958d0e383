/// Which part of a site (terrain and buildings) the prop shows, and how large: a similarity without a turn.
///
/// Frame    box: of the whole site as the prop shows it in miniature (pack.h); the site's places and the places where they appear
///          are both in it.
/// Way      from one view to another the zoom is an exponential function of the share of the way, so that it grows by the same
///          factor in each moment. Every place of the site moves along a straight line, and never back.
/// Threads  pure; any.
/// Errors   none; numbers that are not finite give such views.
#pragma once

#include <glm/glm.hpp>

#include <optional>
#include <span>

namespace frustumscreen::world {

inline constexpr double max_zoom = 1000.0;

/// A place X of the site appears at zoom X + offset.
struct SiteView {
    double zoom = 1.0; ///< 1: the miniature
    glm::dvec3 offset{0.0};

    [[nodiscard]] glm::dvec3 point(const glm::dvec3& of_site) const { return zoom * of_site + offset; }
    /// The place of the site that appears there.
    [[nodiscard]] glm::dvec3 place_at(const glm::dvec3& point) const { return (point - offset) / zoom; }
    [[nodiscard]] glm::dmat4 matrix() const;
    [[nodiscard]] bool operator==(const SiteView&) const = default;
};

/// The view with `place` in the middle of the prop's ground, enlarged `zoom` times.
[[nodiscard]] SiteView view_of(const glm::dvec3& place, double zoom);

/// `share` of the way, 0..1.
[[nodiscard]] SiteView between(const SiteView& from, const SiteView& to, double share);

/// A region's box, box frame.
struct RegionBox {
    glm::dvec3 low{0.0}, high{0.0};
};
/// The middle of its ground.
[[nodiscard]] glm::dvec3 ground_of(const RegionBox& region);
/// The region whose ground holds the place; of several, the one whose middle is nearest; nothing: none holds it.
[[nodiscard]] std::optional<std::size_t> region_at(std::span<const RegionBox> regions,
                                                   const glm::dvec2& place);
/// The region in whose box the ray has its longest section, the one on which it lands. `from` and `along`: box frame. Nothing: the
/// ray misses all.
[[nodiscard]] std::optional<std::size_t> region_on_ray(std::span<const RegionBox> regions,
                                                       const glm::dvec3& from, const glm::dvec3& along);

} // namespace frustumscreen::world

/// Takes visitors into a part of a site and back: which region is marked on the miniature, and what the prop shows meanwhile.
///
/// Marked   the region that a held torch's light falls on; without a torch, the region behind the prop's middle, seen from the eye.
///          The mark moves to another region after `dwell` there (debounce).
/// Way      a press goes to the marked region, another one back to the miniature. For `fades` nothing moves, while the picture fades from
///          the whole to its regions. Then the view goes from one to the other within `seconds_per_octave` for each doubling
///          of the size; a press on the way turns back from there. No place of the site jumps.
/// Ends     when the visitor has gone, the view moves back to the miniature; when the artifact changes or is hidden, it jumps back.
///
/// Frames   prop P, metres; box: site_view.h.
/// Time     `now` never goes back.
/// Threads  values; one caller. `step` allocates nothing.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"
#include "app/world/site_view.h"
#include "firmware_host/base/time.h"

#include <glm/glm.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::exhibit {

/// A site in the configured prop. Without regions the artifact is no site.
struct SiteGround {
    std::vector<world::RegionBox> regions; ///< box frame
    std::vector<world::SiteView> views;    ///< of each region, when it fills the prop
    double metres_per_box = 1.0;           ///< of the miniature
    glm::dvec3 box_size{1.0};
};
/// The whole region stands inside the prop, as large as it fits.
[[nodiscard]] SiteGround site_ground(std::vector<world::RegionBox> regions, const glm::dvec3& box_size,
                                     double metres_per_box, const geometry::PropShape& prop);

struct PresentedSite {
    std::optional<world::SiteView> view; ///< none: the miniature, whole
    std::optional<std::size_t> marked;   ///< on the miniature: the region that a press goes to
    std::optional<std::size_t> region;   ///< that the view shows, or goes to or comes from
    double share = 0.0;                  ///< of the way into the region, 0..1
};

/// The longer side of a map's place on the table; the map is turned as the prop is.
inline constexpr double site_map_m = 0.08;

/// A map of the site beside the prop, and the part of it that stands within the prop.
struct SiteMap {
    using Corners = std::array<glm::dvec2, 4>; ///< table frame, counter-clockwise seen from above
    Corners ground{}, shown{};
};
/// `half_prop_m`: of the prop's base. The map is turned as the prop, about the middle of its place.
[[nodiscard]] SiteMap site_map(const SiteGround& site, const world::SiteView& view,
                               const glm::dvec2& middle_m, const geometry::RigidTransform& table_from_prop,
                               const glm::dvec2& half_prop_m);

class SiteTravel {
public:
    static constexpr Nanoseconds dwell = std::chrono::milliseconds(200);
    static constexpr Nanoseconds fades = std::chrono::milliseconds(400);
    static constexpr double seconds_per_octave = 0.9, min_seconds = 1.5;

    /// A ray, prop frame.
    struct Ray {
        glm::dvec3 from{0.0}, along{0.0};
    };
    struct Input {
        const SiteGround* site = nullptr; ///< of the artifact on show; null: it is none
        std::size_t artifact = 0;
        bool shown = true;     ///< it is shown and ready
        bool attracts = false; ///< no visitor is there
        bool pressed = false;  ///< the button
        Ray towards;           ///< of the torch, or from the eye to the prop's middle
    };
    [[nodiscard]] PresentedSite step(MonotonicTime now, const Input& input);

    /// True if the prop shows a part of the site, or is on the way.
    [[nodiscard]] bool is_away() const { return began_.has_value(); }
    /// True while the view changes without input.
    [[nodiscard]] bool changing() const { return changing_; }

private:
    void follow_mark(MonotonicTime now, const Input& input);
    void press(MonotonicTime now, const Input& input);
    [[nodiscard]] double share_at(MonotonicTime now) const;
    void turn(MonotonicTime now, bool into);

    std::size_t artifact_ = 0;
    std::optional<std::size_t> marked_, coming_; ///< `coming_`: pointed at since `coming_since_`
    MonotonicTime coming_since_;
    std::size_t region_ = 0;
    std::optional<MonotonicTime> began_; ///< when the view left the miniature; none: it shows the miniature
    MonotonicTime turned_;               ///< when `from_` held
    double from_ = 0.0;                  ///< share of the way when it last turned
    bool into_ = false;
    double seconds_ = 0.0; ///< of the whole way
    bool changing_ = false;
};

} // namespace frustumscreen::exhibit

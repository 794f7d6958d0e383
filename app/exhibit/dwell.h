/// Chooses a picture on the table by the prop resting on it: a ring fills, and then the picture is chosen.
///
/// The ring fills while the prop's middle stays over one picture and close to where it was when the ring began. A
/// trembling hand counts as resting; a hand that sweeps over the picture does not, however slowly. When the prop
/// moves on, the ring empties and nothing is chosen. After a choice, nothing is chosen until the prop has left that
/// picture.
///
/// Frames   table T, metres.
/// Time     `now` never goes back; the rhythm of frames does not matter, but a gap of half a second restarts the
///          dwell.
/// Threads  values; one caller. Allocates nothing.
/// Errors   none: a prop that is lifted, or whose pose is unknown, rests on no picture.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"
#include "app/typography/captions.h"
#include "firmware_host/base/time.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace frustumscreen::exhibit {

/// The place of the prop's middle while the prop stands or lies on the table; nothing while it is lifted.
[[nodiscard]] std::optional<glm::dvec2> standing_place(const geometry::PropShape& prop,
                                                       const geometry::RigidTransform& table_from_prop);

struct DwellState {
    std::optional<std::size_t> place;  ///< the picture with the ring
    double full = 0.0;                 ///< share of the ring: 0..1
    std::optional<std::size_t> chosen; ///< set in one step only
};

class Dwell {
public:
    static constexpr Nanoseconds settles =
        std::chrono::milliseconds(200); ///< resting time before the ring appears
    static constexpr Nanoseconds fills = std::chrono::milliseconds(1500);
    static constexpr Nanoseconds empties = settles; ///< from full; gone before the next ring appears
    /// Largest distance from the prop's place at the beginning of the dwell, and from its place when the ring began.
    /// A trembling hand stays within it; a prop that moves at 8 mm/s or more does not.
    static constexpr double resting_m = 0.012;
    static constexpr double leaving_m = 0.006; ///< this far outside the picture, the prop has left it
    static constexpr Nanoseconds longest_gap = std::chrono::milliseconds(500);

    /// `at_m`: standing_place; nothing while the prop's pose is unknown. `pictures` do not overlap. `at_once`: a ring
    /// that has begun counts as full.
    [[nodiscard]] DwellState update(MonotonicTime now, const std::optional<glm::dvec2>& at_m,
                                    std::span<const typography::TableRectangle> pictures,
                                    bool at_once = false);
    /// True if the prop is still on the picture chosen last.
    [[nodiscard]] bool is_on_chosen() const { return chosen_.has_value(); }
    /// Call when the pictures on the table have changed: the one under the prop is not chosen until the prop has left
    /// it.
    void pictures_changed(std::span<const typography::TableRectangle> pictures);

private:
    void stop(MonotonicTime now);
    [[nodiscard]] DwellState ring(MonotonicTime now) const;

    struct Ring {
        std::size_t place = 0;
        MonotonicTime since;
        glm::dvec2 anchor_m{0.0}; ///< the prop keeps close to this
        bool settled = false;     ///< the ring fills
        [[nodiscard]] double full(MonotonicTime now) const;
    };
    struct Left {
        std::size_t place = 0;
        MonotonicTime at;
        double full = 0.0;
    };

    std::optional<MonotonicTime> last_; ///< when the prop was last seen on the table
    glm::dvec2 last_m_{0.0};            ///< and where
    std::optional<Ring> filling_;
    std::optional<Left> left_;                         ///< the ring that empties
    std::optional<typography::TableRectangle> chosen_; ///< until the prop has left it
};

} // namespace frustumscreen::exhibit

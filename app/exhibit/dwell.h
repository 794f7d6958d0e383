/// Choosing a picture on the table by sliding the prop onto it and resting there: a ring fills, and then it is chosen.
///
/// The ring fills while the prop's middle stays over one picture and the prop rests: it keeps close to where it was when the
/// ring began. A hand that trembles rests; one that sweeps over does not, however slowly. When the prop goes on, the ring
/// empties and nothing was chosen. After a choice nothing is chosen before the prop has left that picture.
///
/// Frames   table T, metres.
/// Time     `now` never goes back; the rhythm of frames does not matter, but a gap of half a second begins anew.
/// Threads  values; one caller. Allocates nothing.
/// Errors   none: a prop that is lifted or not known rests nowhere.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"
#include "app/typography/captions.h"
#include "firmware_host/base/time.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace frustumscreen {

/// Where the prop's middle is while the prop stands or lies on the table; nothing while it is lifted.
[[nodiscard]] std::optional<glm::dvec2> standing_place(const PropShape& prop,
                                                       const RigidTransform& table_from_prop);

struct DwellState {
    std::optional<std::size_t> place;  ///< the picture with the ring
    double full = 0.0;                 ///< share of the ring: 0..1
    std::optional<std::size_t> chosen; ///< in one step only
};

class Dwell {
public:
    static constexpr Nanoseconds settles =
        std::chrono::milliseconds(200); ///< it rests so long before there is a ring
    static constexpr Nanoseconds fills = std::chrono::milliseconds(1500);
    static constexpr Nanoseconds empties = settles; ///< a full ring: it is gone when the next one begins
    /// From where the prop was when it came to rest, and when the ring began: a hand trembles by less, and a prop that moves
    /// by 8 mm a second or more goes farther.
    static constexpr double resting_m = 0.012;
    static constexpr double leaving_m = 0.006; ///< so far outside the picture, the prop has left it
    static constexpr Nanoseconds longest_gap = std::chrono::milliseconds(500);

    /// `at_m`: standing_place; nothing while the prop's pose is not known. `pictures` do not overlap. `at_once`: a ring that
    /// has begun counts as full.
    [[nodiscard]] DwellState update(MonotonicTime now, const std::optional<glm::dvec2>& at_m,
                                    std::span<const TableRectangle> pictures, bool at_once = false);
    /// Whether the prop is still on what was chosen last.
    [[nodiscard]] bool is_on_chosen() const { return chosen_.has_value(); }
    /// Other pictures lie there now: the one that the prop is on is not chosen before the prop has left it.
    void pictures_changed(std::span<const TableRectangle> pictures);

private:
    void stop(MonotonicTime now);
    [[nodiscard]] DwellState ring(MonotonicTime now) const;

    struct Rest {
        std::size_t place = 0;
        MonotonicTime since;
        glm::dvec2 anchor_m{0.0}; ///< it keeps close to this
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
    std::optional<Rest> rest_;
    std::optional<Left> left_;             ///< its ring empties
    std::optional<TableRectangle> chosen_; ///< not left yet
};

} // namespace frustumscreen

/// A frame of light on the table around the zone: the places where the prop is lit evenly.
///
/// It brightens smoothly as the prop nears the border of its zone, or is lifted or tilted. It stays while the prop is
/// outside, to show the way back. It is a function of the pose alone, so nothing can flicker.
///
/// Frames   table T, metres.
/// Threads  values; any. Allocates nothing.
#pragma once

#include "app/geometry/transform.h"
#include "app/settings/lit_zone.h"
#include "app/typography/captions.h"

#include <array>

namespace frustumscreen::exhibit {

inline constexpr double zone_line_m = 0.003;
/// Brightness of the frame relative to a caption's.
inline constexpr double zone_brightness = 0.5;

class ZoneFrame {
public:
    /// `axis`: the zone of the prop's axis; `half_bottom_m`: half the side of the prop's bottom. `table`: width,
    /// depth; the frame never extends past its edges. An empty zone has no frame.
    ZoneFrame(const settings::Rectangle& axis, double half_bottom_m, const glm::dvec2& table_m);
    ZoneFrame() = default;

    /// The frame's brightness, 0..1.
    [[nodiscard]] double share(const geometry::RigidTransform& table_from_prop) const;
    /// The frame's four sides.
    [[nodiscard]] const std::array<typography::TableRectangle, 4>& sides() const { return sides_; }

private:
    settings::Rectangle axis_;
    bool shown_ = false;
    std::array<typography::TableRectangle, 4> sides_{};
};

} // namespace frustumscreen::exhibit

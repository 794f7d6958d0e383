/// The artifact's pose while the prop's pose is unknown. The artifact keeps the last pose for a while, then fades,
/// and turns slowly at the idle place until the pose is known again. A prop that is put there shows it too. On a prop in
/// the hand the last pose is dark sooner (hand_fade.h), because a hand carries it on.
///
/// Frames   table T.
/// Time     a closed form of the pose's age and of the time when it became known again: the rhythm of frames does not
///          matter. `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/exhibit/fade.h"
#include "app/exhibit/hand_fade.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"
#include "app/typography/captions.h"

#include <optional>

namespace frustumscreen::exhibit {

struct DrawnPose {
    geometry::RigidTransform table_from_prop; ///< the pose to draw for
    double brightness = 1.0;                  ///< 0..1, a factor on linear light
    bool changing = false;                    ///< brightness changes
    bool attracts = false;                    ///< the pose drawn for is not the prop's own
};

class IdlePose {
public:
    static constexpr Nanoseconds held = std::chrono::seconds(2);            ///< since the last good pose
    static constexpr Nanoseconds each_way = std::chrono::milliseconds(600); ///< fade out, or fade in
    static constexpr Nanoseconds turn = std::chrono::seconds(40);

    /// Turns at `place_m` on the table. `known`: it begins at the prop, otherwise at `place_m`.
    IdlePose(const glm::dvec2& place_m, bool known, MonotonicTime now, bool in_hand = false);

    /// `known`: the prop's pose is good. Otherwise `age` is that of the last good pose; 0 = there was none yet.
    [[nodiscard]] DrawnPose at(MonotonicTime now, bool known, Nanoseconds age,
                               const geometry::RigidTransform& table_from_prop);
    /// True if, as of the latest `at`, the pose has been unknown for a while and the picture leaves it or has left
    /// it.
    [[nodiscard]] bool lost() const;

private:
    glm::dvec2 place_m_;
    Fade fade_;
    std::optional<HandFade> hand_fade_;
    MonotonicTime turns_since_;
};

/// The area that the artifact's place hides from a point. For an artifact that turns at the idle place it is the area
/// of all turns, so nothing next to it moves.
[[nodiscard]] std::optional<typography::TablePolygon>
area_hidden_by(const geometry::PropShape& prop, const DrawnPose& drawn, const glm::dvec3& from_m);

} // namespace frustumscreen::exhibit

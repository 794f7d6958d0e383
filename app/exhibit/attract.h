/// Where the artifact is shown while nobody knows where the prop is. It stays where it was for a while, then
/// fades, and turns slowly at a place of its own until the prop is known again. A prop put there shows it
/// too.
///
/// Frames   table T.
/// Time     a closed form of the pose's age and of the time when it came back: the rhythm of frames does not
///          matter. `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/exhibit/fade.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"
#include "app/typography/captions.h"

#include <optional>

namespace frustumscreen {

struct Stand {
    RigidTransform table_from_prop; ///< the pose to draw for
    double brightness = 1.0;        ///< 0..1, a factor on linear light
    bool changing = false;          ///< brightness changes
    bool attracts = false;          ///< the prop's own pose is not what is drawn
};

class Attract {
public:
    static constexpr Nanoseconds held = std::chrono::seconds(2); ///< from the last pose that was good
    static constexpr Nanoseconds each_way = std::chrono::milliseconds(600); ///< of the fade
    static constexpr Nanoseconds turn = std::chrono::seconds(40);

    /// Turns at `place_m`, on the table. `known`: it begins at the prop, else at `place_m`.
    Attract(const glm::dvec2& place_m, bool known, MonotonicTime now);

    /// `known`: the prop's pose is good; else its age counts; 0 = there was no pose yet.
    [[nodiscard]] Stand at(MonotonicTime now, bool known, Nanoseconds age,
                           const RigidTransform& table_from_prop);
    /// As of the latest `at`: nobody has known where the prop is for a while, and the picture leaves it or has left it.
    [[nodiscard]] bool lost() const;

private:
    glm::dvec2 place_m_;
    Fade fade_;
    MonotonicTime turns_since_;
};

/// What the artifact's place hides from a point. An artifact that turns at a place of its own hides the same at any angle, so
/// that nothing beside it moves.
[[nodiscard]] std::optional<TablePolygon> stand_hides(const PropShape& prop, const Stand& stand,
                                                      const glm::dvec3& from_m);

} // namespace frustumscreen

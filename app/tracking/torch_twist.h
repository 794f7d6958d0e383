/// The opening of a torch's light, set by a twist of the torch about its own axis: right makes it wider, left narrower.
///
/// Twist    relative to where it was taken: the rotation since then, less the shortest one that turns its axis. It is a
///          function of the pose, so that pointing about, however long, adds nothing to it.
/// Dead     a hand that points twists a little: the opening follows beyond `dead_rad` only, and at once when the hand
///          turns on, from its bounds too.
/// Scale    the opening doubles with every `doubles_rad`.
/// Threads  values; one caller. Allocates nothing.
/// Source   the split of a rotation into swing and twist: Dobrowolski, Swing-twist decomposition in Clifford algebra,
///          2015.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <numbers>

namespace frustumscreen::tracking {

struct TwistBounds {
    double usual_rad = 0.0; ///< between the other two
    double min_rad = 0.0, max_rad = 0.0;
};

class TorchTwist {
public:
    static constexpr double dead_rad = std::numbers::pi / 12.0;
    static constexpr double doubles_rad = std::numbers::pi / 4.0;

    explicit TorchTwist(const TwistBounds& bounds) : bounds_(bounds), opening_rad_(bounds.usual_rad) {}

    /// The torch is taken: its opening is the usual one.
    void begin(const glm::dquat& table_from_torch);
    /// Follows its rotation; returns the opening.
    double follow(const glm::dquat& table_from_torch);
    [[nodiscard]] double opening_rad() const { return opening_rad_; }

private:
    TwistBounds bounds_;
    glm::dquat reference_{1.0, 0.0, 0.0, 0.0};
    double before_rad_ = 0.0; ///< twist up to `reference_`
    double twist_rad_ = 0.0;
    double counted_rad_ = 0.0;  ///< of the twist, without the dead band
    double usual_at_rad_ = 0.0; ///< `counted_rad_` at which the opening is the usual one
    double opening_rad_;
};

} // namespace frustumscreen::tracking

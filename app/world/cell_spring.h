/// A cell on a damped spring, or one that hangs and swings: how far it is from its rest.
///
/// Its motion is kept as it was at the last event (a start, a push, an end) and solved from there to any later time, so
/// it does not depend on the steps between. An event changes the pull or adds speed; where the cell is does not jump.
/// Off     it continues by its own law, with a damping ratio of at least `min_damping_ratio`, so that it comes to
///         rest.
/// Still   once its energy is below that of a swing of `still`; it then counts as at rest, and stays so.
///
/// Units    radians or a length in the cell's frame; seconds.
/// Threads  values; one caller. Nothing allocates.
#pragma once

#include "app/world/behaviour.h"
#include "app/world/spring.h"
#include "firmware_host/base/time.h"

#include <glm/glm.hpp>

#include <cstddef>

namespace frustumscreen::world {

inline constexpr double gravity_m_s2 = 9.80665;
inline constexpr double min_damping_ratio = 0.01; ///< of 1, critical; while off

class CellSpring {
public:
    CellSpring(const Spring& spring, double still);
    CellSpring(const Pendulum& pendulum, double still);

    /// Pulls a spring, pushes a pendulum.
    void start(MonotonicTime now);
    /// Pushes a pendulum again; nothing for a spring.
    void push(MonotonicTime now);
    void end(MonotonicTime now);

    /// The exact motion, x from the rest.
    [[nodiscard]] Motion motion(MonotonicTime now) const;
    [[nodiscard]] bool at_rest(MonotonicTime now) const;
    /// The motion's addition to the cell's pose: base_from_cell = rest * this. The identity at rest.
    [[nodiscard]] glm::dmat4 matrix(MonotonicTime now) const;
    [[nodiscard]] std::size_t cell() const { return cell_; }

private:
    /// `from_target_` at `now`, which becomes the last event.
    void keep(MonotonicTime now);
    [[nodiscard]] Motion from_target(MonotonicTime now) const;

    std::size_t cell_;
    bool turns_;
    glm::dvec3 axis_;
    SpringLaw law_on_, law_off_;
    double reach_;      ///< 0: a pendulum
    double push_per_s_; ///< 0: a spring
    double still_;
    SpringLaw law_; ///< since the last event, as the next three
    double target_ = 0.0;
    Motion from_target_; ///< at the last event; x from the target
    MonotonicTime event_;
};

} // namespace frustumscreen::world

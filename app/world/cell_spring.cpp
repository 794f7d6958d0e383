#include "app/world/cell_spring.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace frustumscreen::world {

namespace {

SpringLaw braked(const SpringLaw& law) {
    return {law.stiffness_per_s2,
            std::fmax(law.damping_per_s, 2.0 * min_damping_ratio * std::sqrt(law.stiffness_per_s2))};
}

SpringLaw law_of(const Spring& spring) {
    return {spring.stiffness_per_s2, spring.damping_per_s};
}
SpringLaw law_of(const Pendulum& pendulum) {
    return {gravity_m_s2 / pendulum.length_m, pendulum.damping_per_s};
}

} // namespace

CellSpring::CellSpring(const Spring& spring, double still)
    : cell_(spring.cell), turns_(spring.turns), axis_(spring.axis), law_on_(law_of(spring)),
      law_off_(braked(law_on_)), reach_(spring.reach), push_per_s_(0.0), still_(still), law_(law_off_) {}

CellSpring::CellSpring(const Pendulum& pendulum, double still)
    : cell_(pendulum.cell), turns_(true), axis_(pendulum.axis), law_on_(law_of(pendulum)),
      law_off_(braked(law_on_)), reach_(0.0), push_per_s_(speed_to_reach(law_on_, pendulum.angle_rad)),
      still_(still), law_(law_off_) {}

Motion CellSpring::from_target(MonotonicTime now) const {
    return motion_after(law_, from_target_, to_seconds(now - event_));
}

void CellSpring::keep(MonotonicTime now) {
    from_target_ = from_target(now);
    event_ = now;
}

void CellSpring::start(MonotonicTime now) {
    keep(now);
    law_ = law_on_;
    from_target_.x += target_ - reach_;
    target_ = reach_;
    push(now);
}

/// The push gives the energy that a push at rest gives, so pushes at any rhythm do not add up.
void CellSpring::push(MonotonicTime now) {
    if (push_per_s_ == 0.0) {
        return;
    }
    keep(now);
    const double speed = from_target_.x * std::sqrt(law_.stiffness_per_s2);
    const double square = push_per_s_ * push_per_s_ - speed * speed;
    if (square > from_target_.v * from_target_.v) {
        from_target_.v = std::copysign(std::sqrt(square), push_per_s_);
    }
}

void CellSpring::end(MonotonicTime now) {
    keep(now);
    law_ = law_off_;
    from_target_.x += target_;
    target_ = 0.0;
}

Motion CellSpring::motion(MonotonicTime now) const {
    const Motion from = from_target(now);
    return {from.x + target_, from.v};
}

bool CellSpring::at_rest(MonotonicTime now) const {
    return target_ == 0.0 && swing_of(law_, from_target(now)) <= still_;
}

glm::dmat4 CellSpring::matrix(MonotonicTime now) const {
    if (at_rest(now)) {
        return glm::dmat4(1.0);
    }
    const double x = motion(now).x;
    return turns_ ? glm::rotate(glm::dmat4(1.0), x, axis_) : glm::translate(glm::dmat4(1.0), x * axis_);
}

} // namespace frustumscreen::world

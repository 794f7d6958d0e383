#include "app/world/moving_part.h"

#include "app/geometry/time_curves.h"
#include "app/world/curve.h"
#include "app/world/run_time.h"

#include <cmath>

namespace frustumscreen::world {

namespace {

/// Equal to what a curve's floats resolve.
bool is_near(Path path, const glm::dvec4& a, const glm::dvec4& b) {
    constexpr double digits = 1e-6;
    const glm::dvec4 other = path == Path::Rotation && glm::dot(a, b) < 0.0 ? -b : b;
    return glm::length(a - other) <= digits * glm::length(b);
}

} // namespace

void MovingPart::follow(const std::optional<Driver>& driver, MonotonicTime now) {
    from_ = at(now);
    const bool rested = at_rest(now);
    driver_ = driver;
    changed_ = now;
    blends_ = !rested && !is_near(path_, from_, target(now));
}

glm::dvec4 MovingPart::target(MonotonicTime now) const {
    if (!driver_) {
        return rest_;
    }
    return value_at(driver_->channel->curve, path_, curve_seconds(*driver_->behaviour, now - driver_->began));
}

glm::dvec4 MovingPart::at(MonotonicTime now) const {
    const double way = geometry::ramp(to_seconds(now - changed_), return_s);
    return blends_ && way < 1.0 ? blend(path_, from_, target(now), geometry::ease(way)) : target(now);
}

bool MovingPart::at_rest(MonotonicTime now) const {
    return !driver_ && !(blends_ && to_seconds(now - changed_) < return_s);
}

} // namespace frustumscreen::world

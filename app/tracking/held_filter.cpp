#include "app/tracking/held_filter.h"

#include "app/tracking/pose_math.h"

namespace frustumscreen::tracking {

HeldFilter::HeldFilter(const PoseNoise& noise, double lever_m)
    : table_(exhibit_filter(noise)), hand_(hand_filter(noise)), meter_(noise, lever_m) {}

void HeldFilter::restart(const geometry::RigidTransform& measured) {
    table_.restart(measured);
    hand_.restart(measured);
    meter_.restart(measured);
}

void HeldFilter::take(const geometry::RigidTransform& measured, double dt_s) {
    table_.take(measured, dt_s);
    hand_.take(measured, dt_s);
    meter_.take(measured, dt_s);
}

geometry::RigidTransform HeldFilter::ahead(double ahead_s) const {
    const double share = held();
    if (share <= 0.0) {
        return table_.ahead(ahead_s);
    }
    return share >= 1.0 ? hand_.ahead(ahead_s) : between(table_.ahead(ahead_s), hand_.ahead(ahead_s), share);
}

PoseSpread HeldFilter::spread(double ahead_s) const {
    const double share = held();
    const PoseSpread table = table_.spread(ahead_s);
    if (share <= 0.0) {
        return table;
    }
    const PoseSpread hand = hand_.spread(ahead_s);
    return {.place_m = glm::mix(table.place_m, hand.place_m, share),
            .turn_rad = glm::mix(table.turn_rad, hand.turn_rad, share)};
}

} // namespace frustumscreen::tracking

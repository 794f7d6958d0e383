#include "app/exhibit/window_lens.h"

#include "app/geometry/time_curves.h"
#include "app/typography/visitor_side.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::exhibit {

namespace {

double turn_between_deg(const geometry::RigidTransform& a, const geometry::RigidTransform& b) {
    const double cosine = std::min(1.0, std::abs(glm::dot(a.rotation, b.rotation)));
    return 2.0 * std::acos(cosine) * 180.0 / std::numbers::pi;
}

} // namespace

double WindowLens::yaw_of(const geometry::RigidTransform& table_from_prop) {
    const glm::dvec3 x = table_from_prop.direction({1.0, 0.0, 0.0});
    return std::atan2(x.y, x.x);
}

void WindowLens::begin(MonotonicTime now, const View& view, const geometry::RigidTransform& table_from_prop) {
    on_ = true;
    has_moved_ = false;
    first_ = view_ = view;
    begin_m_ = table_from_prop.translation;
    turned_rad_ = 0.0;
    yaw_rad_ = yaw_of(table_from_prop);
    rests_ = table_from_prop;
    last_ = moved_ = now;
}

void WindowLens::step(MonotonicTime now, const geometry::RigidTransform& table_from_prop, int quarter_turns) {
    if (!on_) {
        return;
    }
    const double yaw = yaw_of(table_from_prop);
    turned_rad_ += std::remainder(yaw - yaw_rad_, 2.0 * std::numbers::pi);
    yaw_rad_ = yaw;
    const glm::dvec3 way = table_from_prop.translation - begin_m_;
    const double nearer = -typography::turned(glm::dvec2(way), -quarter_turns).y + way.z;
    const double zoom = std::clamp(first_.zoom * std::exp2(nearer / doubles_m), min_zoom, max_zoom);
    const double share = geometry::follow_share(to_seconds(now - last_), follows_s);
    last_ = now;
    view_.turn_rad += share * (first_.turn_rad + turned_rad_ - view_.turn_rad);
    view_.zoom *= std::pow(zoom / view_.zoom, share);
    if (glm::distance(rests_.translation, table_from_prop.translation) > still_m ||
        turn_between_deg(rests_, table_from_prop) > still_deg) {
        rests_ = table_from_prop;
        moved_ = now;
        has_moved_ = true;
    }
    on_ = now - moved_ < (has_moved_ ? still : waits);
}

} // namespace frustumscreen::exhibit

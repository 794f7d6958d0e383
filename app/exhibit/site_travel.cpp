#include "app/exhibit/site_travel.h"

#include "app/geometry/time_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace frustumscreen::exhibit {

SiteGround site_ground(std::vector<world::RegionBox> regions, const glm::dvec3& box_size,
                       double metres_per_box, const geometry::PropShape& prop) {
    SiteGround ground{
        .regions = std::move(regions), .views = {}, .metres_per_box = metres_per_box, .box_size = box_size};
    for (const world::RegionBox& region : ground.regions) {
        const glm::dvec3 size = region.high - region.low;
        std::array<glm::dvec3, 8> corners{};
        for (unsigned k = 0; k < corners.size(); ++k) {
            corners[k] = size * glm::dvec3((k & 1U) != 0 ? 0.5 : -0.5, (k & 2U) != 0 ? 0.5 : -0.5,
                                           (k & 4U) != 0 ? 1.0 : 0.0);
        }
        const double zoom = geometry::largest_scale_inside(prop, corners) / metres_per_box;
        ground.views.push_back(
            world::view_of(world::ground_of(region), std::clamp(zoom, 1.0, world::max_zoom)));
    }
    return ground;
}

SiteMap site_map(const SiteGround& site, const world::SiteView& view, const glm::dvec2& middle_m,
                 const geometry::RigidTransform& table_from_prop, const glm::dvec2& half_prop_m) {
    const glm::dvec2 half_ground = 0.5 * glm::dvec2(site.box_size);
    const glm::dvec2 half_shown = half_prop_m / site.metres_per_box;
    const double m_per_box = 0.5 * site_map_m / glm::length(half_ground);
    const glm::dvec2 along(table_from_prop.rotation * glm::dvec3(1.0, 0.0, 0.0));
    const glm::dvec2 x = glm::length(along) > 1e-9 ? glm::normalize(along) : glm::dvec2(1.0, 0.0);
    const auto on_table = [&](const glm::dvec2& place) {
        const glm::dvec2 at = m_per_box * glm::clamp(place, -half_ground, half_ground);
        return middle_m + at.x * x + at.y * glm::dvec2(-x.y, x.x);
    };
    SiteMap map;
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec2 corner(k == 0 || k == 3 ? -1.0 : 1.0, k < 2 ? -1.0 : 1.0);
        map.ground[k] = on_table(corner * half_ground);
        map.shown[k] = on_table(glm::dvec2(view.place_at({corner * half_shown, 0.0})));
    }
    return map;
}

PresentedSite SiteTravel::step(MonotonicTime now, const Input& input) {
    const bool is_site = input.site != nullptr && !input.site->regions.empty();
    if (!is_site || !input.shown || input.artifact != artifact_) {
        *this = {};
        artifact_ = input.artifact;
    }
    changing_ = false;
    if (!is_site || !input.shown) {
        return {};
    }
    follow_mark(now, input);
    if (input.attracts && into_) {
        turn(now, false);
    } else if (input.pressed && !input.attracts) {
        press(now, input);
    }
    PresentedSite presented;
    if (began_) {
        presented.share = share_at(now);
        changing_ = into_ ? presented.share < 1.0 : true;
        if (!into_ && presented.share <= 0.0) {
            began_.reset();
        } else {
            presented.region = region_;
            presented.view = world::between({}, input.site->views[region_], presented.share);
        }
    }
    presented.marked = began_ || input.attracts ? std::nullopt : marked_;
    return presented;
}

void SiteTravel::follow_mark(MonotonicTime now, const Input& input) {
    const SiteGround& site = *input.site;
    const std::optional<std::size_t> pointed = world::region_on_ray(
        site.regions, input.towards.from / site.metres_per_box, input.towards.along / site.metres_per_box);
    if (!pointed || pointed == marked_) {
        coming_.reset();
    } else if (!marked_ || (coming_ == pointed && now - coming_since_ >= dwell)) {
        marked_ = pointed;
        coming_.reset();
    } else if (coming_ != pointed) {
        coming_ = pointed;
        coming_since_ = now;
    }
}

void SiteTravel::press(MonotonicTime now, const Input& input) {
    if (began_) {
        turn(now, !into_);
    } else if (marked_) {
        region_ = *marked_;
        began_ = now;
        turned_ = now + fades;
        from_ = 0.0;
        into_ = true;
        seconds_ = std::fmax(min_seconds, seconds_per_octave * std::log2(input.site->views[region_].zoom));
    }
}

/// Turns back at the present share of the way; the speed starts from 0 again.
void SiteTravel::turn(MonotonicTime now, bool into) {
    from_ = share_at(now);
    turned_ = std::max(now, turned_);
    into_ = into;
}

double SiteTravel::share_at(MonotonicTime now) const {
    const double goal = into_ ? 1.0 : 0.0;
    const double way_s = seconds_ * std::abs(goal - from_);
    const double elapsed_s = std::fmax(0.0, to_seconds(now - turned_));
    const double done = way_s > 0.0 ? geometry::ease(geometry::ramp(elapsed_s, way_s)) : 1.0;
    return from_ + done * (goal - from_);
}

} // namespace frustumscreen::exhibit

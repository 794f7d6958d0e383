#include "app/exhibit/dwell.h"

#include "app/geometry/time_curves.h"
#include "app/typography/visitor_side.h"

#include <algorithm>
#include <limits>

namespace frustumscreen::exhibit {

namespace {

constexpr double lifted_m = 0.02;

bool holds(const typography::TableRectangle& rectangle, const glm::dvec2& at_m, double margin_m) {
    const glm::dvec2 off = glm::abs(typography::turned(at_m - rectangle.centre_m, -rectangle.quarter_turns));
    return glm::all(glm::lessThanEqual(off, 0.5 * rectangle.size_m + margin_m));
}

std::optional<std::size_t> find(std::span<const typography::TableRectangle> pictures,
                                const glm::dvec2& at_m) {
    for (std::size_t k = 0; k < pictures.size(); ++k) {
        if (holds(pictures[k], at_m, 0.0)) {
            return k;
        }
    }
    return std::nullopt;
}

} // namespace

std::optional<glm::dvec2> standing_place(const geometry::PropShape& prop,
                                         const geometry::RigidTransform& table_from_prop) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& corner : prop.corners) {
        lowest = std::min(lowest, table_from_prop.point(corner).z);
    }
    return lowest < lifted_m ? std::optional(glm::dvec2(table_from_prop.point(prop.middle))) : std::nullopt;
}

DwellState Dwell::update(MonotonicTime now, const std::optional<glm::dvec2>& at_m,
                         std::span<const typography::TableRectangle> pictures, bool at_once) {
    const bool followed = at_m && last_ && now - *last_ < longest_gap;
    // On a picture's edge a trembling hand alternates between on and off the picture.
    const bool rests = followed && filling_ && filling_->place < pictures.size() &&
                       holds(pictures[filling_->place], *at_m, leaving_m) &&
                       glm::distance(*at_m, filling_->anchor_m) < resting_m;
    if (!rests) {
        stop(now);
    }
    last_ = at_m ? std::optional(now) : std::nullopt;
    if (!at_m) {
        return ring(now);
    }
    last_m_ = *at_m;
    if (chosen_ && !holds(*chosen_, *at_m, leaving_m)) {
        chosen_.reset();
    }
    if (!filling_ && !chosen_) {
        if (const std::optional<std::size_t> place = find(pictures, *at_m)) {
            filling_ = Ring{.place = *place, .since = now, .anchor_m = *at_m};
        }
    }
    if (filling_ && !filling_->settled && now - filling_->since >= settles) {
        filling_->settled = true;
        filling_->anchor_m = *at_m;
        left_.reset();
    }
    DwellState state = ring(now);
    if (filling_ && (state.full >= 1.0 || (at_once && filling_->settled))) {
        state.chosen = filling_->place;
        chosen_ = pictures[filling_->place];
        filling_.reset();
    }
    return state;
}

void Dwell::pictures_changed(std::span<const typography::TableRectangle> pictures) {
    filling_.reset();
    left_.reset();
    chosen_.reset();
    if (const std::optional<std::size_t> on = last_ ? find(pictures, last_m_) : std::nullopt) {
        chosen_ = pictures[*on];
    }
}

double Dwell::Ring::full(MonotonicTime now) const {
    return settled ? geometry::ramp(to_seconds(now - since - settles), to_seconds(fills)) : 0.0;
}

/// Empties a filling ring from its current share.
void Dwell::stop(MonotonicTime now) {
    if (filling_ && filling_->settled) {
        left_ = Left{filling_->place, now, filling_->full(now)};
    }
    filling_.reset();
}

DwellState Dwell::ring(MonotonicTime now) const {
    if (filling_ && filling_->settled) {
        return {filling_->place, filling_->full(now), std::nullopt};
    }
    const double full = left_ ? left_->full - to_seconds(now - left_->at) / to_seconds(empties) : 0.0;
    return full > 0.0 ? DwellState{left_->place, full, std::nullopt} : DwellState{};
}

} // namespace frustumscreen::exhibit

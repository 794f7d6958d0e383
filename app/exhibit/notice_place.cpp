#include "app/exhibit/notice_place.h"

#include "app/geometry/time_curves.h"
#include "app/typography/visitor_side.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::exhibit {

namespace {

constexpr double beside_caption_m =
    0.015; ///< more than between pictures, so that notice and caption do not read as one text

} // namespace

std::optional<typography::TablePolygon> notice_ring(const PresentedNotice& notice) {
    const NoticeShape& shape = notice.picture->shapes[notice.shape];
    if (!shape.ring_m) {
        return std::nullopt;
    }
    const int quarter_turns = notice.rectangle.quarter_turns;
    const glm::dvec2 middle = notice.rectangle.centre_m + typography::turned(*shape.ring_m, quarter_turns);
    typography::TablePolygon round;
    round.count = round.points.size();
    for (std::size_t k = 0; k < round.count; ++k) {
        const double angle =
            2.0 * std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(round.count);
        round.points.at(k) = middle + notice_ring_radius_m * glm::dvec2(std::cos(angle), std::sin(angle));
    }
    return round;
}

void NoticePlace::look(MonotonicTime now, const NoticeEnvironment& environment) {
    std::array<typography::TableRectangle, typography::CaptionPlacer::max_obstacles> obstacles{};
    std::size_t count = 0;
    const auto add = [&](std::span<const typography::TableRectangle> more) {
        const std::size_t fit = std::min(more.size(), obstacles.size() - count);
        std::copy_n(more.begin(), fit, obstacles.begin() + static_cast<std::ptrdiff_t>(count));
        count += fit;
    };
    if (environment.caption && beside_ != Beside::AllButCaption) {
        typography::TableRectangle caption = *environment.caption;
        caption.size_m += 2.0 * beside_caption_m;
        add(std::span(&caption, 1));
    }
    add(environment.obstacles);
    if (beside_ == Beside::All) {
        add(environment.kept);
    }
    placer_.set_obstacles(std::span(obstacles).first(count));
    placer_.update(now, environment.shadow, environment.hidden, environment.prop_m,
                   environment.quarter_turns);
}

std::optional<PresentedNotice> NoticePlace::step(MonotonicTime now, const SharedNotice& wanted,
                                                 const NoticeEnvironment& environment) {
    const double step = to_seconds(now - last_) / to_seconds(leaves);
    last_ = now;
    const bool stays = placed_ == wanted;
    share_ = std::clamp(share_ + (stays ? step : -step), 0.0, 1.0);
    if (!stays && (share_ <= 0.0 || placer_.at(now).opacity <= 0.0)) {
        placed_ = wanted;
        share_ = 1.0; // the placer fades it in
        beside_ = Beside::All;
        placer_.set_shapes(wanted ? std::span<const glm::dvec2>(wanted->sizes_m)
                                  : std::span<const glm::dvec2>());
    }
    if (!placed_) {
        return std::nullopt;
    }
    look(now, environment);
    const typography::CaptionPlace place = placer_.at(now);
    if (placer_.searched_in_vain()) { // the next search uses other obstacles
        beside_ = beside_ == Beside::All                 ? Beside::AllButEmptyPlaces
                  : beside_ == Beside::AllButEmptyPlaces ? Beside::AllButCaption
                                                         : Beside::All;
    }
    const double brightness = place.opacity * geometry::ease(share_);
    return brightness > 0.0 ? std::optional(PresentedNotice{.picture = placed_,
                                                            .shape = place.shape,
                                                            .rectangle = place.rectangle,
                                                            .brightness = brightness,
                                                            .ring_full = 0.0})
                            : std::nullopt;
}

double left_to_caption(const typography::TableRectangle& caption, const PresentedNotice& notice) {
    const double apart = typography::clearance(caption.corners(), notice.rectangle.corners());
    return apart > 0.0 ? 1.0 : std::max(0.0, 1.0 - 2.0 * notice.brightness);
}

} // namespace frustumscreen::exhibit

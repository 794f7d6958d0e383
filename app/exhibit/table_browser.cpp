#include "app/exhibit/table_browser.h"

#include "app/geometry/time_curves.h"

#include <algorithm>

namespace frustumscreen::exhibit {

TableBrowser::TableBrowser(const TableSetUp& set_up) : left_out_(set_up.artifacts) {
    for (int side = 0; side < 4; ++side) {
        layouts_[static_cast<std::size_t>(side)] = lay_out_table(set_up, side);
    }
}

std::optional<std::size_t> TableBrowser::step(MonotonicTime now, const Input& input) {
    const auto side = static_cast<std::size_t>(input.quarter_turns);
    const bool other_artifact = artifact_ != input.artifact;
    if (other_artifact || side_ != side) {
        turn_to_page_of(input.artifact, side);
    }
    if (!fade_) {
        fade_.emplace(Arrangement{side, page_}.number(), each_way, now);
        last_ = now;
    } else if (fade_->goal() != Arrangement{side, page_}.number()) {
        fade_->change_to(Arrangement{side, page_}.number(), now, now);
    }
    const Faded faded = fade_->at(now);
    if (laid_out_ != faded.which) {
        lay_out(Arrangement::of(faded.which), input.artifact);
        laid_out_ = faded.which;
        choosable_holds_ = false;
    }
    if (other_artifact || !choosable_holds_) {
        note_choosable(input.artifact);
    }
    lighten(now, input, faded);

    const DwellState dwell = dwell_.update(
        now, input.prop_m, std::span(choosable_).first(faded.changing ? 0 : choosable_count_), input.choose);
    chose_ = dwell.chosen.has_value();
    presented_.ring = dwell.place ? std::optional(choosable_places_[*dwell.place]) : std::nullopt;
    presented_.ring_full = dwell.full;
    on_picture_ = is_on_picture(input.prop_m);
    if (!dwell.chosen) {
        return std::nullopt;
    }
    const std::optional<std::size_t> chosen = presented_.places[choosable_places_[*dwell.chosen]].artifact;
    if (!chosen) {
        page_ = (page_ + 1) % layouts_[side].pages();
    }
    return chosen;
}

/// Layouts of different sides may have different numbers of places, and so different pages.
void TableBrowser::turn_to_page_of(std::size_t artifact, std::size_t side) {
    page_ = layouts_[side].page_of(artifact);
    artifact_ = artifact;
    side_ = side;
}

void TableBrowser::lay_out(const Arrangement& arrangement, std::size_t artifact) {
    const TableLayout& layout = layouts_[arrangement.side];
    presented_.count = 0;
    obstacle_count_ = 0;
    for (std::size_t place = 0; place < layout.places.size(); ++place) {
        obstacles_[obstacle_count_++] = layout.places[place].whole();
        const std::optional<std::size_t> here = layout.artifact_at(arrangement.page, place);
        if (here || layout.leads_on(place)) {
            const PlacedPicture picture{here, layout.places[place], 0.0};
            presence_[presented_.count] = empty(picture, artifact) ? 0.0 : 1.0;
            under_sign_[presented_.count] = 0.0;
            signed_at_[presented_.count].reset();
            presented_.places[presented_.count++] = picture;
        }
    }
}

void TableBrowser::lighten(MonotonicTime now, const Input& input, const Faded& faded) {
    const double step = to_seconds(now - last_) / to_seconds(each_way);
    last_ = now;
    presented_.changing = faded.changing;
    for (std::size_t k = 0; k < presented_.count; ++k) {
        PlacedPicture& picture = presented_.places[k];
        const double goal = empty(picture, input.artifact) ? 0.0 : 1.0;
        presence_[k] += std::clamp(goal - presence_[k], -step, step);
        const double signed_goal = is_under_sign(now, input, k) ? 1.0 : 0.0;
        under_sign_[k] += std::clamp(signed_goal - under_sign_[k], -step, step);
        presented_.changing = presented_.changing || presence_[k] != goal || under_sign_[k] != signed_goal;
        picture.brightness = geometry::ease(presence_[k]) * faded.brightness *
                             place_brightness(picture.place, input.shadow) *
                             (1.0 - (1.0 - dimmed) * geometry::ease(under_sign_[k]));
    }
}

/// True if a sign lies on the picture, or did recently: a sign glides to and fro, and the picture stays dim
/// meanwhile.
bool TableBrowser::is_under_sign(MonotonicTime now, const Input& input, std::size_t picture) {
    constexpr Nanoseconds comes_back = std::chrono::seconds(2);
    std::optional<MonotonicTime>& signed_at = signed_at_[picture];
    const typography::TableRectangle whole = presented_.places[picture].place.whole();
    if (input.sign && typography::clearance(whole.corners(), input.sign->corners()) <= 0.0) {
        signed_at = now;
    }
    return input.sign && signed_at && now - *signed_at < comes_back;
}

bool TableBrowser::is_on_picture(const std::optional<glm::dvec2>& prop_m) const {
    const std::span<const typography::TableRectangle> pictures =
        std::span(choosable_).first(choosable_count_);
    return prop_m && !dwell_.is_on_chosen() &&
           std::any_of(pictures.begin(), pictures.end(), [&](const typography::TableRectangle& picture) {
               return typography::clearance(picture.corners(), std::span(&*prop_m, 1)) <= 0.0;
           });
}

/// Lists all places but the empty one. The picture under the prop is not chosen until the prop has left it.
void TableBrowser::note_choosable(std::size_t artifact) {
    choosable_count_ = 0;
    for (std::size_t k = 0; k < presented_.count; ++k) {
        if (!empty(presented_.places[k], artifact)) {
            choosable_[choosable_count_] = presented_.places[k].place.picture;
            choosable_places_[choosable_count_++] = k;
        }
    }
    dwell_.pictures_changed(std::span(choosable_).first(choosable_count_));
    choosable_holds_ = true;
}

} // namespace frustumscreen::exhibit

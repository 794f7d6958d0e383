#include "app/exhibit/window_desk.h"

#include "app/exhibit/table_contact.h"
#include "app/geometry/time_curves.h"
#include "app/typography/visitor_side.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::exhibit {

namespace {

constexpr double border_m = 0.008;      ///< from a new place to the border of the lit part
constexpr double from_shadow_m = 0.020; ///< from a new place to the prop's shadow
constexpr double shadow_dims_m = 0.012; ///< a nearer shadow dims a window; the window is dark at 0
constexpr double thing_dims_m = 0.006;  ///< the same for anything else beside it
constexpr double clears_in_s = 0.25;    ///< the time in which an uncovered window becomes light
constexpr double grid_m = 0.01;
/// Sizes to try, largest first, as shares of the size in the settings.
constexpr std::array size_shares{1.0, 0.8, 0.65};
constexpr double touches = 0.9; ///< a window with less of its light counts as covered
constexpr Nanoseconds between_searches = std::chrono::milliseconds(200);
constexpr int push_rounds = 3; ///< pushes from window to window, in one step

/// Costs in metres of distance from the preferred place.
constexpr double cost_of_being_hidden = 1.0;
constexpr double cost_of_another_row = 3.0;  ///< for each metre, beside a window of the same artifact
constexpr double cost_of_other_height = 1.5; ///< for each metre nearer or farther than the prop
constexpr double cost_of_left = 0.02;        ///< so the first window comes to the right
/// Horizontal by vertical distance from a window to the eye. Up to `usual_slope` the eye sees the window well; `max_slope` is just
/// below the slope at which the window begins to fade (56 degrees, show/window_show.h).
constexpr double usual_slope = 1.2;
constexpr double max_slope = 1.48;
constexpr double cost_of_slope = 0.3;

double slope(const typography::TableRectangle& place, const glm::dvec3& eye_m) {
    return glm::distance(place.centre_m, glm::dvec2(eye_m)) / std::max(0.01, eye_m.z);
}

/// Half of the place's extent along the table's axes.
glm::dvec2 half_of(const typography::TableRectangle& place) {
    return 0.5 * (place.quarter_turns % 2 == 0 ? place.size_m : glm::dvec2(place.size_m.y, place.size_m.x));
}

/// The distance between two places that are parallel to the table's axes.
double clearance_to(const typography::TableRectangle& place, const typography::TableRectangle& other) {
    const glm::dvec2 off = glm::abs(place.centre_m - other.centre_m) - half_of(place) - half_of(other);
    return glm::length(glm::max(off, glm::dvec2(0.0)));
}

} // namespace

WindowDesk::WindowDesk(const WindowPlace& place, std::span<const glm::dvec2> picture_m)
    : place_(place), picture_m_(picture_m.begin(), picture_m.end()),
      low_m_(std::numeric_limits<double>::infinity()), high_m_(-low_m_) {
    for (std::size_t k = 0; k < picture_m_.size(); ++k) {
        const glm::dvec2& corner = picture_m_[k];
        low_m_ = glm::min(low_m_, corner);
        high_m_ = glm::max(high_m_, corner);
        const glm::dvec2 edge = picture_m_[(k + 1) % picture_m_.size()] - corner;
        const glm::dvec2 inward = glm::normalize(glm::dvec2(-edge.y, edge.x));
        edges_.push_back({inward, glm::dot(inward, corner)});
    }
}

void WindowDesk::undo_pin() {
    for (Window& window : all()) {
        window.goes = window.goes || window.pinned.number == by_press_;
    }
}

void WindowDesk::drop_artifact(std::size_t artifact) {
    for (Window& window : all()) {
        window.goes = window.goes || window.pinned.artifact == artifact;
    }
}

bool WindowDesk::let_oldest_go(std::uint32_t except) {
    for (Window& window : all()) {
        if (!window.goes && window.pinned.number != except) {
            window.goes = true;
            return true;
        }
    }
    return false;
}

/// Windows are pinned one at a time: a press counts when the latest window has faded in.
bool WindowDesk::accepts(const Input& input) const {
    return place_.count > 0 && count_ < windows_.size() && input.shows && !input.gone && input.shadow &&
           std::all_of(all().begin(), all().end(),
                       [](const Window& one) { return one.goes || (one.lies && one.share >= 1.0); });
}

void WindowDesk::pin(MonotonicTime now, const Input& input) {
    Window& window = windows_.at(count_++);
    window = {};
    const ViewToPin view = input.view.value_or(ViewToPin{std::nullopt, input.eye_m, input.table_from_prop});
    window.pinned = {.number = ++numbers_,
                     .artifact = input.artifact,
                     .comings = 0,
                     .rectangle = {{}, place_.size_m, input.quarter_turns},
                     .eye_m = view.eye_m,
                     .table_from_prop = view.table_from_prop,
                     .state = view.state,
                     .live = place_.live && !view.state,
                     .brightness = 0.0};
    window.title_m = input.title_m;
    window.looks_since = window.next_look = now;
    const auto staying =
        std::count_if(all().begin(), all().end(), [](const Window& one) { return !one.goes; });
    if (static_cast<std::size_t>(staying) > place_.count) {
        let_oldest_go(window.pinned.number);
    }
}

void WindowDesk::push(const Input& input) {
    for (Window& window : all()) {
        window.pushed = false;
    }
    if (!input.stands || !input.shadow || lens_.on()) {
        return;
    }
    for (Window& window : all()) {
        typography::TableRectangle& place = window.pinned.rectangle;
        if (!window.lies) {
            continue;
        }
        const std::optional<glm::dvec2> way = slide_clear(place.corners(), input.shadow->corners(), pushed_m);
        if (way && glm::length(*way) <= max_push_m) {
            place.centre_m += *way;
            window.pushed = true;
        }
    }
    for (int round = 0; round < push_rounds; ++round) {
        push_each_other();
    }
    for (Window& window : all()) {
        window.goes =
            window.goes || (window.pushed && !lies_in(window.pinned.rectangle.centre_m, picture_m_));
    }
}

/// Windows that were pushed in this step push those that were not.
void WindowDesk::push_each_other() {
    for (const Window& pusher : all()) {
        for (Window& other : all()) {
            if (!pusher.lies || !pusher.pushed || !other.lies || other.pushed) {
                continue;
            }
            typography::TableRectangle& place = other.pinned.rectangle;
            const std::optional<glm::dvec2> way =
                slide_clear(place.corners(), pusher.pinned.rectangle.corners(), pushed_m);
            if (way && glm::length(*way) <= max_push_m) {
                place.centre_m += *way;
                other.pushed = true;
            }
        }
    }
}

bool WindowDesk::lies_in_lit_part(const typography::TableRectangle& place) const {
    const glm::dvec2 half = half_of(place);
    return !edges_.empty() && std::all_of(edges_.begin(), edges_.end(), [&](const Edge& edge) {
        return glm::dot(edge.inward, place.centre_m) - glm::dot(glm::abs(edge.inward), half) >=
               edge.offset + border_m;
    });
}

bool WindowDesk::is_free(const Window& window, const typography::TableRectangle& place,
                         const Input& input) const {
    return slope(place, input.eye_m) <= max_slope && lies_in_lit_part(place) &&
           std::all_of(input.obstacles.begin(), input.obstacles.end(),
                       [&](const typography::TableRectangle& obstacle) {
                           return clearance_to(place, obstacle) >= beside_m;
                       }) &&
           std::all_of(all().begin(), all().end(),
                       [&](const Window& other) {
                           return other.pinned.number == window.pinned.number || !other.lies ||
                                  clearance_to(place, other.pinned.rectangle) >= beside_m;
                       }) &&
           typography::clearance(place.corners(), input.shadow->corners()) >= from_shadow_m &&
           !(input.sign && typography::clearance(place.corners(), input.sign->corners()) <= 0.0);
}

double WindowDesk::cost_of(const Window& window, const typography::TableRectangle& place,
                           const Input& input) const {
    const auto as_seen = [&](const glm::dvec2& way) { return typography::turned(way, -input.quarter_turns); };
    const Window* beside = nullptr; // the newest of the same artifact
    for (const Window& other : all()) {
        if (other.lies && !other.goes && other.pinned.number != window.pinned.number &&
            other.pinned.artifact == window.pinned.artifact) {
            beside = &other;
        }
    }
    const glm::dvec2 off =
        as_seen(place.centre_m - (beside != nullptr ? beside->pinned.rectangle.centre_m : input.prop_m));
    const double rows = beside != nullptr ? cost_of_another_row : cost_of_other_height;
    const double cost = std::abs(off.x) + rows * std::abs(off.y) + (off.x < 0.0 ? cost_of_left : 0.0);
    return cost + cost_of_slope * std::max(0.0, slope(place, input.eye_m) - usual_slope);
}

std::optional<typography::TableRectangle> WindowDesk::free_place(const Window& window,
                                                                 const Input& input) const {
    for (const double share : size_shares) {
        typography::TableRectangle place{{}, share * place_.size_m, input.quarter_turns};
        if (window.title_m.y > 0.0) {
            place.size_m.x = std::max(place.size_m.x, window.title_m.x);
            place.size_m.y += title_gap_m + window.title_m.y;
        }
        const glm::dvec2 half = half_of(place);
        const glm::dvec2 first = low_m_ + border_m + half;
        const glm::dvec2 way = high_m_ - border_m - half - first;
        const glm::ivec2 steps(glm::ceil(way / grid_m));
        std::optional<typography::TableRectangle> best;
        double best_cost = std::numeric_limits<double>::infinity();
        for (int k = 0; steps.x > 0 && steps.y > 0 && k < (steps.x + 1) * (steps.y + 1); ++k) {
            const glm::dvec2 at(k % (steps.x + 1), k / (steps.x + 1));
            place.centre_m = first + way * at / glm::dvec2(steps);
            double cost = cost_of(window, place, input);
            if (cost >= best_cost || !is_free(window, place, input)) {
                continue;
            }
            if (input.hidden && typography::clearance(place.corners(), input.hidden->corners()) <= 0.0) {
                cost += cost_of_being_hidden;
            }
            if (cost < best_cost) {
                best_cost = cost;
                best = place;
            }
        }
        if (best) {
            return best;
        }
    }
    return std::nullopt;
}

/// Searches for one window in a step, and only while fewer than `count` windows lie on the table. If a new window finds no place, the
/// oldest goes; a window that lost its place and finds no other one is put away.
void WindowDesk::look_for_places(MonotonicTime now, const Input& input) {
    const auto shown = std::count_if(all().begin(), all().end(), [](const Window& one) { return one.lies; });
    if (!input.shadow || static_cast<std::size_t>(shown) >= place_.count) {
        return;
    }
    for (Window& window : all()) {
        if (window.lies || window.goes || now < window.next_look) {
            continue;
        }
        if (const std::optional<typography::TableRectangle> place = free_place(window, input)) {
            window.pinned.rectangle = *place;
            ++window.pinned.comings;
            window.lies = true;
            window.moves = window.is_new = false;
            window.clear = 0.0;
            window.share = 0.0;
            window.covered_since.reset();
        } else if (now - window.looks_since >= gives_up) {
            window.goes = true;
        } else {
            window.next_look = now + between_searches;
            if (window.is_new && !window.displaces) {
                window.displaces = let_oldest_go(window.pinned.number);
            }
        }
        return;
    }
}

double WindowDesk::clear_share_of(const Window& window, const Input& input) const {
    const typography::TableRectangle& place = window.pinned.rectangle;
    double beside = std::numeric_limits<double>::infinity();
    for (const typography::TableRectangle& obstacle : input.obstacles) {
        beside = std::min(beside, clearance_to(place, obstacle));
    }
    for (const Window& other : all()) {
        if (other.lies && other.pinned.number < window.pinned.number) {
            beside = std::min(beside, clearance_to(place, other.pinned.rectangle));
        }
    }
    const double shadow =
        input.shadow ? typography::clearance(place.corners(), input.shadow->corners()) : 0.0;
    return std::min(geometry::ease(beside / thing_dims_m), geometry::ease(shadow / shadow_dims_m));
}

void WindowDesk::cover(MonotonicTime now, const Input& input, double dt_s) {
    for (Window& window : all()) {
        if (!window.lies) {
            continue;
        }
        const double clear = clear_share_of(window, input);
        window.clear = std::min(clear, window.clear + dt_s / clears_in_s);
        if (clear >= touches || window.pushed) {
            window.covered_since.reset();
        } else if (!window.covered_since) {
            window.covered_since = now;
        }
        const bool turns = window.pinned.rectangle.quarter_turns != input.quarter_turns;
        window.moves =
            window.moves || turns || (window.covered_since && now - *window.covered_since >= covered);
        const bool under = input.sign && typography::clearance(window.pinned.rectangle.corners(),
                                                               input.sign->corners()) <= 0.0;
        window.signed_at = under ? std::optional(now) : window.signed_at;
        const bool dims = window.signed_at && now - *window.signed_at < covered;
        window.signed_share =
            std::clamp(window.signed_share + (dims ? dt_s : -dt_s) / under_sign_s, 0.0, 1.0);
    }
}

void WindowDesk::fade(MonotonicTime now, double dt_s) {
    for (Window& window : all()) {
        const bool comes = window.lies && !window.goes && !window.moves;
        window.share = std::clamp(window.share + (comes ? dt_s / comes_s : -dt_s / goes_s), 0.0, 1.0);
        const bool dark = window.share <= 0.0 || (window.moves && window.clear <= 0.0);
        if (window.lies && window.moves && !window.goes && dark) {
            window.lies = false; // it will come again at another place
            window.share = 0.0;
            window.looks_since = window.next_look = now;
        }
    }
    const auto end = std::remove_if(windows_.begin(), windows_.begin() + static_cast<std::ptrdiff_t>(count_),
                                    [](const Window& one) { return one.goes && one.share <= 0.0; });
    count_ = static_cast<std::size_t>(end - windows_.begin());
}

void WindowDesk::step(MonotonicTime now, const Input& input) {
    const double dt_s = last_ ? to_seconds(now - *last_) : 0.0;
    last_ = now;
    for (Window& window : all()) {
        window.goes = window.goes || input.gone;
    }
    has_pinned_ = input.pin && accepts(input);
    if (has_pinned_) {
        pin(now, input);
    }
    if (input.pin) {
        by_press_ = has_pinned_ ? numbers_ : 0;
    }
    look_through(now, input);
    push(input);
    cover(now, input, dt_s);
    fade(now, dt_s);
    look_for_places(now, input);
    present();
    can_pin_ = accepts(input);
}

} // namespace frustumscreen::exhibit

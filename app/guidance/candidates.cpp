#include "app/guidance/candidates.h"

#include <cmath>
#include <numbers>

namespace frustumscreen::guidance {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
/// A prop on the table that hovers less than this counts as standing: trackers err by some millimetres, also
/// downwards.
constexpr double down_within_m = 0.012;

constexpr std::array<double, 4> coarse_ways_m{0.05, 0.12, 0.25, 0.50};
/// The turns beyond a quarter are for props that a quarter turn changes.
constexpr double quarter_deg = 90.0;
constexpr std::array<double, 13> fine_turns_deg{8, 12, 17, 23, 30, 38, 48, 60, 75, 90, 110, 135, 160};
constexpr std::array<double, 4> coarse_turns_deg{20, 45, 90, 135};
constexpr std::array<double, 5> fine_heights_m{0.03, 0.06, 0.12, 0.20, 0.30};
constexpr std::array<double, 2> coarse_heights_m{0.08, 0.25};

/// From 2 to 70 cm, each 14 per cent more.
constexpr std::array<double, 28> fine_ways_m = [] {
    std::array<double, 28> ways{};
    double way_m = 0.02;
    for (double& each : ways) {
        each = way_m;
        way_m *= 1.14;
    }
    return ways;
}();

/// The visitor's direction of view along the table.
double azimuth_of_view(const GuidedState& tracked_state) {
    const glm::dvec3 way = tracked_state.table_from_prop.translation - tracked_state.eye_m;
    return std::hypot(way.x, way.y) > 1e-6 ? std::atan2(way.y, way.x) : 0.5 * std::numbers::pi;
}

void add_slides(std::span<const double> ways_m, int directions, const GuidanceSetup& setup,
                const GuidedState& tracked_state, Candidates& candidates) {
    const double view = azimuth_of_view(tracked_state);
    const bool was_over = over_table(setup, tracked_state.table_from_prop);
    for (int k = 0; k < directions; ++k) {
        const double angle = view + 2.0 * std::numbers::pi * k / directions;
        // Words name left, right, nearer and farther; the arrow shows all other directions.
        const double oblique = k % (directions / 4) == 0 ? 0.0 : 0.15;
        for (const double way_m : ways_m) {
            Move move{Action::Slide};
            move.by_m = {way_m * std::cos(angle), way_m * std::sin(angle), 0.0};
            if (was_over && !over_table(setup, after(move, setup, tracked_state).table_from_prop)) {
                break; // farther ways leave the table too
            }
            candidates.add(move, 0.6 + oblique + way_m / 0.15);
        }
    }
}

/// Places all over the table: a zone that is a narrow strip lies between the sampled directions and ways.
template <typename Add>
void for_each_place(const GuidanceSetup& setup, const GuidedState& tracked_state, Add add) {
    constexpr int columns = 16;
    constexpr int rows = 12;
    constexpr double nearest_place_m = 0.02;
    const glm::dvec2 here(tracked_state.table_from_prop.translation);
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            const glm::dvec2 share(2.0 * column / columns - 1.0, 2.0 * row / rows - 1.0);
            const glm::dvec2 way = share * setup.half_table_m - here;
            if (glm::length(way) >= nearest_place_m) {
                add(glm::dvec3(way, 0.0));
            }
        }
    }
}

void add_places(const GuidanceSetup& setup, const GuidedState& tracked_state, Candidates& candidates) {
    for_each_place(setup, tracked_state, [&](const glm::dvec3& way) {
        candidates.add({Action::Slide, way}, 0.8 + glm::length(way) / 0.15);
    });
}

void add_turns(std::span<const double> turns_deg, const GuidanceSetup& setup, Candidates& candidates) {
    const double longest_deg = geometry::quarters_to_same(setup.prop) == 1 ? quarter_deg : turns_deg.back();
    for (const double turn_deg : turns_deg) {
        if (turn_deg > longest_deg) {
            break;
        }
        for (const double sign : {1.0, -1.0}) {
            Move move{Action::Turn};
            move.turn_rad = sign * turn_deg * degree;
            candidates.add(move, 0.7 + turn_deg / 45.0);
        }
    }
}

void add_heights(std::span<const double> heights_m, const GuidanceSetup& setup,
                 const GuidedState& tracked_state, Candidates& candidates) {
    const double height_now_m = lowest_m(setup.prop, tracked_state.table_from_prop);
    if (height_now_m > heights_m.front()) {
        Move move{Action::Lower};
        move.by_m.z = -height_now_m;
        candidates.add(move, 0.9 + height_now_m / 0.15);
    }
    for (const double height_m : heights_m) {
        Move move{Action::Raise};
        move.by_m.z = height_m;
        candidates.add(move, 1.0 + height_m / 0.15);
        if (height_m <= height_now_m) {
            move = {Action::Lower};
            move.by_m.z = -height_m;
            candidates.add(move, 0.9 + height_m / 0.15);
        }
    }
}

void add_standing(const GuidanceSetup& setup, const GuidedState& tracked_state, Candidates& candidates) {
    const bool leans = tilt_rad(tracked_state.table_from_prop) > upright_within_rad;
    if (leans) {
        candidates.add({Action::Upright}, setup.in_hand ? 1.0 : 0.2);
    } else if (!setup.in_hand && tracked_state.table_from_prop.translation.z > down_within_m) {
        candidates.add({Action::SetDown}, 0.2);
    }
}

/// The prop is already in the hand: it can be stood anywhere in one move.
void add_standing_elsewhere(const GuidanceSetup& setup, const GuidedState& tracked_state,
                            Candidates& candidates) {
    const Action action = candidates.all().front().move.action;
    for_each_place(setup, tracked_state, [&](const glm::dvec3& way) {
        candidates.add({action, way}, (setup.in_hand ? 1.4 : 0.6) + glm::length(way) / 0.25);
    });
}

void add_walks(const GuidanceSetup& setup, Candidates& candidates) {
    if (!setup.head_tracked) {
        return;
    }
    for (const Side side : {Side::Front, Side::Right, Side::Back, Side::Left}) {
        Move move{Action::ComeRound};
        move.side = side;
        candidates.add(move, 6.0);
    }
}

} // namespace

Candidates candidates(const GuidanceSetup& setup, const GuidedState& tracked_state, MoveSet set) {
    Candidates candidates;
    add_standing(setup, tracked_state, candidates);
    // A visitor is asked for nothing else while a prop that belongs on the table is off it.
    if (!candidates.all().empty()) {
        if (set == MoveSet::Only) {
            add_standing_elsewhere(setup, tracked_state, candidates);
        }
        if (!setup.in_hand) {
            return candidates;
        }
    }
    const bool fine = set != MoveSet::Inner;
    if (set == MoveSet::Only) {
        add_slides(fine_ways_m, 24, setup, tracked_state, candidates);
    } else if (set == MoveSet::Inner) {
        add_slides(coarse_ways_m, 8, setup, tracked_state, candidates);
    }
    if (fine) {
        add_places(setup, tracked_state, candidates);
    }
    add_turns(fine ? std::span<const double>(fine_turns_deg) : coarse_turns_deg, setup, candidates);
    if (setup.in_hand) {
        add_heights(fine ? std::span<const double>(fine_heights_m) : coarse_heights_m, setup, tracked_state,
                    candidates);
    }
    add_walks(setup, candidates);
    return candidates;
}

} // namespace frustumscreen::guidance

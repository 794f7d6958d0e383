#include "app/guidance/advice.h"

#include "app/geometry/rotation_angle.h"

#include <array>
#include <numbers>

namespace frustumscreen::guidance {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
/// Ratio to the previous unlit area below which an area counts as smaller.
constexpr double better_share = 0.97;
constexpr int looks_of_an_area = 5; ///< cost of an unlit area, in looks at what is lit

/// Calls `visit` with the executions of a turn or of standing the prop up: various angles, about the prop's middle or
/// not. An unlit range of angles can be only 0.2 degrees wide. `visit` returns false to end.
template <typename Visit> bool for_each_angle(const Move& move, double margin, Visit visit) {
    constexpr int to_each_side = 100;
    constexpr int coarse = 10;
    const bool turns = move.action == Action::Turn;
    const auto visit_each = [&](bool coarsely) {
        for (int k = -to_each_side; k <= to_each_side; ++k) {
            const double share = margin * k / to_each_side;
            for (const bool about_origin : {false, true}) {
                if ((k % coarse == 0) == coarsely &&
                    !visit(Execution{.amount = turns ? 1.0 + sloppy_amount * share : 1.0,
                                     .aside_rad = turns ? 0.0 : sloppy_direction_deg * degree * share,
                                     .raised_rad = 0.0,
                                     .about_origin = about_origin})) {
                    return false;
                }
            }
        }
        return true;
    };
    return visit_each(true) && visit_each(false); // a coarse pass finds most failures early
}

/// As for_each_angle, for a prop that is stood up or set down elsewhere: both the way and the angle vary.
template <typename Visit>
void for_each_place(const Move& move, const GuidanceSetup& setup, double margin, Visit visit) {
    struct Way {
        double amount;
        double rise; ///< in the hand only
    };
    constexpr std::array<Way, 5> in_hand{{{0.0, 0.0}, {-1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}, {1.0, -1.0}}};
    constexpr std::array<Way, 5> on_table{{{0.0, 0.0}, {-1.0, 0.0}, {1.0, 0.0}, {-0.5, 0.0}, {0.5, 0.0}}};
    const std::array<Way, 5>& ways = setup.in_hand ? in_hand : on_table;
    for (const auto& [amount, rise] : ways) {
        const bool goes_on = for_each_angle(move, margin, [&](Execution execution) {
            execution.amount = 1.0 + margin * sloppy_amount * amount;
            execution.raised_rad = margin * sloppy_direction_deg * degree * rise;
            // on the table, the axis of the turn makes no difference
            return (execution.about_origin && !setup.in_hand) || visit(execution);
        });
        if (!goes_on) {
            return;
        }
    }
}

/// As for_each_angle, for a way or a walk: the limits of what people do, and values between.
template <typename Visit>
void for_each_way(const Move& move, const GuidanceSetup& setup, double margin, Visit visit) {
    constexpr std::array<double, 7> amounts{0.0, -1.0, 1.0, -0.67, 0.67, -0.33, 0.33};
    constexpr std::array<double, 9> sides{0.0, -1.0, 1.0, -0.5, 0.5, -0.25, 0.25, -0.75, 0.75};
    const bool vertical = move.action == Action::Raise || move.action == Action::Lower;
    const bool raised = setup.in_hand && (move.action == Action::Slide || vertical);
    const double off_rad = margin * sloppy_direction_deg * degree;
    // A vertical way may lean to any side.
    const double aside_rad = vertical ? std::numbers::pi : off_rad;
    for (const double amount : amounts) {
        for (const double aside : sides) {
            for (const double rise : {0.0, -1.0, 1.0, -0.5, 0.5}) {
                if ((rise == 0.0 || raised) &&
                    !visit(Execution{.amount = 1.0 + margin * sloppy_amount * amount,
                                     .aside_rad = aside_rad * aside,
                                     .raised_rad = off_rad * rise})) {
                    return;
                }
            }
        }
    }
}

template <typename Visit>
void for_each_execution(const Move& move, const GuidanceSetup& setup, double margin, Visit visit) {
    const bool stands = move.action == Action::SetDown || move.action == Action::Upright;
    if (stands_elsewhere(move)) {
        for_each_place(move, setup, margin, visit);
    } else if (stands || move.action == Action::Turn) {
        for_each_angle(move, margin, visit);
    } else {
        for_each_way(move, setup, margin, visit);
    }
}

} // namespace

Help help_of(const FaceReader& reader, const GuidedState& tracked_state, const Move& move, double margin,
             int* looks) {
    const double before_px = reader.lost_px(tracked_state);
    Help help{true};
    int ways = 0;
    int whole = 0;
    for_each_execution(move, reader.setup(), margin, [&](const Execution& execution) {
        const GuidedState next = after(move, reader.setup(), tracked_state, execution);
        const bool is_whole = reader.whole(next);
        ++ways;
        whole += is_whole ? 1 : 0;
        if (looks != nullptr) {
            *looks += is_whole ? 1 : looks_of_an_area;
        }
        help.always = is_whole || reader.lost_px(next) < better_share * before_px;
        return help.always;
    });
    help.whole_share = static_cast<double>(whole) / ways;
    return help;
}

bool GivenAdvice::holds(const GuidedState& tracked_state) const {
    constexpr double begun_m = 0.03;
    constexpr double begun_rad = 10.0 * degree;
    constexpr double walked_m = 0.1;
    const geometry::RigidTransform& now = tracked_state.table_from_prop;
    const geometry::RigidTransform& then = given.table_from_prop;
    return glm::distance(now.translation, then.translation) < begun_m &&
           geometry::rotation_angle(now.rotation, then.rotation) < begun_rad &&
           glm::distance(tracked_state.eye_m, given.eye_m) < walked_m;
}

} // namespace frustumscreen::guidance

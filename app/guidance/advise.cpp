#include "app/guidance/advise.h"

#include "app/geometry/rotation_angle.h"
#include "app/guidance/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace frustumscreen {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
/// An unlit area counts as smaller below this share of the one before.
constexpr double better_share = 0.97;
/// What stands in an order of advice: all in units of effort.
constexpr double not_surely_valid = 1.0;
constexpr double as_advised_already = -1.0;
/// What replaces an advice that stands must help people who are even sloppier, or the two would take turns.
constexpr double newcomers_margin = 1.25;
/// People are looked at on a grid; a little more than its corners holds between them too.
constexpr double usual_margin = 1.12;

struct Found {
    Move move;
    double cost = std::numeric_limits<double>::infinity();
    int steps = 0;
    [[nodiscard]] bool any() const { return steps > 0; }
};

double stays(const std::optional<Standing>& standing, const Move& move) {
    return standing && alike(standing->move, move) ? as_advised_already : 0.0;
}

/// Calls `visit` with what people do who turn the prop or stand it up: the angle is theirs, and whether they turn it about
/// its middle. What is unlit between two angles can be a fifth of a degree wide. `visit` returns false to end.
template <typename Visit> void for_each_angle(const Move& move, double margin, Visit visit) {
    constexpr int to_each_side = 100;
    const bool turns = move.action == Action::Turn;
    for (int k = -to_each_side; k <= to_each_side; ++k) {
        const double share = margin * k / to_each_side;
        for (const bool about_origin : {false, true}) {
            if (!visit(Execution{turns ? 1.0 + sloppy_amount * share : 1.0,
                                 turns ? 0.0 : sloppy_direction_deg * degree * share, 0.0, about_origin})) {
                return;
            }
        }
    }
}

/// The same for a way or a walk: the edges of what people do, and between.
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
                if ((rise == 0.0 || raised) && !visit(Execution{1.0 + margin * sloppy_amount * amount,
                                                                aside_rad * aside, off_rad * rise})) {
                    return;
                }
            }
        }
    }
}

template <typename Visit>
void for_each_execution(const Move& move, const GuidanceSetup& setup, double margin, Visit visit) {
    const bool by_angle =
        move.action == Action::Turn || move.action == Action::SetDown || move.action == Action::Upright;
    by_angle ? for_each_angle(move, margin, visit) : for_each_way(move, setup, margin, visit);
}

/// The best single move: valid if it is done well, and helpful however it is done.
Found single_move(const FaceReader& reader, const GuidedSituation& situation,
                  const std::optional<Standing>& standing) {
    struct Promising {
        Candidate candidate;
        double least_cost = 0.0;
    };
    const Candidates list = candidates(reader.setup(), situation, Part::Only);
    std::array<Promising, Candidates::most> promising;
    std::size_t count = 0;
    for (const Candidate& candidate : list.all()) {
        if (reader.valid(after(candidate.move, reader.setup(), situation))) {
            promising[count++] = {candidate, candidate.effort + stays(standing, candidate.move)};
        }
    }
    std::sort(promising.begin(), promising.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Promising& a, const Promising& b) { return a.least_cost < b.least_cost; });
    const auto replaces = [&](const Move& move) {
        return standing && standing->holds(situation) && !alike(standing->move, move);
    };
    Found best;
    for (std::size_t k = 0; k < count && promising[k].least_cost < best.cost; ++k) {
        const Move& move = promising[k].candidate.move;
        const Help help = help_of(reader, situation, move, replaces(move) ? newcomers_margin : usual_margin);
        const double cost = promising[k].least_cost + (help == Help::Valid ? 0.0 : not_surely_valid);
        if (help != Help::No && cost < best.cost) {
            best = {move, cost, 1};
        }
    }
    return best;
}

/// Of a sequence: each move done well, the end valid. Only its first move and its length matter.
struct Search {
    const FaceReader& reader;
    Part last; ///< of its last move: any but, faster, Inner

    /// The easiest of `depth` moves; where `like` is given, of those that begin alike.
    [[nodiscard]] Found easiest(const GuidedSituation& situation, int depth,
                                const std::optional<Move>& like = std::nullopt) const {
        const Candidates list = candidates(reader.setup(), situation, depth == 1 ? last : Part::Inner);
        Found best;
        for (const Candidate& candidate : list.all()) {
            if (candidate.effort >= best.cost || (like && !alike(*like, candidate.move))) {
                continue;
            }
            const GuidedSituation next = after(candidate.move, reader.setup(), situation);
            if (depth == 1) {
                if (reader.valid(next)) {
                    best = {candidate.move, candidate.effort, 1};
                }
                continue;
            }
            const Found rest = easiest(next, depth - 1);
            if (rest.any() && candidate.effort + rest.cost < best.cost) {
                best = {candidate.move, candidate.effort + rest.cost, depth};
            }
        }
        return best;
    }
};

/// The easiest of up to two moves. With the last move all over the table only where no coarse one is found.
Found up_to_two(const FaceReader& reader, const GuidedSituation& situation,
                const std::optional<Move>& like = std::nullopt) {
    constexpr std::array<std::pair<int, Part>, 4> searches{
        {{1, Part::Only}, {1, Part::Last}, {2, Part::Inner}, {2, Part::Last}}};
    for (const auto& [depth, last] : searches) {
        if (const Found found = Search{reader, last}.easiest(situation, depth, like); found.any()) {
            return found;
        }
    }
    return {};
}

/// The moves with which longer sequences begin: stood upright, then lowered to the table, the prop is where a zone is
/// widest.
std::optional<Move> settling(const GuidanceSetup& setup, const GuidedSituation& situation) {
    constexpr double low_enough_m = 0.03;
    if (tilt_rad(situation.table_from_prop) > upright_within_rad) {
        return Move{Action::Upright};
    }
    const double height_m = lowest_m(setup.prop, situation.table_from_prop);
    if (setup.in_hand && height_m > low_enough_m) {
        Move move{Action::Lower};
        move.by_m.z = -height_m;
        return move;
    }
    return std::nullopt;
}

/// Settles the prop, then goes on with up to two moves.
Found after_settling(const FaceReader& reader, const GuidedSituation& situation) {
    GuidedSituation settled = situation;
    std::optional<Move> first;
    for (int steps = 1;; ++steps) {
        const std::optional<Move> next = settling(reader.setup(), settled);
        if (!next) {
            return {};
        }
        first = first ? first : next;
        settled = after(*next, reader.setup(), settled);
        if (const Found found = up_to_two(reader, settled); found.any()) {
            return {*first, found.cost, found.steps + steps};
        }
    }
}

/// The first of the shortest sequence found. What stands is kept while a sequence begins with it.
Found sequence(const FaceReader& reader, const GuidedSituation& situation,
               const std::optional<Standing>& standing) {
    if (standing && standing->holds(situation)) {
        if (const Found found = up_to_two(reader, situation, standing->move); found.any()) {
            return found;
        }
        const Found found = after_settling(reader, situation);
        if (found.any() && alike(found.move, standing->move)) {
            return found;
        }
    }
    const Found found = up_to_two(reader, situation);
    return found.any() ? found : after_settling(reader, situation);
}

} // namespace

Help help_of(const FaceReader& reader, const GuidedSituation& situation, const Move& move, double margin) {
    const double before_px = reader.unlit_px(situation);
    Help help = Help::Valid;
    for_each_execution(move, reader.setup(), margin, [&](const Execution& execution) {
        const GuidedSituation next = after(move, reader.setup(), situation, execution);
        if (!reader.valid(next)) {
            help = reader.unlit_px(next) < better_share * before_px ? Help::Better : Help::No;
        }
        return help != Help::No;
    });
    return help;
}

std::optional<Advice> advise(const FaceReader& reader, const GuidedSituation& situation,
                             const std::optional<Standing>& standing) {
    if (reader.valid(situation)) {
        return std::nullopt;
    }
    if (const Found found = single_move(reader, situation, standing); found.any()) {
        return Advice{found.move, 1};
    }
    if (const Found found = sequence(reader, situation, standing); found.any()) {
        // A single move that people may get wrong is mended by one more.
        return Advice{found.move, std::max(2, found.steps)};
    }
    return Advice{Move{}, 1};
}

bool Standing::holds(const GuidedSituation& situation) const {
    constexpr double begun_m = 0.03;
    constexpr double begun_rad = 10.0 * degree;
    constexpr double walked_m = 0.1;
    const RigidTransform& now = situation.table_from_prop;
    const RigidTransform& then = given.table_from_prop;
    return glm::distance(now.translation, then.translation) < begun_m &&
           rotation_angle(now.rotation, then.rotation) < begun_rad &&
           glm::distance(situation.eye_m, given.eye_m) < walked_m;
}

std::optional<Advice> Advisor::advise(const GuidedSituation& situation) {
    const std::optional<Advice> advice = frustumscreen::advise(reader_, situation, standing_);
    if (!advice) {
        standing_.reset();
    } else if (!standing_ || !alike(standing_->move, advice->move) || !standing_->holds(situation)) {
        standing_ = Standing{advice->move, situation};
    }
    return advice;
}

} // namespace frustumscreen

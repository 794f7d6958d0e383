#include "app/guidance/advice_search.h"

#include "app/guidance/steadiness.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::guidance {

namespace {

/// Terms of the order of advice, in units of effort.
constexpr double not_surely_whole = 3.0; ///< if no execution makes the artifact whole
constexpr double as_advised_already = -2.0;
constexpr double unsteady = 6.0; ///< if no small movement leaves it whole
/// An advice that replaces the standing one must help with larger deviations, or the two would alternate.
constexpr double newcomers_margin = 1.25;
/// Executions are sampled on a grid; a margin slightly beyond its corners covers the values between them.
constexpr double usual_margin = 1.12;

/// The moves that begin longer sequences: stood upright, then lowered to the table, the prop is where its zone is
/// widest.
std::optional<Move> settling(const GuidanceSetup& setup, const GuidedState& tracked_state) {
    constexpr double low_enough_m = 0.03;
    if (tilt_rad(tracked_state.table_from_prop) > upright_within_rad) {
        return Move{Action::Upright};
    }
    const double height_m = lowest_m(setup.prop, tracked_state.table_from_prop);
    if (setup.in_hand && height_m > low_enough_m) {
        Move move{Action::Lower};
        move.by_m.z = -height_m;
        return move;
    }
    return std::nullopt;
}

} // namespace

void AdviceSearch::begin(const FaceReader& reader, const GuidedState& tracked_state,
                         const std::optional<GivenAdvice>& standing) {
    tracked_state_ = tracked_state;
    standing_ = standing;
    found_.reset();
    over_ = reader.whole(tracked_state);
    stage_ = Stage::Begun;
    best_ = {};
}

bool AdviceSearch::advance(const FaceReader& reader, int looks) {
    looks_left_ = looks;
    while (!over_ && looks_left_ > 0) {
        switch (stage_) {
        case Stage::Begun:
            collect_single_moves(reader);
            break;
        case Stage::Steadiness:
            weigh_single_move(reader);
            break;
        case Stage::SingleMoves:
            try_single_move(reader);
            break;
        case Stage::Sequences:
            go_on_with_try(reader);
            break;
        }
    }
    return over_;
}

void AdviceSearch::end(const Move& move, int steps) {
    found_ = Advice{move, steps};
    over_ = true;
}

/// Collects the moves that make the artifact whole if carried out well, the easiest first.
void AdviceSearch::collect_single_moves(const FaceReader& reader) {
    const Candidates list = candidates(reader.setup(), tracked_state_, MoveSet::Only);
    looks_left_ -= static_cast<int>(list.all().size());
    candidates_ = {};
    for (const Candidate& candidate : list.all()) {
        if (reader.whole(after(candidate.move, reader.setup(), tracked_state_))) {
            const bool stays = standing_ && alike(standing_->move, candidate.move);
            candidates_.add(candidate.move, candidate.effort + (stays ? as_advised_already : 0.0));
        }
    }
    next_ = 0;
    stage_ = Stage::Steadiness;
}

/// Adds to a move's effort the steadiness of the situation that it ends in.
void AdviceSearch::weigh_single_move(const FaceReader& reader) {
    if (next_ == candidates_.all().size()) {
        candidates_.sort_by_effort();
        next_ = 0;
        stage_ = Stage::SingleMoves;
        return;
    }
    const GuidedState next = after(candidates_.all()[next_].move, reader.setup(), tracked_state_);
    candidates_.add_effort(next_++, cost_of_end(reader, next));
}

/// Finds the best move that makes the artifact whole if carried out well and helps however it is carried out.
void AdviceSearch::try_single_move(const FaceReader& reader) {
    const std::span<const Candidate> moves = candidates_.all();
    if (next_ == moves.size() || moves[next_].effort >= best_.cost) {
        if (best_.any()) {
            end(best_.move, 1);
        } else {
            plan_sequences(reader);
        }
        return;
    }
    const auto& [move, effort] = moves[next_++];
    const bool replaces = standing_ && standing_->holds(tracked_state_) && !alike(standing_->move, move);
    int looks = 0;
    const Help help =
        help_of(reader, tracked_state_, move, replaces ? newcomers_margin : usual_margin, &looks);
    looks_left_ -= looks;
    const double cost = effort + not_surely_whole * (1.0 - help.whole_share);
    if (help.always && cost < best_.cost) {
        best_ = {move, cost};
    }
}

/// The standing advice is kept while a sequence begins with it.
void AdviceSearch::plan_sequences(const FaceReader& reader) {
    try_count_ = 0;
    if (standing_ && standing_->holds(tracked_state_)) {
        Try kept{tracked_state_};
        kept.like = standing_->move;
        plan_up_to_two(kept);
        const std::optional<Move> first = settling(reader.setup(), tracked_state_);
        if (first && alike(*first, standing_->move)) {
            plan_after_settling(reader);
        }
    }
    plan_up_to_two({tracked_state_});
    plan_after_settling(reader);
    stage_ = Stage::Sequences;
    try_ = 0;
    begin_try(reader);
}

/// Tries the last move all over the table only if no coarse one is found.
void AdviceSearch::plan_up_to_two(Try from) {
    constexpr std::array<std::pair<int, MoveSet>, 4> searches{
        {{1, MoveSet::Only}, {1, MoveSet::Last}, {2, MoveSet::Inner}, {2, MoveSet::Last}}};
    for (const auto& [depth, last] : searches) {
        from.depth = depth;
        from.last = last;
        tries_.at(try_count_++) = from;
    }
}

void AdviceSearch::plan_after_settling(const FaceReader& reader) {
    Try settled{tracked_state_};
    while (const std::optional<Move> next = settling(reader.setup(), settled.from)) {
        settled.settled_by = settled.settled_by ? settled.settled_by : next;
        settled.from = after(*next, reader.setup(), settled.from);
        ++settled.steps_before;
        plan_up_to_two(settled);
    }
}

void AdviceSearch::begin_try(const FaceReader& reader) {
    best_ = {};
    next_ = 0;
    if (try_ == try_count_) {
        end(Move{}, 1); // the visitor has to wait
        return;
    }
    const Try& search = tries_.at(try_);
    candidates_ = candidates(reader.setup(), search.from, search.depth == 1 ? search.last : MoveSet::Inner);
}

/// Each move is carried out well, and the artifact is whole at the end; only the first move and the length matter.
void AdviceSearch::go_on_with_try(const FaceReader& reader) {
    const Try& search = tries_.at(try_);
    if (next_ == candidates_.all().size()) {
        if (best_.any()) {
            // An uncertain single move may need one more as a correction.
            end(search.settled_by.value_or(best_.move), std::max(2, search.depth + search.steps_before));
        } else {
            ++try_;
            begin_try(reader);
        }
        return;
    }
    const Candidate& first = candidates_.all()[next_++];
    --looks_left_;
    // A place and a turn at once are hard to carry out in the hand; if that is not sure to help, two moves are
    // easier.
    const bool too_much = reader.setup().in_hand && stands_elsewhere(first.move);
    if (too_much || first.effort >= best_.cost || (search.like && !alike(*search.like, first.move))) {
        return;
    }
    const GuidedState next = after(first.move, reader.setup(), search.from);
    const double rest = search.depth == 1 ? cost_of_end(reader, next) : min_effort(reader, next, search.last);
    if (first.effort + rest < best_.cost) {
        best_ = {first.move, first.effort + rest};
    }
}

/// The cost of ending in a situation: at the edge of the light, another advice would soon be needed.
double AdviceSearch::cost_of_end(const FaceReader& reader, const GuidedState& end) {
    if (!reader.whole(end)) {
        return never;
    }
    int looks = 0;
    const double cost = unsteady * (1.0 - steadiness(reader, end, looks));
    looks_left_ -= looks;
    return cost;
}

/// The least effort of the one move that is left.
double AdviceSearch::min_effort(const FaceReader& reader, const GuidedState& from, MoveSet set) {
    double least = never;
    const Candidates list = candidates(reader.setup(), from, set);
    looks_left_ -= static_cast<int>(list.all().size());
    for (const Candidate& candidate : list.all()) {
        if (candidate.effort < least) {
            const double cost =
                candidate.effort + cost_of_end(reader, after(candidate.move, reader.setup(), from));
            least = std::min(least, cost);
        }
    }
    return least;
}

} // namespace frustumscreen::guidance

// The search for an advice, compared with an exhaustive one over every listed move and sequence.

#include "app/guidance/advice_search.h"
#include "app/guidance/steadiness.h"
#include "guided_props.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace frustumscreen::guidance {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The costs found by the exhaustive search, for each first move.
struct Found {
    struct One {
        Move move;
        double cost = never;
    };
    std::vector<One> all;
    [[nodiscard]] double least() const {
        double least = never;
        for (const One& one : all) {
            least = std::min(least, one.cost);
        }
        return least;
    }
    [[nodiscard]] double cost_of(const Move& move) const {
        for (const One& one : all) {
            if (one.move.action == move.action && one.move.by_m == move.by_m &&
                one.move.turn_rad == move.turn_rad && one.move.side == move.side) {
                return one.cost;
            }
        }
        return never;
    }
};

/// The cost of an end: six for an end that no small movement leaves whole.
double cost_of_end(const FaceReader& reader, const GuidedState& end) {
    int looks = 0;
    return reader.valid(end) ? 6.0 * (1.0 - steadiness(reader, end, looks)) : never;
}

/// Single moves that always help: their effort, the cost of their end, and three if no execution leads to a whole
/// picture.
Found single_moves(const FaceReader& reader, const GuidedState& tracked_state,
                   const std::optional<GivenAdvice>& standing) {
    Found found;
    for (const Candidate& each : candidates(reader.setup(), tracked_state, MoveSet::Only).all()) {
        const double end = cost_of_end(reader, after(each.move, reader.setup(), tracked_state));
        const bool is_standing = standing && alike(standing->move, each.move);
        const bool replaces = standing && standing->holds(tracked_state) && !is_standing;
        const Help help = help_of(reader, tracked_state, each.move, replaces ? 1.25 : 1.12);
        if (help.always && end < never) {
            found.all.push_back(
                {each.move, each.effort - (is_standing ? 2.0 : 0.0) + end + 3.0 * (1.0 - help.whole_share)});
        }
    }
    return found;
}

/// Sequences of moves that are carried out well.
Found sequences(const FaceReader& reader, const GuidedState& tracked_state, int length, MoveSet last) {
    const GuidanceSetup& setup = reader.setup();
    Found found;
    for (const Candidate& first :
         candidates(setup, tracked_state, length == 1 ? last : MoveSet::Inner).all()) {
        if (setup.in_hand && stands_elsewhere(first.move)) {
            continue; // hard to carry out in the hand; two moves are easier
        }
        const GuidedState next = after(first.move, setup, tracked_state);
        double rest = length == 1 ? cost_of_end(reader, next) : never;
        if (length == 2) {
            for (const Candidate& second : candidates(setup, next, last).all()) {
                const GuidedState end = after(second.move, setup, next);
                if (second.effort < rest && reader.valid(end)) { // the cost of the end is at least 0
                    rest = std::min(rest, second.effort + cost_of_end(reader, end));
                }
            }
        }
        if (rest < never) {
            found.all.push_back({first.move, first.effort + rest});
        }
    }
    return found;
}

std::optional<Advice> searched(const FaceReader& reader, const GuidedState& tracked_state,
                               const std::optional<GivenAdvice>& standing = {}) {
    AdviceSearch search;
    search.begin(reader, tracked_state, standing);
    EXPECT_TRUE(search.advance(reader, AdviceSearch::unlimited));
    return search.found();
}

class SearchOf : public ::testing::TestWithParam<GuidanceSetup (*)()> {
protected:
    const FaceReader reader{GetParam()()};
    bench::Seeded seeded{23};
};
INSTANTIATE_TEST_SUITE_P(EveryProp, SearchOf, ::testing::Values(&frustum_setup, &cube_setup, &wedge_setup));

TEST_P(SearchOf, FindsTheEasiestSingleMove) {
    int single = 0;
    const int situations = reader.setup().in_hand ? 25 : 60; // in the hand there are far more moves
    for (int k = 0; k < situations; ++k) {
        const GuidedState tracked_state = bench::seeded_situation(reader.setup(), seeded);
        const std::optional<Advice> advice = searched(reader, tracked_state);
        ASSERT_EQ(advice.has_value(), !reader.valid(tracked_state));
        if (!advice) {
            continue;
        }
        const Found all = single_moves(reader, tracked_state, {});
        EXPECT_EQ(advice->steps == 1 && advice->move.action != Action::Wait, all.least() < never) << k;
        if (advice->steps == 1 && all.least() < never) {
            ++single;
            EXPECT_NEAR(all.cost_of(advice->move), all.least(), 1e-9) << k;
        }
    }
    EXPECT_GT(single, 4);
}

TEST_P(SearchOf, KeepsStandingAdviceUnlessClearlyBeaten) {
    int kept = 0;
    int single = 0;
    const int situations = reader.setup().in_hand ? 20 : 40;
    for (int k = 0; k < situations; ++k) {
        const GuidedState tracked_state = bench::seeded_situation(reader.setup(), seeded);
        const std::optional<Advice> before = searched(reader, tracked_state);
        if (!before || before->steps != 1) {
            continue;
        }
        GuidedState nearby = tracked_state; // the visitor has hardly begun to follow
        nearby.table_from_prop.translation += glm::dvec3(seeded.between(-0.004, 0.004), 0.0, 0.0);
        const GivenAdvice standing{before->move, tracked_state};
        const std::optional<Advice> now = searched(reader, nearby, standing);
        const Found all = single_moves(reader, nearby, standing);
        if (now && now->steps == 1 && all.least() < never) {
            ++single;
            EXPECT_NEAR(all.cost_of(now->move), all.least(), 1e-9) << k;
            kept += alike(now->move, before->move) ? 1 : 0;
        }
    }
    EXPECT_GT(single, 3);
    EXPECT_GE(10 * kept, 9 * single) << "of " << single;
}

TEST_P(SearchOf, FindsTheEasiestOfTheShortestSequences) {
    int several = 0;
    for (int k = 0; k < 4000 && several < 8; ++k) {
        const GuidedState tracked_state = bench::seeded_situation(reader.setup(), seeded);
        const std::optional<Advice> advice = searched(reader, tracked_state);
        if (!advice || advice->steps != 2) {
            continue;
        }
        ++several;
        Found all;
        for (const auto& [length, last] :
             {std::pair(1, MoveSet::Only), {1, MoveSet::Last}, {2, MoveSet::Inner}, {2, MoveSet::Last}}) {
            if (all.least() == never) {
                all = sequences(reader, tracked_state, length, last);
            }
        }
        ASSERT_LT(all.least(), never) << k;
        EXPECT_NEAR(all.cost_of(advice->move), all.least(), 1e-9) << k;
    }
    EXPECT_GT(several, 3);
}

TEST_P(SearchOf, KeepsTheFirstMoveOfAStandingSequence) {
    int several = 0;
    for (int k = 0; k < 400 && several < 4; ++k) {
        const GuidedState tracked_state = bench::seeded_situation(reader.setup(), seeded);
        const std::optional<Advice> advice = searched(reader, tracked_state);
        if (advice && advice->steps > 1) {
            ++several;
            const std::optional<Advice> again =
                searched(reader, tracked_state, GivenAdvice{advice->move, tracked_state});
            ASSERT_TRUE(again);
            EXPECT_TRUE(alike(again->move, advice->move)) << k;
        }
    }
    EXPECT_GT(several, 0);
}

/// A projector that lights nothing: no move helps, and the visitor has to wait.
TEST_P(SearchOf, AdvisesToWaitWhenNoSequenceHelps) {
    GuidanceSetup dark = GetParam()();
    dark.projector.width = 1; // its picture is empty
    dark.projector.height = 1;
    const FaceReader nothing_lit(dark);
    GuidedState tracked_state = bench::seeded_situation(reader.setup(), seeded);
    while (nothing_lit.read(tracked_state).seen == 0) {
        tracked_state = bench::seeded_situation(reader.setup(), seeded);
    }
    const std::optional<Advice> advice = searched(nothing_lit, tracked_state);
    ASSERT_TRUE(advice);
    EXPECT_EQ(advice->move.action, Action::Wait);
    EXPECT_EQ(advice->steps, 1);
}

/// Advice of three or four moves: no sequence of two exists, even with the last move all over the table.
TEST_P(SearchOf, AdvisesNoLongerSequenceThanNeeded) {
    int longer = 0;
    for (int k = 0; k < 400 && longer < 3; ++k) {
        const GuidedState tracked_state = bench::seeded_situation(reader.setup(), seeded);
        const std::optional<Advice> advice = searched(reader, tracked_state);
        if (advice && advice->steps > 2) {
            ++longer;
            EXPECT_EQ(single_moves(reader, tracked_state, {}).least(), never) << k;
            EXPECT_EQ(sequences(reader, tracked_state, 2, MoveSet::Last).least(), never) << k;
        }
    }
    EXPECT_TRUE(longer == 3 || !reader.setup().in_hand)
        << longer; // on the table two moves are nearly always enough
}

TEST_P(SearchOf, IsTheSameInPiecesAndAfterAnAbandonedSearch) {
    AdviceSearch search;
    int sought = 0;
    for (int k = 0; k < 12; ++k) {
        search.begin(reader, bench::seeded_situation(reader.setup(), seeded), {});
        static_cast<void>(search.advance(reader, 500)); // abandoned
        const GuidedState tracked_state = bench::seeded_situation(reader.setup(), seeded);
        search.begin(reader, tracked_state, {});
        EXPECT_EQ(search.tracked_state().table_from_prop.translation,
                  tracked_state.table_from_prop.translation);
        EXPECT_FALSE(search.found());
        while (!search.advance(reader, 1)) {
            EXPECT_FALSE(search.found()) << "it is not over";
        }
        const std::optional<Advice> whole = searched(reader, tracked_state);
        ASSERT_EQ(search.found().has_value(), whole.has_value());
        if (whole) {
            ++sought;
            EXPECT_EQ(search.found()->move.action, whole->move.action);
            EXPECT_EQ(search.found()->move.by_m, whole->move.by_m);
            EXPECT_EQ(search.found()->move.turn_rad, whole->move.turn_rad);
            EXPECT_EQ(search.found()->steps, whole->steps);
        }
        EXPECT_TRUE(search.advance(reader, 1)) << "it stays over";
    }
    EXPECT_GT(sought, 3);
}

TEST(AdviceSearch, IsOverWithoutAResultBeforeItBegins) {
    AdviceSearch search;
    EXPECT_TRUE(search.advance(FaceReader(frustum_setup()), 1));
    EXPECT_FALSE(search.found());
}

} // namespace
} // namespace frustumscreen::guidance

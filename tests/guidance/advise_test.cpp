// Advice, carried out as people do it.
#include "app/guidance/guide.h"
#include "guided_props.h"

#include <gtest/gtest.h>

namespace frustumscreen::guidance {
namespace {

class AdviceOf : public ::testing::TestWithParam<GuidanceSetup (*)()> {};
INSTANTIATE_TEST_SUITE_P(EveryProp, AdviceOf, ::testing::Values(&frustum_setup, &cube_setup, &wedge_setup));

TEST_P(AdviceOf, HelpsHoweverItIsFollowed) {
    const FaceReader reader(GetParam()());
    bench::Seeded seeded(11);
    int single = 0;
    int several = 0;
    for (int k = 0; k < 400 || (several <= 20 && k < 4000); ++k) {
        const GuidedState tracked_state = bench::seeded_situation(reader.setup(), seeded);
        const std::optional<Advice> advice = advise(reader, tracked_state);
        EXPECT_EQ(advice.has_value(), !reader.read(tracked_state).valid());
        if (!advice) {
            continue;
        }
        EXPECT_NE(advice->move.action, Action::Wait) << "situation " << k;
        ++(advice->steps == 1 ? single : several);
        if (advice->steps > 1) {
            continue;
        }
        for (int person_k = 0; person_k < 20; ++person_k) {
            const Execution execution = bench::seeded_person(advice->move, reader.setup(), seeded);
            const GuidedState next = after(advice->move, reader.setup(), tracked_state, execution);
            EXPECT_TRUE(reader.valid(next) || reader.unlit_px(next) < reader.unlit_px(tracked_state))
                << "situation " << k << ": " << name_of(advice->move.action);
        }
    }
    EXPECT_GT(single, 80); // both occur
    EXPECT_GT(several, 20);
}

TEST_P(AdviceOf, IsTheSameWhenSearchedInPieces) {
    const FaceReader reader(GetParam()());
    bench::Seeded seeded(17);
    std::optional<GivenAdvice> standing;
    int max_pieces = 0;
    for (int k = 0; k < 100; ++k) {
        const GuidedState tracked_state = bench::seeded_situation(reader.setup(), seeded);
        const std::optional<Advice> whole = advise(reader, tracked_state, standing);
        AdviceSearch search;
        search.begin(reader, tracked_state, standing);
        int pieces = 1;
        while (!search.advance(reader, Guide::looks_a_step)) {
            ++pieces;
        }
        max_pieces = std::max(max_pieces, pieces);
        ASSERT_EQ(search.found().has_value(), whole.has_value());
        if (whole) {
            EXPECT_EQ(search.found()->move.action, whole->move.action);
            EXPECT_EQ(search.found()->move.by_m, whole->move.by_m);
            EXPECT_EQ(search.found()->move.turn_rad, whole->move.turn_rad);
            EXPECT_EQ(search.found()->steps, whole->steps);
            standing = GivenAdvice{whole->move, tracked_state};
        }
    }
    EXPECT_GT(max_pieces, 2); // some are long
    EXPECT_LT(max_pieces, 100);
}

TEST_P(AdviceOf, LeadsToAWholePictureInAFewMoves) {
    const FaceReader reader(GetParam()());
    bench::Seeded seeded(12);
    int left = 0;
    constexpr int situations = 150;
    constexpr int max_moves = 12; // with sloppy executions; carried out well, at most four are needed
    for (int k = 0; k < situations; ++k) {
        GuidedState tracked_state = bench::seeded_situation(reader.setup(), seeded);
        Advisor advisor(reader.setup());
        for (int moves = 0; moves < max_moves; ++moves) {
            const std::optional<Advice> advice = advisor.advise(tracked_state);
            if (!advice) {
                break;
            }
            tracked_state = after(advice->move, reader.setup(), tracked_state,
                                  bench::seeded_person(advice->move, reader.setup(), seeded));
        }
        left += reader.valid(tracked_state) ? 0 : 1;
    }
    EXPECT_LE(left, situations / 100);
}

/// Walks the situation in steps of 0.1 degrees or 0.3 mm. The advice may change with the situation, but it does not
/// return to the previous one within the next steps.
TEST_P(AdviceOf, DoesNotFlipBetweenNeighbours) {
    const FaceReader reader(GetParam()());
    bench::Seeded seeded(13);
    int changes = 0;
    const int walks = reader.setup().in_hand ? 4 : 12; // in the hand an advice takes longer to find
    for (int walk = 0; walk < walks; ++walk) {
        GuidedState tracked_state = bench::seeded_situation(reader.setup(), seeded);
        const glm::dquat turn = glm::angleAxis(0.1 * std::numbers::pi / 180.0, glm::dvec3(0, 0, 1));
        const double azimuth = seeded.between(-3.0, 3.0);
        const glm::dvec3 step = 0.3e-3 * glm::dvec3(std::cos(azimuth), std::sin(azimuth), 0.0);
        Advisor advisor(reader.setup());
        std::optional<Move> standing;
        std::optional<Move> before_it; // the standing one before the latest change
        int since_change = 100;
        for (int k = 0; k < 400; ++k) {
            const std::optional<Advice> advice = advisor.advise(tracked_state);
            ++since_change;
            if (advice && standing && !alike(advice->move, *standing)) {
                EXPECT_FALSE(since_change < 10 && before_it && alike(*before_it, advice->move))
                    << "walk " << walk << ", step " << k;
                before_it = standing;
                since_change = 0;
                ++changes;
            }
            standing = advice ? std::optional(advice->move) : std::nullopt;
            tracked_state.table_from_prop.rotation = turn * tracked_state.table_from_prop.rotation;
            tracked_state.table_from_prop.translation += step;
        }
    }
    EXPECT_GT(changes, 0); // the walk crossed boundaries
}

/// A dense search for a single slide that helps even with slightly larger deviations: if one exists, the advice
/// seldom takes two moves.
TEST_P(AdviceOf, IsRarelyLongerThanADenseSearchFinds) {
    const FaceReader reader(GetParam()());
    const GuidanceSetup& setup = reader.setup();
    bench::Seeded seeded(14);
    int several = 0;
    int missed = 0;
    const int situations = setup.in_hand ? 100 : 1000; // few upright props need several
    for (int k = 0; k < situations; ++k) {
        const GuidedState tracked_state = bench::seeded_situation(setup, seeded);
        const std::optional<Advice> advice = advise(reader, tracked_state);
        const bool stands = setup.in_hand || (tilt_rad(tracked_state.table_from_prop) < upright_within_rad &&
                                              tracked_state.table_from_prop.translation.z < 0.004);
        if (!advice || advice->steps == 1 || !stands) {
            continue;
        }
        ++several;
        bool found = false;
        for (int way = 1; way <= 60 && !found; ++way) {
            for (int direction = 0; direction < 72 && !found; ++direction) {
                Move move{Action::Slide};
                const double angle = direction * std::numbers::pi / 36.0;
                move.by_m = 0.012 * way * glm::dvec3(std::cos(angle), std::sin(angle), 0.0);
                const GuidedState next = after(move, setup, tracked_state);
                found = over_table(setup, next.table_from_prop) && reader.valid(next) &&
                        help_of(reader, tracked_state, move, 1.2).always;
            }
        }
        missed += found ? 1 : 0;
    }
    EXPECT_LE(missed, 1 + several / 12) << "of " << several;
    EXPECT_GT(several, 0);
}

TEST(Advice, NamesTheObviousMove) {
    const FaceReader reader(frustum_setup());
    GuidedState tracked_state;
    tracked_state.eye_m = {0.0, -0.55, 0.5};
    EXPECT_FALSE(advise(reader, tracked_state)); // the table's middle is lit
    tracked_state.table_from_prop.translation = {0.3, 0.0, 0.0};
    const std::optional<Advice> out_of_the_beam = advise(reader, tracked_state);
    ASSERT_TRUE(out_of_the_beam);
    EXPECT_EQ(out_of_the_beam->move.action, Action::Slide);
    EXPECT_LT(out_of_the_beam->move.by_m.x, -0.05);

    tracked_state.table_from_prop.translation = {0.2, 0.1, 0.4};
    const std::optional<Advice> lifted = advise(reader, tracked_state);
    ASSERT_TRUE(lifted);
    EXPECT_EQ(lifted->move.action, Action::SetDown);

    tracked_state.table_from_prop = {glm::angleAxis(1.9, glm::dvec3(1, 0, 0)), glm::dvec3(0.0, 0.0, 0.1)};
    const std::optional<Advice> on_its_side = advise(reader, tracked_state);
    ASSERT_TRUE(on_its_side);
    EXPECT_EQ(on_its_side->move.action, Action::Upright);
}

} // namespace
} // namespace frustumscreen::guidance

// Guidance of two eyes, compared with that of each eye alone.
#include "app/exhibit/guidance_setup.h"
#include "app/guidance/advise.h"
#include "guided_props.h"

#include <gtest/gtest.h>

namespace frustumscreen::guidance {
namespace {

/// A head that is turned in any way, its eyes 50 to 75 mm apart.
GuidedState with_two_eyes(GuidedState state, bench::Seeded& seeded) {
    const glm::dvec3 any(seeded.normal(), seeded.normal(), seeded.normal());
    state.to_right_eye_m = 0.5 * seeded.between(0.050, 0.075) * glm::normalize(any);
    return state;
}

struct Alone {
    GuidedState left;
    GuidedState right;
};
Alone each_of(const GuidedState& both) {
    GuidedState left;
    left.table_from_prop = both.table_from_prop;
    left.eye_m = both.eye_m - both.to_right_eye_m;
    GuidedState right = left;
    right.eye_m = both.eye_m + both.to_right_eye_m;
    return {left, right};
}

/// A box around the prop's axis, 0.5 as wide and 0.9 as high as the box around the prop.
std::vector<glm::dvec3> artifact_in(const geometry::PropShape& prop) {
    std::vector<glm::dvec3> corners;
    for (int k = 0; k < 8; ++k) {
        const glm::dvec3 side(k % 2 * 2 - 1, k / 2 % 2 * 2 - 1, k / 4 * 2 - 1);
        corners.push_back(prop.middle + 0.9 * prop.middle.z * side * glm::dvec3(0.5, 0.5, 1.0));
    }
    return corners;
}

class TwoEyesOf : public ::testing::TestWithParam<GuidanceSetup (*)()> {};
INSTANTIATE_TEST_SUITE_P(EveryProp, TwoEyesOf, ::testing::Values(&frustum_setup, &cube_setup, &wedge_setup));

TEST_P(TwoEyesOf, SeeTheUnionAndAreWholeIfBothAre) {
    const GuidanceSetup setup = GetParam()();
    FaceReader reader(setup);
    const std::vector<glm::dvec3> hull = artifact_in(setup.prop);
    bench::Seeded seeded(31);
    int differ = 0;
    int one_is_whole = 0;
    int both_are_whole = 0;
    for (int k = 0; k < 5000; ++k) {
        const GuidedState both = with_two_eyes(bench::seeded_situation(setup, seeded), seeded);
        const auto [left, right] = each_of(both);
        reader.show(k % 2 == 0 ? std::span(hull) : std::span<const glm::dvec3>());
        const FaceSets l = reader.read(left);
        const FaceSets r = reader.read(right);
        const FaceSets seen = reader.read(both);
        EXPECT_EQ(seen.seen, l.seen | r.seen);
        EXPECT_EQ(seen.lit, l.lit);
        EXPECT_EQ(seen.lit, r.lit);
        EXPECT_EQ(seen.valid(), l.valid() && r.valid());
        EXPECT_EQ(reader.valid(both), l.valid() && r.valid());
        EXPECT_EQ(reader.whole(both), reader.whole(left) && reader.whole(right));
        EXPECT_EQ(reader.unlit_px(both), 0.5 * (reader.unlit_px(left) + reader.unlit_px(right)));
        EXPECT_EQ(reader.lost_px(both), 0.5 * (reader.lost_px(left) + reader.lost_px(right)));
        EXPECT_EQ(reader.unlit_px(both) > 0.0, !seen.valid());
        differ += l.seen != r.seen ? 1 : 0;
        one_is_whole += reader.whole(left) != reader.whole(right) ? 1 : 0;
        both_are_whole += reader.whole(both) ? 1 : 0;
    }
    EXPECT_GT(differ, 50); // all cases occur
    EXPECT_GT(one_is_whole, 20);
    EXPECT_GT(both_are_whole, 20);
}

/// The advice mends both eyes: carried out well, a single move leaves each of them a whole picture; carried out as people do, less is
/// dark.
TEST_P(TwoEyesOf, OneMoveRestoresBothEyes) {
    const FaceReader reader(GetParam()());
    bench::Seeded seeded(32);
    int single = 0;
    int none = 0;
    for (int k = 0; k < 150; ++k) {
        const GuidedState both = with_two_eyes(bench::seeded_situation(reader.setup(), seeded), seeded);
        const auto [left, right] = each_of(both);
        const std::optional<Advice> advice = advise(reader, both);
        EXPECT_EQ(!advice, reader.read(left).valid() && reader.read(right).valid()) << k;
        none += advice ? 0 : 1;
        if (!advice || advice->steps > 1) {
            continue;
        }
        ++single;
        const auto [left_then, right_then] = each_of(after(advice->move, reader.setup(), both));
        EXPECT_TRUE(reader.valid(left_then) && reader.valid(right_then)) << k << name_of(advice->move.action);
        for (int person_k = 0; person_k < 10; ++person_k) {
            const Execution execution = bench::seeded_person(advice->move, reader.setup(), seeded);
            const GuidedState next = after(advice->move, reader.setup(), both, execution);
            EXPECT_TRUE(reader.valid(next) || reader.unlit_px(next) < reader.unlit_px(both)) << k;
        }
    }
    EXPECT_GT(single, 20);
    EXPECT_LT(none, 100);
}

/// A visitor who walks round the table turns with the way: both eyes go about the table's vertical by the same angle.
TEST(TwoEyes, MoveAroundTheTableTogether) {
    const GuidanceSetup setup = frustum_setup();
    GuidedState front;
    front.eye_m = {0.0, -0.6, 0.5};
    front.to_right_eye_m = {0.03, 0.004, -0.008};
    Move walk{Action::ComeRound};
    walk.side = Side::Right; // from -Y to +X: a quarter counter-clockwise
    const GuidedState there = after(walk, setup, front);
    const auto [left, right] = each_of(front);
    const auto [left_there, right_there] = each_of(there);
    const auto turned = [](const glm::dvec3& p) { return glm::dvec3(-p.y, p.x, p.z); };
    EXPECT_LT(glm::distance(left_there.eye_m, turned(left.eye_m)), 1e-15);
    EXPECT_LT(glm::distance(right_there.eye_m, turned(right.eye_m)), 1e-15);
}

TEST(TwoEyes, AreUsedOnlyInStereo) {
    settings::Settings settings;
    tracking::TrackedState state;
    state.eye_m = {0.1, -0.5, 0.4};
    state.table_from_head = glm::angleAxis(0.5 * std::numbers::pi, glm::dvec3(0, 0, 1));
    state.eyes_apart = 0.5;
    EXPECT_EQ(exhibit::guided_state(exhibit::guidance_setup(settings), state).to_right_eye_m,
              glm::dvec3(0.0));
    settings.eye.stereo = settings::Stereo::Anaglyph;
    settings.eye.interocular_mm = 60.0;
    const GuidedState guided = exhibit::guided_state(exhibit::guidance_setup(settings), state);
    EXPECT_EQ(guided.eye_m, state.eye_m);
    EXPECT_LT(glm::distance(guided.to_right_eye_m, glm::dvec3(0.0, 0.015, 0.0)), 1e-15);
    settings.projector.stereo = settings::OutputStereo::Off; // this output shows one picture
    EXPECT_EQ(exhibit::guided_state(exhibit::guidance_setup(settings), state).to_right_eye_m,
              glm::dvec3(0.0));
}

} // namespace
} // namespace frustumscreen::guidance

// Which behaviour plays, which has priority, when each ends; poses against matrices written out.

#include "app/world/curve.h"
#include "app/world/player.h"
#include "tests/render/counted_new.h"
#include "tests/world/some_worlds.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace frustumscreen::world {
namespace {

constexpr double eps = 1e-6; // a curve's floats

double x_of_chest(Player& player, double seconds) {
    return player.step(at_s(seconds))[0].box_from_geometry[3].x;
}

TEST(Player, ShowsRestPosesBeforeAnyStart) {
    Player player(chest(), {slide(), open_lid(), spring_up(), ring()});
    const std::vector<CellPose> rest = poses_at_rest(chest());
    for (const double seconds : {0.0, 1.0, 1e6}) {
        EXPECT_EQ(copy(player.step(at_s(seconds))), rest);
        EXPECT_FALSE(player.moves());
    }
    EXPECT_FALSE(player.is_on(0));
}

TEST(Player, PlaysACurveAndReturnsWithinItsTime) {
    Player player(chest(), {slide()});
    player.start(0, at_s(10.0));
    EXPECT_NEAR(x_of_chest(player, 10.5), 0.25, eps);
    EXPECT_TRUE(player.moves());
    EXPECT_TRUE(player.is_on(0));
    EXPECT_NEAR(x_of_chest(player, 11.999), 0.9995, eps);
    EXPECT_NEAR(x_of_chest(player, 12.0), 1.0, eps);
    EXPECT_FALSE(player.is_on(0));
    EXPECT_NEAR(x_of_chest(player, 12.0 + 0.5 * return_s), 0.5, eps); // half of a smooth step
    EXPECT_TRUE(player.moves());
    EXPECT_EQ(copy(player.step(at_s(12.0 + return_s))), poses_at_rest(chest()));
    EXPECT_FALSE(player.moves());
}

TEST(Player, StayingBehaviourHoldsItsEndUntilTriggeredAgain) {
    Player player(chest(), {open_lid()});
    player.trigger(0, at_s(0.0));
    const std::vector<CellPose> open = copy(player.step(at_s(1.0)));
    EXPECT_EQ(copy(player.step(at_s(3600.0))), open);
    EXPECT_TRUE(player.is_on(0));
    EXPECT_TRUE(player.moves());
    player.trigger(0, at_s(3600.0));
    EXPECT_LT(difference(player.step(at_s(3600.0)), open), eps);
    EXPECT_EQ(copy(player.step(at_s(3600.0 + return_s))), poses_at_rest(chest()));
}

TEST(Player, PosesMatchTheMatrixProducts) {
    Player player(chest(), {open_lid()});
    player.start(0, at_s(0.0));
    const std::span<const CellPose> poses = player.step(at_s(0.5));
    const glm::dmat4 one(1.0);
    const glm::dmat4 lid = glm::translate(one, {0.0, 0.5, 0.4}) * glm::translate(one, {0.1, 0.0, 0.2}) *
                           glm::rotate(one, 0.3, {0.0, 0.0, 1.0}) *
                           glm::rotate(one, std::numbers::pi / 4.0, {1.0, 0.0, 0.0}) *
                           glm::scale(one, {1.0, 2.0, 0.5});
    EXPECT_LT(difference(poses[1].box_from_geometry, lid * glm::scale(one, glm::dvec3(0.8))), eps);
    EXPECT_LT(difference(poses[2].box_from_geometry, lid), eps); // the bell goes with it
    EXPECT_EQ(poses[0].light, glm::vec3(1.0F));
    for (const std::size_t cell : {1, 2}) { // so does the bell's light
        EXPECT_NEAR(poses[cell].light.x, 0.75F, eps);
        EXPECT_NEAR(poses[cell].light.y, 1.5F, eps);
    }
}

TEST(Player, AppliesASpringToTheRestPose) {
    Player player(chest(), {spring_up()});
    player.start(0, at_s(0.0));
    const std::span<const CellPose> poses = player.step(at_s(60.0));
    const glm::dmat4 one(1.0);
    const glm::dmat4 lid = glm::translate(one, {0.0, 0.5, 0.4}) * glm::translate(one, {0.1, 0.0, 0.2}) *
                           glm::rotate(one, 0.3, {0.0, 0.0, 1.0}) * glm::scale(one, {1.0, 2.0, 0.5}) *
                           glm::rotate(one, 1.2, {1.0, 0.0, 0.0});
    EXPECT_LT(difference(poses[2].box_from_geometry, lid), 1e-14);
}

TEST(Player, SpringsOfOneCellAddUp) {
    Behaviour first{.name = "first", .stays = true};
    first.springs.push_back({.cell = 0, .axis = {1.0, 0.0, 0.0}, .reach = 0.3});
    Behaviour second{.name = "second", .stays = true};
    second.springs.push_back({.cell = 0, .axis = {1.0, 0.0, 0.0}, .reach = 0.1});
    Player player(chest(), {first, second});
    player.start(0, at_s(0.0));
    EXPECT_NEAR(x_of_chest(player, 30.0), 0.3, 1e-15);
    player.start(1, at_s(30.0));
    EXPECT_NEAR(x_of_chest(player, 60.0), 0.4, 1e-15);
    player.end(0, at_s(60.0));
    EXPECT_NEAR(x_of_chest(player, 90.0), 0.1, 1e-15);
}

TEST(Player, LatestBehaviourControlsASharedPart) {
    Player player(chest(), {slide(), go_round()});
    player.start(0, at_s(0.0)); // until 2 s
    EXPECT_NEAR(x_of_chest(player, 0.5), 0.25, eps);
    player.start(1, at_s(0.5));
    EXPECT_NEAR(x_of_chest(player, 0.5), 0.25, eps); // comes from where it is
    EXPECT_NEAR(x_of_chest(player, 1.5), std::cos(2.0 * std::numbers::pi / 3.0), eps);
    player.end(1, at_s(1.5)); // and the older one goes on
    EXPECT_NEAR(x_of_chest(player, 1.5), std::cos(2.0 * std::numbers::pi / 3.0), eps);
    player.start(1, at_s(1.6));
    player.end(0, at_s(1.7)); // does not touch the part
    EXPECT_NEAR(x_of_chest(player, 1.6 + 3.0), 1.0, eps);
}

TEST(Player, RestartBeginsFromTheCurrentPose) {
    Player player(chest(), {slide()});
    player.start(0, at_s(0.0));
    player.start(0, at_s(1.0));
    EXPECT_NEAR(x_of_chest(player, 1.0), 0.5, eps);
    EXPECT_NEAR(x_of_chest(player, 2.0), 0.5, eps);
    EXPECT_NEAR(x_of_chest(player, 3.0), 1.0, eps);
}

TEST(Player, LoopKeepsItsPhaseForADay) {
    Player player(chest(), {go_round()});
    player.start(0, at_s(7.0));
    const std::vector<CellPose> once = copy(player.step(at_s(7.0 + 1.234)));
    for (const double rounds : {1.0, 1000.0, 28'800.0}) {
        EXPECT_EQ(copy(player.step(at_s(7.0 + 1.234 + 3.0 * rounds))), once);
    }
}

TEST(Player, RepeatedPushesDoNotWidenTheSwing) {
    Player player(chest(), {ring()});
    player.start(0, at_s(0.0));
    const glm::dmat4 rest = poses_at_rest(chest())[2].box_from_geometry;
    double widest = 0.0;
    for (int k = 0; k < 50'000; ++k) {
        const glm::dmat4 motion = glm::inverse(rest) * player.step(at_s(0.013 * k))[2].box_from_geometry;
        widest = std::fmax(widest, std::abs(std::atan2(motion[2].x, motion[0].x)));
    }
    EXPECT_GT(widest, 0.29);
    // A push has the energy of a first swing without damping, which is a little wider than 0.3.
    EXPECT_LT(widest, 0.33);
}

TEST(Player, EndAllComesToRestEvenWithoutDamping) {
    Behaviour swing{.name = "swing", .seconds = 10.0, .repeats = true};
    swing.pendulums.push_back({.cell = 2, .angle_rad = 0.3, .length_m = 0.2, .damping_per_s = 0.0});
    Player player(chest(), {slide(), open_lid(), spring_up(), swing});
    for (std::size_t k = 0; k < 4; ++k) {
        player.start(k, at_s(0.1 * static_cast<double>(k)));
    }
    player.end_all(at_s(1.0));
    (void)player.step(at_s(1.1));
    EXPECT_TRUE(player.moves());
    EXPECT_EQ(copy(player.step(at_s(200.0))), poses_at_rest(chest()));
    EXPECT_FALSE(player.moves());
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_FALSE(player.is_on(k));
    }
}

TEST(Player, PosesAtATimeMatchTheCurves) {
    const std::vector<Cell> cells = chest();
    Behaviour jumps = slide(); // its first key is not where the cell rests
    jumps.channels[0].curve.values[0] = {5.0F, 0.0F, 0.0F, 0.0F};
    EXPECT_NEAR(poses_at(cells, jumps, 0.0)[0].box_from_geometry[3].x, 5.0, eps);
    EXPECT_NEAR(poses_at(cells, jumps, 0.5)[0].box_from_geometry[3].x, 4.0, eps);
    EXPECT_NEAR(poses_at(cells, jumps, 2.0)[0].box_from_geometry[3].x, 1.0, eps);
    EXPECT_EQ(poses_at(cells, jumps, 3.0), poses_at_rest(cells));
    EXPECT_NEAR(poses_at(cells, jumps, -1.0)[0].box_from_geometry[3].x, 5.0, eps);
}

TEST(Player, AcceptsEmptyBehaviours) {
    Player player(chest(), {Behaviour{.name = "nothing"}, Behaviour{.name = "loop", .repeats = true}});
    player.trigger(0, at_s(0.0));
    player.trigger(1, at_s(0.0));
    EXPECT_EQ(copy(player.step(at_s(1.0))), poses_at_rest(chest()));
    EXPECT_FALSE(player.is_on(0));
    Player empty({}, {});
    EXPECT_TRUE(empty.step(at_s(1.0)).empty());
}

TEST(Player, AllocatesNothingAfterItsConstructor) {
    Player player(chest(), {slide(), open_lid(), go_round(), spring_up(), ring()});
    const long before = synthetic::allocations_so_far();
    for (int k = 0; k < 500; ++k) {
        player.trigger(static_cast<std::size_t>(k % 5), at_s(0.1 * k));
        (void)player.step(at_s(0.1 * k + 0.05));
    }
    player.end_all(at_s(51.0));
    EXPECT_EQ(synthetic::allocations_so_far(), before);
}

} // namespace
} // namespace frustumscreen::world

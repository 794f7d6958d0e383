#include "firmware_host/window/mouse_hand.h"

#include <gtest/gtest.h>

namespace frustumscreen::window {
namespace {

TEST(MouseHand, SlidesThePropWithoutAJumpWhenTaken) {
    MouseHand hand({0.3, 0.2});
    hand.move({0.2, 0.1});
    EXPECT_EQ(hand.prop({}).position_m, glm::dvec3(0.0)) << "not held";
    hand.take({0.05, 0.02});
    EXPECT_EQ(hand.prop({}).position_m, glm::dvec3(0.0));
    hand.move({0.15, 0.02});
    EXPECT_NEAR(hand.prop({}).position_m.x, 0.10, 1e-12);
    EXPECT_NEAR(hand.prop({}).position_m.y, 0.0, 1e-12);
    hand.let_go();
    hand.move({0.0, 0.0});
    EXPECT_NEAR(hand.prop({}).position_m.x, 0.10, 1e-12);
}

TEST(MouseHand, StaysOnTheTable) {
    MouseHand hand({0.3, 0.2});
    hand.take({0.0, 0.0});
    hand.move({5.0, -5.0});
    EXPECT_EQ(hand.prop({}).position_m, glm::dvec3(0.3, -0.2, 0.0));
}

TEST(MouseHand, TurnsAboutTheVertical) {
    MouseHand hand({0.3, 0.2});
    hand.turn(glm::half_pi<double>());
    const glm::dvec3 front = hand.prop({}).rotation * glm::dvec3(1.0, 0.0, 0.0);
    EXPECT_NEAR(front.y, 1.0, 1e-12);
}

TEST(MouseHand, MovesTheEyeAroundTheTable) {
    MouseHand hand({0.3, 0.2}, {0.0, -0.6, 0.6});
    EXPECT_EQ(hand.head({}).station, tracker::head_station);
    EXPECT_NEAR(glm::distance(hand.head({}).position_m, {0.0, -0.6, 0.6}), 0.0, 1e-12);
    hand.look(glm::half_pi<double>(), 0.0);
    EXPECT_NEAR(glm::distance(hand.head({}).position_m, {0.6, 0.0, 0.6}), 0.0, 1e-12);
    for (const double up : {9.0, -9.0}) { // never below the table, never over the pole
        hand.look(0.0, up);
        const glm::dvec3 eye = hand.head({}).position_m;
        EXPECT_GT(eye.z, 0.05);
        EXPECT_GT(eye.x, 0.05);
    }
}

TEST(MouseHand, TurnsTheHeadLevelToTheProp) {
    MouseHand hand({0.3, 0.2}, {0.0, -0.6, 0.6});
    EXPECT_LT(glm::distance(hand.head({}).rotation * glm::dvec3(1, 0, 0), glm::dvec3(1, 0, 0)), 1e-12);
    hand.look(glm::half_pi<double>(), 0.1); // to the table's right: the right eye is on the far side
    EXPECT_LT(glm::distance(hand.head({}).rotation * glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)), 1e-12);
    hand.take({0.0, 0.0});
    hand.move({0.1, -0.15});
    const tracker::PoseSample head = hand.head({});
    const glm::dvec3 ahead = hand.prop({}).position_m - head.position_m;
    const glm::dvec3 seen = glm::conjugate(head.rotation) * ahead;
    EXPECT_NEAR(seen.x, 0.0, 1e-12);
    EXPECT_GT(seen.y, 0.0);
}

} // namespace
} // namespace frustumscreen::window

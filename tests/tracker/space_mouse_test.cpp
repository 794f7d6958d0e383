#include "firmware_host/tracker/space_mouse_session.h"
#include "tests/tracker/wire_bytes.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <random>

namespace frustumscreen::tracker {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr glm::dvec2 table_half(0.4, 0.25);
const MonotonicTime start = from_microseconds(5'000'000);

/// Plays reports at given times, with polls at `rhythm`.
std::vector<PoseSample> play(const std::vector<std::pair<Nanoseconds, wire::Wire>>& reports,
                             Nanoseconds length, Nanoseconds rhythm) {
    SpaceMouseSession session(table_half);
    std::vector<PoseSample> samples;
    session.receive({}, start, samples);
    Nanoseconds polled = rhythm;
    for (const auto& [time, report] : reports) {
        for (; polled < time; polled += rhythm) {
            session.receive({}, start + polled, samples);
        }
        session.receive(report, start + time, samples);
    }
    for (; polled < length; polled += rhythm) {
        session.receive({}, start + polled, samples);
    }
    session.receive({}, start + length, samples);
    return samples;
}

std::vector<std::pair<Nanoseconds, wire::Wire>> held(unsigned id, std::array<std::int16_t, 3> axes,
                                                     Nanoseconds length) {
    std::vector<std::pair<Nanoseconds, wire::Wire>> reports;
    for (Nanoseconds time{0}; time < length; time += milliseconds(8)) {
        reports.emplace_back(time, wire::space_mouse(id, axes));
    }
    reports.emplace_back(length, wire::space_mouse(id, {0, 0, 0}));
    return reports;
}

TEST(SpaceMouseCodec, ReadsBothReportFormatsInTableAxes) {
    // 100 to the right, 50 towards the user, 20 pressed down
    const auto push = std::get<SpaceMouseMotion>(parse_space_mouse(wire::from_hex("01 6400 3200 1400")));
    EXPECT_EQ(push.push, glm::dvec3(100, -50, -20));
    EXPECT_FALSE(push.turn);
    const auto turn = std::get<SpaceMouseMotion>(parse_space_mouse(wire::from_hex("02 9CFF 0000 5E01")));
    EXPECT_EQ(turn.turn, glm::dvec3(-100, 0, -350));
    EXPECT_FALSE(turn.push);
    const auto both =
        std::get<SpaceMouseMotion>(parse_space_mouse(wire::from_hex("01 0100 0200 0300 0400 0500 0600")));
    EXPECT_EQ(both.push, glm::dvec3(1, -2, -3));
    EXPECT_EQ(both.turn, glm::dvec3(4, -5, -6));
}

TEST(SpaceMouseCodec, IgnoresButtonsAndBatteryAndRejectsOtherLengths) {
    EXPECT_TRUE(std::holds_alternative<SpaceMouseOther>(parse_space_mouse(wire::from_hex("03 0100"))));
    EXPECT_TRUE(std::holds_alternative<SpaceMouseOther>(parse_space_mouse(wire::from_hex("17 64"))));
    EXPECT_EQ(std::get<DiscardReason>(parse_space_mouse({})), DiscardReason::Length);
    const wire::Wire both = wire::from_hex("01 0100 0200 0300 0400 0500 0600");
    for (std::size_t length = 1; length < both.size(); ++length) {
        const auto message = parse_space_mouse(std::span(both).first(length));
        EXPECT_EQ(std::holds_alternative<DiscardReason>(message), length != 7) << length;
    }
    EXPECT_EQ(std::get<DiscardReason>(parse_space_mouse(wire::from_hex("02 0100 0200 0300 04"))),
              DiscardReason::Length);
}

TEST(SpaceMouse, FullDeflectionMovesAtTheStatedSpeed) {
    const auto samples = play(held(1, {0, -350, 0}, milliseconds(800)), milliseconds(1200), milliseconds(20));
    EXPECT_LT(glm::distance(samples.back().position_m,
                            glm::dvec3(0.0, 0.8 * SpaceMouseSession::full_push_m_per_s, 0.0)),
              1e-12);
    const auto turned = play(held(2, {0, 0, -350}, milliseconds(800)), milliseconds(1200), milliseconds(20));
    const glm::dquat about_z =
        glm::angleAxis(0.8 * SpaceMouseSession::full_turn_rad_per_s, glm::dvec3(0, 0, 1));
    EXPECT_LT(glm::length(turned.back().rotation - about_z), 1e-12);
    EXPECT_EQ(turned.back().position_m, glm::dvec3(0.0));
}

TEST(SpaceMouse, StaysWithinTheTableAndTheHeightLimits) {
    const auto samples =
        play(held(1, {-350, 350, -350}, std::chrono::seconds(5)), std::chrono::seconds(5), milliseconds(20));
    EXPECT_EQ(samples.back().position_m,
              glm::dvec3(-table_half.x, -table_half.y, SpaceMouseSession::highest_m));
    const auto down = play(held(1, {0, 0, 350}, milliseconds(500)), milliseconds(500), milliseconds(20));
    EXPECT_EQ(down.back().position_m, glm::dvec3(0.0));
}

TEST(SpaceMouse, IgnoresTheDeadZone) {
    const auto samples = play(held(1, {15, -15, 15}, milliseconds(500)), milliseconds(500), milliseconds(20));
    EXPECT_EQ(samples.back().position_m, glm::dvec3(0.0));
    const auto beyond = play(held(1, {16, 0, 0}, milliseconds(500)), milliseconds(600), milliseconds(20));
    EXPECT_NEAR(beyond.back().position_m.x, 0.5 * SpaceMouseSession::full_push_m_per_s / 335.0, 1e-12);
}

TEST(SpaceMouse, StopsThePropWhenReportsCease) {
    const auto samples =
        play({{Nanoseconds(0), wire::space_mouse(1, {350, 0, 0})}}, milliseconds(2000), milliseconds(20));
    EXPECT_NEAR(samples.back().position_m.x, 0.1 * SpaceMouseSession::full_push_m_per_s, 1e-12);
}

TEST(SpaceMouse, SamplesAreRegularAndDoNotDependOnThePollTimes) {
    std::mt19937 engine(4);
    std::vector<std::pair<Nanoseconds, wire::Wire>> reports;
    for (Nanoseconds time{0}; time < milliseconds(3000); time += microseconds(2000 + engine() % 20'000)) {
        const auto axis = [&] { return static_cast<std::int16_t>(static_cast<int>(engine() % 701) - 350); };
        reports.emplace_back(time, wire::space_mouse(1 + engine() % 2, {axis(), axis(), axis()}));
    }
    const auto often = play(reports, milliseconds(3800), microseconds(700));
    const auto seldom = play(reports, milliseconds(3800), milliseconds(333));
    ASSERT_EQ(often.size(), 1U + 3800U / 8U);
    ASSERT_EQ(seldom.size(), often.size());
    for (std::size_t k = 0; k < often.size(); ++k) {
        EXPECT_EQ(often[k].time, start + k * SpaceMouseSession::sample_period);
        EXPECT_EQ(often[k].time, seldom[k].time);
        EXPECT_EQ(often[k].position_m, seldom[k].position_m);
        EXPECT_EQ(often[k].rotation, seldom[k].rotation);
    }
}

/// Compares with a product of many small rotations about the reports' axes.
TEST(SpaceMouse, TurnsAboutChangingAxesAreIntegratedExactly) {
    const std::vector<std::array<std::int16_t, 3>> axes{{350, 0, 0}, {0, 200, -100}, {-120, 60, 350}};
    std::vector<std::pair<Nanoseconds, wire::Wire>> reports;
    for (int k = 0; k < 60; ++k) {
        reports.emplace_back(milliseconds(10 * k),
                             wire::space_mouse(2, axes[static_cast<std::size_t>(k) % 3]));
    }
    reports.emplace_back(milliseconds(600), wire::space_mouse(2, {0, 0, 0}));
    const auto samples = play(reports, milliseconds(608), milliseconds(20));
    glm::dmat3 turned(1.0);
    constexpr int small_steps = 2000;
    const auto share = [](int counts) {
        const double beyond = std::max(std::abs(counts) - 15, 0) / 335.0;
        return counts < 0 ? -beyond : beyond;
    };
    for (int k = 0; k < 60; ++k) {
        const auto& wire_axes = axes[static_cast<std::size_t>(k) % 3];
        const glm::dvec3 rate =
            1.5 * glm::dvec3(share(wire_axes[0]), -share(wire_axes[1]), -share(wire_axes[2]));
        const double dt = 0.010 / small_steps;
        const glm::dmat3 cross(0, rate.z, -rate.y, -rate.z, 0, rate.x, rate.y, -rate.x, 0);
        for (int step = 0; step < small_steps; ++step) { // second order of the exponential
            turned = turned + dt * cross * turned + 0.5 * dt * dt * cross * (cross * turned);
        }
    }
    const glm::dmat3 found = glm::mat3_cast(samples.back().rotation);
    for (int column = 0; column < 3; ++column) {
        EXPECT_LT(glm::distance(found[column], turned[column]), 1e-9);
    }
}

TEST(SpaceMouse, InventsNoSamplesAfterSuspend) {
    SpaceMouseSession session(table_half);
    std::vector<PoseSample> samples;
    session.receive(wire::space_mouse(1, {350, 0, 0}), start, samples);
    session.receive({}, start + std::chrono::hours(9), samples);
    EXPECT_EQ(samples.size(), 2U);
    EXPECT_EQ(samples.back().position_m, glm::dvec3(0.0));
}

} // namespace
} // namespace frustumscreen::tracker

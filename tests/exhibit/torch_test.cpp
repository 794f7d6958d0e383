// Torches in the exhibit: where their beams go, what they throw, what is left on, and what visitors are told; in simulated
// time.
#include "app/tracking/pose_math.h"
#include "tests/exhibit/exhibits.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::exhibit {
namespace {

using settings::Command;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr double pi = std::numbers::pi;

/// At a place, its light along a direction, +Y down.
geometry::RigidTransform torch_at(const glm::dvec3& place_m, const glm::dvec3& towards_m) {
    const glm::dvec3 z = glm::normalize(towards_m - place_m);
    const glm::dvec3 x = glm::normalize(glm::cross(z, glm::dvec3(0.01, 0.02, 1.0)));
    return {glm::normalize(glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z))), place_m};
}

torch::Beam beam_of(double opening_deg) {
    torch::Beam beam;
    beam.opening_rad = glm::radians(opening_deg);
    return beam;
}

TEST(TorchAimOf, LightsExactlyWhileTheBeamMeetsTheSphere) {
    const LitObject object{{0.1, -0.05, 0.07}, 0.08};
    const torch::Beam beam = beam_of(20.0);
    const glm::dvec3 from(0.4, -0.3, 0.3);
    const double touches =
        std::asin(object.radius_m / glm::distance(from, object.centre_m)) + glm::radians(10.0);
    const geometry::RigidTransform at = torch_at(from, object.centre_m);
    for (int side = 0; side < 12; ++side) {
        const double around = side * pi / 6.0;
        const auto turned = [&](double by) {
            return geometry::RigidTransform{
                at.rotation * tracking::rotation_of({by * std::cos(around), by * std::sin(around), 0.0}),
                from};
        };
        EXPECT_EQ(aim_of(beam, turned(touches - 1e-6), object), TorchAim::Lights);
        EXPECT_EQ(aim_of(beam, turned(touches + 1e-6), object), TorchAim::Past);
        EXPECT_EQ(aim_of(beam, turned(pi - 0.1), object), TorchAim::Past); // behind it
    }
    EXPECT_EQ(aim_of(beam, torch_at(object.centre_m + glm::dvec3(0.0, 0.0, 0.05), from), object),
              TorchAim::Lights);
}

TEST(TorchAimOf, IsTooFarBeyondTheReach) {
    torch::Beam beam = beam_of(20.0);
    beam.attenuation = torch::Attenuation::None;
    const LitObject object{{0.0, 0.0, 0.0}, 0.1};
    EXPECT_EQ(aim_of(beam, torch_at({0.0, -90.0, 0.1}, object.centre_m), object), TorchAim::Lights);
    beam.attenuation = torch::Attenuation::Linear;
    const double reach = torch::reach_m(beam);
    EXPECT_EQ(aim_of(beam, torch_at({0.0, -reach - 0.099, 0.0}, object.centre_m), object), TorchAim::Lights);
    EXPECT_EQ(aim_of(beam, torch_at({0.0, -reach - 0.101, 0.0}, object.centre_m), object), TorchAim::TooFar);
}

TEST(TorchAdvice, AppearsAfterADelayAndDisappearsAtOnce) {
    TorchAdvice advice;
    MonotonicTime now = sample::start;
    EXPECT_FALSE(advice.step(now, TorchAim::Past));
    now += TorchAdvice::dwell - milliseconds(1);
    EXPECT_FALSE(advice.step(now, TorchAim::TooFar)); // whatever it is that lights nothing
    now += milliseconds(1);
    EXPECT_EQ(advice.step(now, TorchAim::Past), TorchAim::Past);
    now += milliseconds(20);
    EXPECT_EQ(advice.step(now, TorchAim::TooFar), TorchAim::TooFar);
    EXPECT_FALSE(advice.step(now + milliseconds(20), TorchAim::Lights));
    EXPECT_FALSE(advice.step(now + milliseconds(40), TorchAim::Past));
    EXPECT_FALSE(advice.step(now + seconds(60), std::nullopt)); // laid down
    EXPECT_FALSE(advice.step(now + seconds(61), TorchAim::Past));
}

/// Every edge ray of the beam meets the table on the ellipse.
TEST(TorchSpotOnTable, IsTheEllipseOfTheBeamsEdge) {
    int looked_at = 0;
    for (const double opening : {8.0, 24.0, 60.0}) {
        for (const glm::dvec3& towards :
             {glm::dvec3(0.1, 0.1, 0.0), glm::dvec3(-0.2, 0.05, 0.0), glm::dvec3(0.3, -0.2, 0.0)}) {
            const geometry::RigidTransform at = torch_at({0.3, -0.2, 0.4}, towards);
            const std::optional<TorchSpot> spot = spot_on_table(beam_of(opening), at);
            ASSERT_TRUE(spot);
            const glm::dvec2 across(spot->along.y, -spot->along.x);
            for (int k = 0; k < 360; k += 15, ++looked_at) {
                const double half = glm::radians(0.5 * opening);
                const double around = glm::radians(static_cast<double>(k));
                const glm::dvec3 ray = at.direction(
                    {std::sin(half) * std::cos(around), std::sin(half) * std::sin(around), std::cos(half)});
                ASSERT_LT(ray.z, 0.0);
                const glm::dvec2 off =
                    glm::dvec2(at.translation + ray * (at.translation.z / -ray.z)) - spot->centre_m;
                EXPECT_NEAR(std::hypot(glm::dot(off, spot->along) / spot->half_along_m,
                                       glm::dot(off, across) / spot->half_across_m),
                            1.0, 1e-9);
            }
            for (const glm::dvec2& corner : spot->corners()) {
                EXPECT_NEAR(glm::distance(corner, spot->centre_m),
                            std::hypot(spot->half_along_m, spot->half_across_m), 1e-12);
            }
        }
    }
    EXPECT_EQ(looked_at, 3 * 3 * 24);
}

TEST(TorchSpotOnTable, FadesOutBeforeTheBeamLeavesTheTable) {
    double before = -1.0;
    for (double descent = 1.2; descent > -0.5; descent -= 0.002) {
        const geometry::RigidTransform at =
            torch_at({0.0, 0.0, 0.2}, {0.0, std::cos(descent), 0.2 - std::sin(descent)});
        const std::optional<TorchSpot> spot = spot_on_table(beam_of(24.0), at);
        const double share = spot ? spot->share : 0.0;
        EXPECT_LT(before < 0.0 ? 0.0 : std::fabs(share - before), 0.03) << descent;
        before = share;
    }
    EXPECT_EQ(before, 0.0);
    EXPECT_FALSE(spot_on_table(beam_of(24.0), torch_at({0.0, 0.0, -0.1}, {0.0, 0.0, -1.0})));
}

/// The rules of lights, with two torches.
struct Lights {
    static TorchPlace place() {
        return {.beam = beam_of(24.0),
                .min_opening_rad = glm::radians(8.0),
                .max_opening_rad = glm::radians(60.0),
                .house_light = 0.4};
    }
    Lights() {
        state.torches[0].table_from_torch = torch_at({0.3, -0.2, 0.3}, {0.0, 0.0, 0.05});
        state.torches[1].table_from_torch = torch_at({-0.3, -0.2, 0.3}, {0.0, 0.0, 0.05});
        state.torches[0].share = 1.0;
    }

    PresentedTorches step(Nanoseconds later = milliseconds(20)) {
        now += later;
        const TorchLights::Input input{.tracked_state = state,
                                       .table_from_prop = table_from_prop,
                                       .artifact = artifact,
                                       .contents = contents,
                                       .object = {{0.0, 0.0, 0.05}, 0.08},
                                       .light = light,
                                       .next = next,
                                       .leave = leave,
                                       .gone = gone};
        next = leave = false;
        return torches.step(now, input);
    }
    PresentedTorches after(Nanoseconds time) {
        for (const MonotonicTime end = now + time - milliseconds(20); now < end;) {
            (void)step();
        }
        return step();
    }

    TorchLights torches{place()};
    tracking::TrackedState state;
    geometry::RigidTransform table_from_prop;
    MonotonicTime now = sample::start;
    std::size_t artifact = 0, contents = 2;
    double light = 1.0;
    bool next = false, leave = false, gone = false;
};

TEST(TorchLights, AbsentWithoutATorch) {
    Lights lights;
    lights.state.torches[0].share = 0.0;
    const PresentedTorches presented = lights.step();
    EXPECT_TRUE(presented.lights().empty());
    EXPECT_EQ(presented.house_light, 1.0);
    EXPECT_FALSE(lights.torches.held());
    EXPECT_FALSE(lights.torches.aim());
}

TEST(TorchLights, BeginWithTheFirstContentAndFollowTheShare) {
    Lights lights;
    for (const double share : {0.25, 0.5, 1.0}) {
        lights.state.torches[0].share = share;
        const PresentedTorches presented = lights.step();
        ASSERT_EQ(presented.lights().size(), 1U);
        EXPECT_EQ(presented.lights()[0].content, std::optional<std::size_t>(0));
        EXPECT_DOUBLE_EQ(presented.lights()[0].brightness, share);
        EXPECT_DOUBLE_EQ(presented.house_light, 1.0 - 0.6 * share);
        EXPECT_DOUBLE_EQ(presented.lights()[0].opening_rad, glm::radians(24.0));
    }
    EXPECT_TRUE(lights.torches.held());
    EXPECT_EQ(lights.torches.aim(), TorchAim::Lights);
}

TEST(TorchLights, CycleThroughContentsAndPlainLightWithAFade) {
    Lights lights;
    (void)lights.after(seconds(2));
    for (const std::optional<std::size_t> expected :
         {std::optional<std::size_t>(1), std::optional<std::size_t>(), std::optional<std::size_t>(0)}) {
        lights.next = true;
        double darkest = 1.0;
        double jump = 0.0, before = 1.0;
        double seconds_thrown = 0.0;
        std::optional<std::size_t> thrown;
        for (int k = 0; k < 40; ++k) {
            const PresentedTorches presented = lights.step(milliseconds(10));
            const double brightness = presented.lights().empty() ? 0.0 : presented.lights()[0].brightness;
            darkest = std::min(darkest, brightness);
            jump = std::max(jump, std::fabs(brightness - before));
            before = brightness;
            if (!presented.lights().empty()) {
                thrown = presented.lights()[0].content;
                seconds_thrown = presented.lights()[0].seconds;
            }
        }
        EXPECT_EQ(thrown, expected);
        EXPECT_LT(darkest, 0.02);
        EXPECT_LE(jump, 1.5 * 10.0 / 150.0 + 1e-9);
        EXPECT_EQ(before, 1.0);
        EXPECT_NEAR(seconds_thrown, 0.25, 0.02); // since it came, not since it was asked for
        EXPECT_EQ(lights.torches.content(), expected);
    }
    lights.contents = 0;
    lights.next = true;
    const PresentedTorches plain = lights.after(seconds(1));
    ASSERT_EQ(plain.lights().size(), 1U);
    EXPECT_FALSE(plain.lights()[0].content);
}

TEST(TorchLights, ChangeTheLastTakenTorchAndDifferInColour) {
    Lights lights;
    (void)lights.step();
    lights.state.torches[1].share = 1.0;
    (void)lights.step();
    lights.next = true;
    const PresentedTorches presented = lights.after(seconds(1));
    ASSERT_EQ(presented.lights().size(), 2U);
    EXPECT_EQ(presented.lights()[0].content, std::optional<std::size_t>(0));
    EXPECT_EQ(presented.lights()[1].content, std::optional<std::size_t>(1));
    EXPECT_NE(torch_colours.at(presented.lights()[0].colour), torch_colours.at(presented.lights()[1].colour));
    lights.state.torches[1].share = 0.0; // laid down: the other one is in a hand
    (void)lights.step();
    EXPECT_EQ(lights.torches.content(), std::optional<std::size_t>(0));
}

TEST(TorchLights, LeftLightsStayOnTheObject) {
    Lights lights;
    (void)lights.step();
    lights.leave = true;
    (void)lights.step();
    const geometry::RigidTransform prop_from_torch = lights.state.torches[0].table_from_torch;
    lights.state.torches[0].table_from_torch = torch_at({0.1, 0.3, 0.3}, {0.0, 0.0, 0.05});
    lights.table_from_prop = {tracking::rotation_of({0.0, 0.0, 1.1}), {0.05, -0.1, 0.0}};
    const PresentedTorches presented = lights.after(seconds(1));
    ASSERT_EQ(presented.lights().size(), 2U);
    const PresentedLight& left = presented.lights()[1];
    EXPECT_TRUE(left.left);
    EXPECT_FALSE(presented.lights()[0].left);
    EXPECT_EQ(left.brightness, 1.0);
    const geometry::RigidTransform expected = lights.table_from_prop * prop_from_torch;
    EXPECT_LT(glm::distance(left.table_from_torch.translation, expected.translation), 1e-12);
    EXPECT_LT(glm::length(tracking::step_between(left.table_from_torch, expected).turn_rad), 1e-9);
    // The torch is laid down: what it left stays, and the artifact has all its light.
    lights.state.torches[0].share = 0.0;
    const PresentedTorches alone = lights.after(seconds(30));
    ASSERT_EQ(alone.lights().size(), 1U);
    EXPECT_EQ(alone.house_light, 1.0);
    // The visitor goes: it goes softly.
    lights.gone = true;
    EXPECT_EQ(lights.after(milliseconds(500)).lights().size(), 1U);
    EXPECT_TRUE(lights.after(milliseconds(700)).lights().empty());
    lights.gone = false;
    EXPECT_TRUE(lights.after(seconds(1)).lights().empty());
}

TEST(TorchLights, KeepOnlyTheTwoNewestLeftLights) {
    Lights lights;
    std::array<glm::dvec3, 3> places{};
    for (std::size_t k = 0; k < places.size(); ++k) {
        places.at(k) = {0.2 + 0.05 * static_cast<double>(k), -0.2, 0.3};
        lights.state.torches[0].table_from_torch = torch_at(places.at(k), {0.0, 0.0, 0.05});
        (void)lights.step();
        lights.leave = true;
        (void)lights.step();
    }
    const PresentedTorches presented = lights.after(seconds(1));
    ASSERT_EQ(presented.lights().size(), 3U);
    std::array<double, 2> x{presented.lights()[1].table_from_torch.translation.x,
                            presented.lights()[2].table_from_torch.translation.x};
    std::sort(x.begin(), x.end());
    EXPECT_NEAR(x[0], places[1].x, 1e-12);
    EXPECT_NEAR(x[1], places[2].x, 1e-12);
    lights.artifact = 1; // with another artifact they go
    EXPECT_EQ(lights.step().lights().size(), 1U);
}

TEST(TorchLights, DoNotLeaveALightThatMissesTheObject) {
    Lights lights;
    lights.state.torches[0].table_from_torch = torch_at({0.3, -0.2, 0.3}, {1.0, 0.0, 0.0});
    (void)lights.step();
    EXPECT_EQ(lights.torches.aim(), TorchAim::Past);
    lights.leave = true;
    (void)lights.step();
    EXPECT_EQ(lights.after(seconds(1)).lights().size(), 1U);
}

/// However many torches and left lights there are, the renderer has places for all.
TEST(TorchLights, NeverExceedTheRenderersLimitNorAllocate) {
    Lights lights;
    lights.state.torches[1].share = 1.0;
    (void)lights.step();
    const long before = synthetic::allocations_so_far();
    std::size_t most = 0;
    for (int k = 0; k < 100; ++k) {
        lights.leave = k % 10 == 0;
        lights.next = k % 7 == 0;
        most = std::max(most, lights.step().lights().size());
    }
    EXPECT_EQ(synthetic::allocations_so_far(), before);
    EXPECT_EQ(most, torch::max_torches);
}

class TorchExhibit : public ::testing::Test {
protected:
    static Exhibit make(std::size_t contents, std::size_t buttons = 6) {
        const std::vector<std::string> languages{"en", "de"};
        CatalogueEntry entry{languages, {languages.size(), {{0.2, 0.05}, {0.1, 0.1}}}};
        entry.behaviours = {{.trigger = world::Trigger::Button, .title_sizes_m = {{0.1, 0.02}, {0.1, 0.02}}}};
        entry.content_title_sizes_m.assign(contents, {{0.08, 0.015}, {0.0, 0.0}});
        ExhibitPlace place = sample::shipped_place();
        place.words = {sample::words_of("de", {"point_lamp", "lamp_closer"}),
                       sample::words_of("en", {"point_lamp", "lamp_closer"})};
        place.buttons = buttons;
        place.torch = Lights::place();
        return {Catalogue(2, entry), place, "en", sample::start};
    }
    void SetUp() override {
        state = sample::tracked_state(now);
        state.torches[0] = {torch_at({0.3, -0.2, 0.3}, {0.0, 0.0, 0.05}), 1.0};
    }
    Presentation run(Nanoseconds time, std::vector<Command> commands = {}) {
        Presentation shown;
        const MonotonicTime end = now + time;
        do {
            now += milliseconds(20);
            state.time = now;
            shown = exhibit.step(now, commands, state);
            commands.clear();
        } while (now < end);
        return shown;
    }
    [[nodiscard]] std::string words(const Presentation& shown) const {
        return shown.advice ? keys.at(shown.advice->word.text) : "";
    }

    std::vector<std::string> keys{"point_lamp", "lamp_closer"};
    MonotonicTime now = sample::start;
    tracking::TrackedState state;
    Exhibit exhibit = make(2);
};

TEST_F(TorchExhibit, TakenTorchCountsAsAVisitor) {
    state.torches[0].share = 0.0;
    EXPECT_EQ(run(seconds(2)).state, State::Attract);
    state.torches[0].share = 1.0;
    EXPECT_EQ(run(milliseconds(100)).state, State::View);
}

TEST_F(TorchExhibit, ChooseChangesTheContentAndBehaviourLeavesTheLight) {
    Presentation shown = run(seconds(3), {Command::NextLanguage, Command::NextLanguage});
    ASSERT_EQ(shown.torches.lights().size(), 1U);
    EXPECT_EQ(shown.torches.lights()[0].content, std::optional<std::size_t>(0));
    EXPECT_NE(shown.lamps & (1U << 3U), 0U);
    EXPECT_NE(shown.lamps & (1U << 5U), 0U);
    shown = run(seconds(1), {Command::Choose});
    EXPECT_EQ(shown.torches.lights()[0].content, std::optional<std::size_t>(1));
    EXPECT_NE(shown.state, State::Describe) << "the press was the torch's";
    shown = run(seconds(1), {Command::Behaviour});
    EXPECT_EQ(shown.torches.lights().size(), 2U);
    EXPECT_TRUE(shown.behaviours.events().empty());
}

TEST_F(TorchExhibit, BehaviourButtonKeepsItsMeaningWithoutATorch) {
    state.torches[0].share = 0.0;
    (void)run(seconds(3), {Command::NextLanguage, Command::NextLanguage});
    Presentation first = exhibit.step(now += milliseconds(20), std::vector{Command::Behaviour}, state);
    EXPECT_EQ(first.behaviours.events().size(), 1U);
    EXPECT_TRUE(run(seconds(1)).torches.lights().empty());
}

TEST_F(TorchExhibit, ContentTitleReplacesTheBehaviourTitle) {
    Presentation shown = run(seconds(5), {Command::NextLanguage, Command::NextLanguage});
    ASSERT_TRUE(shown.title);
    EXPECT_EQ(shown.title->title.behaviour, 1U); // behind the one behaviour
    shown = run(seconds(5), {Command::Choose});
    ASSERT_TRUE(shown.title);
    EXPECT_EQ(shown.title->title.behaviour, 2U);
    shown = run(seconds(5), {Command::Choose}); // plain light has none
    EXPECT_FALSE(shown.title);
    state.torches[0].share = 0.0;
    shown = run(seconds(5));
    ASSERT_TRUE(shown.title);
    EXPECT_EQ(shown.title->title.behaviour, 0U);
}

TEST_F(TorchExhibit, AdvisesWhenTheTorchMissesTheObject) {
    (void)run(seconds(3), {Command::NextLanguage, Command::NextLanguage});
    EXPECT_EQ(words(run(seconds(10))), "");
    state.torches[0].table_from_torch = torch_at({0.3, -0.2, 0.3}, {2.0, -0.4, 0.0});
    EXPECT_EQ(words(run(seconds(3))), "");
    const Presentation told = run(seconds(3));
    EXPECT_EQ(words(told), "point_lamp");
    EXPECT_EQ(told.state, State::View);
    EXPECT_FALSE(told.says);
    state.torches[0].table_from_torch = torch_at({0.3, -0.2, 0.3}, {0.0, 0.0, 0.05});
    EXPECT_EQ(words(run(seconds(2))), "");
    state.torches[0].table_from_torch = torch_at({0.0, -4.5, 0.6}, {0.0, 0.0, 0.05});
    EXPECT_EQ(words(run(seconds(7))), "lamp_closer");
    state.torches[0].share = 0.0; // laid down
    EXPECT_EQ(words(run(seconds(2))), "");
}

TEST_F(TorchExhibit, RemovesLeftLightsWithoutAVisitor) {
    (void)run(seconds(3), {Command::NextLanguage});
    (void)run(seconds(1), {Command::Behaviour});
    state.torches[0].share = 0.0;
    EXPECT_EQ(run(seconds(5)).torches.lights().size(), 1U);
    const Presentation gone = run(seconds(65));
    EXPECT_EQ(gone.state, State::Attract);
    EXPECT_TRUE(gone.torches.lights().empty());
}

TEST_F(TorchExhibit, DimsTheArtifactWhileATorchIsHeld) {
    Presentation shown = run(seconds(3), {Command::NextLanguage});
    EXPECT_NEAR(shown.brightness, 0.4, 1e-9);
    EXPECT_EQ(shown.torches.lights()[0].brightness, 1.0);
    state.torches[0].share = 0.0;
    EXPECT_EQ(run(milliseconds(20)).brightness, 1.0);
}

TEST_F(TorchExhibit, NewSetStartsWithoutLeftLights) {
    (void)run(seconds(3), {Command::NextLanguage});
    EXPECT_EQ(run(seconds(1), {Command::Behaviour}).torches.lights().size(), 2U);
    const std::vector<std::string> languages{"en"};
    const CatalogueEntry entry{languages, {1, {{0.2, 0.05}}}};
    (void)exhibit.show_set(Catalogue(1, entry), std::nullopt, {}, 0, now);
    EXPECT_EQ(run(seconds(1)).torches.lights().size(), 1U);
}

} // namespace
} // namespace frustumscreen::exhibit

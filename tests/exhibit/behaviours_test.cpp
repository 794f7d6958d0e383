// Which behaviours begin and end, in simulated time: the rules alone, and through the exhibit.
#include "tests/exhibit/exhibits.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using world::Trigger;
using Kind = BehaviourEvent::Kind;

/// Events as text: "+k" starts, "-k" ends, "*k" toggles; "0" before them: everything ends.
std::string text_of(const BehaviourEvents& behaviours) {
    std::string text = behaviours.end_all ? "0" : "";
    for (const BehaviourEvent& event : behaviours.events()) {
        text += event.kind == Kind::Start ? '+' : event.kind == Kind::End ? '-' : '*';
        text += std::to_string(event.behaviour);
    }
    return text;
}

TriggeredBehaviour behaviour(Trigger trigger, bool lasts = false) {
    return {.trigger = trigger, .lasts = lasts, .title_sizes_m = {{0.1, 0.02}, {0.0, 0.0}}};
}

BehaviourTriggers::Input not_there() {
    BehaviourTriggers::Input input;
    input.arrived = false;
    return input;
}

struct Rules {
    std::vector<TriggeredBehaviour> behaviours;
    BehaviourTriggers triggers = {};
    MonotonicTime now = sample::start;
    BehaviourTriggers::Input input = not_there();

    std::string step(Nanoseconds later = milliseconds(20)) {
        now += later;
        input.behaviours = behaviours;
        std::string text = text_of(triggers.step(now, input));
        input.pressed = false;
        return text;
    }
    std::string press() {
        input.pressed = true;
        return step();
    }
};

TEST(BehaviourTriggers, ButtonCyclesThroughItsBehaviours) {
    Rules rules{{behaviour(Trigger::Button), behaviour(Trigger::Dwell), behaviour(Trigger::Button),
                 behaviour(Trigger::Button)}};
    EXPECT_EQ(rules.press(), "") << "the artifact is not there yet";
    rules.input.arrived = true;
    for (const std::string expected : {"*0", "*2", "*3", "*0", "*2"}) {
        EXPECT_EQ(rules.press(), expected);
        EXPECT_EQ(rules.step(), "");
    }
    rules.input.artifact = 1; // of another artifact the first
    EXPECT_EQ(rules.step(), "0");
    EXPECT_EQ(rules.press(), "*0");
    Rules none{{behaviour(Trigger::Dwell)}};
    none.input.arrived = true;
    EXPECT_EQ(none.press(), "");
}

TEST(BehaviourTriggers, DwellStartsAndMovementEndsLastingBehaviours) {
    Rules rules{{behaviour(Trigger::Dwell), behaviour(Trigger::Dwell, true)}};
    rules.input.rested = BehaviourTriggers::dwell - milliseconds(1);
    EXPECT_EQ(rules.step(), "");
    rules.input.rested = BehaviourTriggers::dwell;
    EXPECT_EQ(rules.step(), "+0+1");
    rules.input.rested = seconds(20);
    EXPECT_EQ(rules.step(), "");
    rules.input.rested = seconds(0);
    EXPECT_EQ(rules.step(), "-1");
    rules.input.rested = seconds(5);
    EXPECT_EQ(rules.step(), "+0+1");
}

TEST(BehaviourTriggers, HotspotLabelStartsItsBehaviour) {
    Rules rules{{behaviour(Trigger::Hotspot, true), behaviour(Trigger::Hotspot)}};
    rules.behaviours[0].hotspot = 3;
    rules.behaviours[1].hotspot = 1;
    EXPECT_EQ(rules.step(), "");
    rules.input.hotspot = 3;
    EXPECT_EQ(rules.step(), "+0");
    EXPECT_EQ(rules.step(), "");
    rules.input.hotspot = 1;
    EXPECT_EQ(rules.step(), "-0+1");
    rules.input.hotspot.reset();
    EXPECT_EQ(rules.step(), "");
}

TEST(BehaviourTriggers, NarrationMarkCountsFromTheFirstSound) {
    Rules rules{{behaviour(Trigger::Narration, true)}};
    rules.behaviours[0].narration_s = 2.5;
    rules.input.tells = true;
    rules.input.speech_comes = true;
    EXPECT_EQ(rules.step(seconds(5)), "");
    rules.input.speech_comes = false;
    rules.input.heard = true;
    EXPECT_EQ(rules.step(), "");
    EXPECT_EQ(rules.step(milliseconds(2480)), "");
    EXPECT_EQ(rules.step(milliseconds(20)), "+0");
    EXPECT_EQ(rules.step(seconds(10)), "");
    rules.input.tells = rules.input.heard = false;
    EXPECT_EQ(rules.step(), "-0");
    rules.input.tells = true; // read this time
    EXPECT_EQ(rules.step(), "");
    EXPECT_EQ(rules.step(milliseconds(2500)), "+0");
}

TEST(BehaviourTriggers, ArrivalStartsBehavioursOnce) {
    Rules rules{{behaviour(Trigger::Arrival)}};
    rules.input.attracts = true; // from the start on: artifacts in turn
    EXPECT_EQ(rules.step(), "");
    rules.input.arrived = true;
    EXPECT_EQ(rules.step(), "+0");
    EXPECT_EQ(rules.step(), "");
    rules.input.artifact = 1;
    rules.input.arrived = false;
    EXPECT_EQ(rules.step(), "0");
    rules.input.arrived = true;
    EXPECT_EQ(rules.step(), "+0");
}

TEST(BehaviourTriggers, EndsAllWhenTheVisitorLeavesAndRestartsOnReturn) {
    Rules rules{{behaviour(Trigger::Arrival, true), behaviour(Trigger::Button)}};
    rules.input.arrived = true;
    EXPECT_EQ(rules.step(), "+0");
    EXPECT_EQ(rules.press(), "*1");
    rules.input.attracts = true;
    EXPECT_EQ(rules.step(), "0");
    EXPECT_EQ(rules.step(seconds(100)), "");
    rules.input.attracts = false; // a visitor: for them it has just come
    EXPECT_EQ(rules.step(), "+0");
    rules.input.shown = false; // the staff picture
    EXPECT_EQ(rules.step(), "0");
    EXPECT_EQ(rules.step(), "");
    rules.input.shown = true;
    EXPECT_EQ(rules.step(), "+0");
}

ExhibitPlace place_of(std::size_t buttons) {
    ExhibitPlace place = sample::place();
    place.buttons = buttons;
    place.words = {sample::words_of("en", {"attract_line"})};
    return place;
}

Catalogue moving_catalogue() {
    CatalogueEntry entry{{"en", "de"}, {{{0.2, 0.05}}, {{0.2, 0.05}}}};
    entry.behaviours = {behaviour(Trigger::Button), behaviour(Trigger::Dwell, true),
                        behaviour(Trigger::Arrival)};
    return {entry, CatalogueEntry{{"en"}, {{{0.2, 0.05}}}}};
}

constexpr std::uint32_t lamp = 1U << 5U;

struct Visit {
    Exhibit exhibit{moving_catalogue(), place_of(6), "en", sample::start};
    MonotonicTime now = sample::start;
    double x = 0.0;
    Presentation shown = {};

    /// The events in this time.
    std::string run(Nanoseconds length, std::vector<settings::Command> commands = {}) {
        std::string events;
        for (const MonotonicTime end = now + length; now < end;) {
            now += milliseconds(20);
            tracking::TrackedState tracked_state = sample::tracked_state(now);
            tracked_state.table_from_prop.translation.x = x;
            shown = exhibit.step(now, commands, tracked_state);
            commands.clear();
            events += text_of(shown.behaviours);
        }
        return events;
    }
};

TEST(Behaviours, StartAndEndDuringAVisit) {
    Visit visit;
    EXPECT_EQ(visit.run(seconds(1)), "+2") << "it arrives";
    visit.x = 0.02;
    EXPECT_EQ(visit.run(seconds(3)), "");
    EXPECT_EQ(visit.run(seconds(2)), "+1") << "the prop has stood for four seconds";
    EXPECT_EQ(visit.run(milliseconds(20), {settings::Command::Behaviour}), "-1*0");
    EXPECT_EQ(visit.shown.lamps & lamp, lamp);
    EXPECT_EQ(visit.run(seconds(1), {settings::Command::NextArtifact}), "0");
    EXPECT_EQ(visit.run(milliseconds(20), {settings::Command::Behaviour}), "") << "it has none";
    EXPECT_EQ(visit.shown.lamps & lamp, 0U);
    EXPECT_EQ(visit.run(seconds(1), {settings::Command::PreviousArtifact}), "+2");
}

TEST(Behaviours, EndWhenTheVisitorLeaves) {
    Visit visit;
    visit.run(seconds(1));
    visit.x = 0.02;
    EXPECT_EQ(visit.run(seconds(20)), "+1");
    EXPECT_EQ(visit.run(seconds(20)), "-1") << "nobody is there any more";
    EXPECT_EQ(visit.run(seconds(25)), "0");
    EXPECT_EQ(visit.shown.state, State::Attract);
    visit.x = 0.0;
    EXPECT_EQ(visit.run(seconds(1)).substr(0, 2), "+2");
}

TEST(Behaviours, TitleNamesTheButtonsBehaviour) {
    Visit visit;
    visit.run(seconds(1));
    visit.x = 0.02;
    visit.run(seconds(2));
    ASSERT_TRUE(visit.shown.title);
    EXPECT_EQ(visit.shown.title->title, (TitleIndex{0, 0, 0}));
    EXPECT_EQ(visit.shown.title->rectangle.size_m, glm::dvec2(0.1, 0.02));
    EXPECT_EQ(visit.shown.title->brightness, 1.0);
    ASSERT_TRUE(visit.shown.caption);
    const std::array caption = visit.shown.caption->rectangle.corners();
    EXPECT_GT(typography::clearance(visit.shown.title->rectangle.corners(), caption), 0.0);
    visit.run(seconds(1), {settings::Command::NextLanguage});
    EXPECT_FALSE(visit.shown.title) << "it has no title in German";
    visit.run(seconds(1), {settings::Command::NextLanguage});
    EXPECT_TRUE(visit.shown.title);
    visit.run(seconds(1), {settings::Command::NextArtifact});
    EXPECT_FALSE(visit.shown.title);
    Visit without{Exhibit(moving_catalogue(), place_of(5), "en", sample::start)};
    without.run(seconds(1));
    without.x = 0.02;
    without.run(seconds(2));
    EXPECT_FALSE(without.shown.title) << "there is no button";
}

TEST(Behaviours, EndInStaffModeAndRestartAfterIt) {
    Visit visit;
    visit.run(seconds(1));
    EXPECT_EQ(visit.run(milliseconds(20), {settings::Command::StaffMode}), "0");
    EXPECT_EQ(visit.run(seconds(3), {settings::Command::Behaviour}), "");
    EXPECT_EQ(visit.run(milliseconds(20), {settings::Command::StaffMode}), "+2");
}

/// No behaviour starts twice without an end or a rest between, and nothing allocates.
TEST(Behaviours, NeitherStartTwiceNorAllocateOnRandomInput) {
    Visit visit;
    visit.run(seconds(1));
    std::mt19937 random(3);
    for (int k = 0; k < 400; ++k) {
        std::vector<settings::Command> commands{
            settings::button_commands.at(random() % settings::button_commands.size())};
        visit.x = 0.05 * static_cast<double>(random() % 3);
        const tracking::TrackedState tracked_state = [&] {
            tracking::TrackedState state = sample::tracked_state(visit.now);
            state.table_from_prop.translation.x = visit.x;
            return state;
        }();
        visit.now += milliseconds(20);
        const long before = synthetic::allocations_so_far();
        visit.shown = visit.exhibit.step(visit.now, commands, tracked_state);
        EXPECT_EQ(synthetic::allocations_so_far(), before);
        const std::string events = visit.run(milliseconds(20 * (random() % 400)));
        EXPECT_EQ(events.find("+1+1"), std::string::npos) << events;
    }
}

} // namespace
} // namespace frustumscreen::exhibit

// The exhibit with a room, decided without drawing: whatever is pressed, each artifact is in one place.

#include "app/room/room_file.h"
#include "app/show/room_taking.h"
#include "tests/exhibit/exhibits.h"
#include "tests/exhibit/flash_counter.h"
#include "tests/show/shown_packs.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace frustumscreen::synthetic {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr MonotonicTime start{seconds(100)};

class RoomWalk : public WithTemporaryFolder {
protected:
    /// Packs 0 to 2 have the ids of artifacts; pack 3 has none.
    void SetUp() override {
        for (std::size_t k = 0; k < 4; ++k) {
            pack::Pack pack = numbered_pack(k);
            pack.id = k < 3 ? fmt::format("rings-{}", k) : "";
            ASSERT_TRUE(write_file(folder / fmt::format("{}.fspack", k), pack::write_pack(pack).value()));
        }
    }
    std::unique_ptr<show::RoomTaking> taking(std::string_view text) {
        const room::Room room = room::parse_room(text, folder / "room.toml").value();
        return show::RoomTaking::create({}, room, start).value();
    }
    /// The artifact of the object that is straight ahead, `right_m` to the right.
    std::optional<exhibit::RoomObject> ahead(show::RoomTaking& taking, double right_m) {
        tracking::TrackedState state = sample::tracked_state(start);
        const glm::dvec3 middle = settings::make_prop(settings::Settings().prop).middle;
        state.eye_m = {right_m, -0.5, 0.5};
        state.table_from_prop.translation = glm::dvec3(right_m, 0.0, 0.5) - middle;
        return taking.before(start, state);
    }
};

TEST_F(RoomWalk, MatchesObjectsToArtifactsByKeyElsePackIdElseFile) {
    const auto made = taking(R"([[object]]
pack = "0.fspack"
place_m = [-0.45, 1.0, 0.4]
size_m = 0.2
[[object]]
pack = "0.fspack"
artifact = "rings-2"
place_m = [-0.15, 1.0, 0.4]
size_m = 0.2
[[object]]
pack = "3.fspack"
place_m = [0.15, 1.0, 0.4]
size_m = 0.2
[[object]]
pack = "1.fspack"
place_m = [0.45, 1.0, 0.4]
size_m = 0.2
)");
    const std::string file = (folder / "." / "3.fspack").string(); // another name of the same file
    const std::array<show::ArtifactInProp, 3> artifacts{{{"rings-2", 0.1}, {file, 0.1}, {"rings-0", 0.1}}};
    EXPECT_FALSE(ahead(*made, -0.45)); // nothing is known yet
    made->set_artifacts(artifacts);
    EXPECT_EQ(ahead(*made, -0.45), (exhibit::RoomObject{0, 2}));
    EXPECT_EQ(ahead(*made, -0.15), (exhibit::RoomObject{1, 0}));
    EXPECT_EQ(ahead(*made, 0.15), (exhibit::RoomObject{2, 1}));
    EXPECT_FALSE(ahead(*made, 0.45)); // the exhibit does not show it
    EXPECT_FALSE(ahead(*made, 0.0));  // between two
}

TEST_F(RoomWalk, NamesAMissingPack) {
    const room::Room room =
        room::parse_room("[[object]]\npack = \"none.fspack\"\n", folder / "room.toml").value();
    const auto made = show::RoomTaking::create({}, room, start);
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find("none.fspack"), std::string::npos) << made.error().message;
}

/// Three artifacts, of which two have an object. Loading takes a while.
TEST_F(RoomWalk, RandomPressesKeepEachArtifactInOnePlaceWithoutFlashes) {
    constexpr std::array commands{settings::Command::NextArtifact, settings::Command::PreviousArtifact,
                                  settings::Command::NextLanguage, settings::Command::Choose};
    int in_prop_frames = 0, moving_frames = 0;
    for (unsigned seed = 0; seed < 12; ++seed) {
        std::mt19937_64 random(seed);
        exhibit::Exhibit exhibit = sample::exhibit(3, {"en", "de"});
        const auto made = taking(R"([[object]]
pack = "0.fspack"
place_m = [-0.4, 1.2, 0.3]
[[object]]
pack = "1.fspack"
place_m = [0.4, 1.3, 0.3]
turns_per_minute = 6
)");
        const std::array<show::ArtifactInProp, 3> artifacts{
            {{"rings-0", 0.1}, {"rings-1", 0.1}, {"rings-2", 0.1}}};
        made->set_artifacts(artifacts);
        std::array<exhibit::ArtifactState, 3> states{};
        std::vector<exhibit::Luminance> light;
        exhibit::Presentation shown;
        tracking::TrackedState state = sample::tracked_state(start);
        for (MonotonicTime now = start; now < start + seconds(40); now += milliseconds(1 + random() % 30)) {
            if (random() % 40 == 0) { // what the visitor sees stays in memory
                const std::size_t other = random() % 3;
                const bool leaves = other != exhibit.chosen() && other != shown.artifact && random() % 2 == 0;
                states.at(other) = leaves ? exhibit::ArtifactState::Away : exhibit::ArtifactState::Ready;
            }
            std::array<settings::Command, 1> pressed{commands[random() % commands.size()]};
            const bool presses = random() % 12 == 0 && now < start + seconds(30);
            state.table_from_prop.translation = {0.1 * std::sin(to_seconds(now - start)), 0.0, 0.1};
            exhibit.note(states);
            exhibit.note_object(made->before(now, state));
            shown = exhibit.step(now, std::span(pressed).first(presses ? 1 : 0), state);
            made->step(now, exhibit.chosen(), shown);
            light.push_back({now, shown.brightness});
            for (std::size_t artifact = 0; artifact < 2; ++artifact) {
                double on_screen = 1.0;
                for (const room::TakenPose& pose : made->poses()) {
                    on_screen = pose.object == artifact ? pose.opacity : on_screen;
                }
                const double in_prop = shown.artifact == artifact ? shown.brightness : 0.0;
                ASSERT_NEAR(on_screen + in_prop, 1.0, 1e-12) << seed << " " << artifact;
                in_prop_frames += in_prop > 0.99 ? 1 : 0;
            }
            moving_frames += made->poses().size() > 1 ? 1 : 0;
            ASSERT_FALSE(shown.placeholder && shown.placeholder->artifact < 2);
        }
        EXPECT_LE(exhibit::max_flashes_per_second(light), 2) << seed;
    }
    EXPECT_GT(in_prop_frames, 1000);
    EXPECT_GT(moving_frames, 1000);
}

} // namespace
} // namespace frustumscreen::synthetic

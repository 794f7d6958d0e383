// Artifacts that are taken out of the room into the prop: exhibit, taking and both pictures together, without a screen.

#include "app/render/read_back.h"
#include "app/room/room_file.h"
#include "app/scene/device_plan.h"
#include "app/show/live_exhibit.h"
#include "app/show/room_show.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/base/temporary_folder.h"
#include "tests/exhibit/block_words.h"
#include "tests/render/counted_new.h"
#include "tests/show/shown_packs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>

namespace frustumscreen::synthetic {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr int width = 480;
constexpr int height = 300;
constexpr MonotonicTime start{seconds(50)};

/// Red, green and blue rings, so that pictures tell which artifact is where.
pack::Pack coloured(std::size_t number) {
    pack::Pack pack = numbered_pack(number);
    pack.id = fmt::format("rings-{}", number);
    glm::u8vec4 colour(20, 20, 20, 255);
    colour[static_cast<int>(number)] = 250;
    pack.textures[0] = image::Image8(64, 64, colour);
    return pack;
}

/// Pixels of which this channel is well above the two others.
int count(const image::Image8& picture, int channel) {
    return static_cast<int>(
        std::count_if(picture.texels.begin(), picture.texels.end(), [&](const glm::u8vec4& texel) {
            const int other = std::max(texel[(channel + 1) % 3], texel[(channel + 2) % 3]);
            return texel[channel] > 2 * other + 20;
        }));
}

class TakenFromRoom : public WithTemporaryFolder {
protected:
    void SetUp() override {
        for (std::size_t k = 0; k < 3; ++k) {
            const Bytes bytes = pack::write_pack(coloured(k)).value();
            ASSERT_TRUE(
                write_file(folder / fmt::format("shown-{}.fspack", k), bytes)); // as an import copies it
            ASSERT_TRUE(write_file(folder / fmt::format("room-{}.fspack", k), bytes));
            packs.push_back(folder / fmt::format("shown-{}.fspack", k));
        }
        // Artifact 2 has no object, artifact 1 has two.
        ASSERT_TRUE(write_file(folder / "room.toml", as_bytes(R"([[object]]
pack = "room-0.fspack"
place_m = [-0.55, 1.3, 0.25]
size_m = 0.45
[[object]]
pack = "room-1.fspack"
place_m = [0.5, 1.3, 0.25]
size_m = 0.40
turn_deg = 40
[[object]]
pack = "room-1.fspack"
place_m = [0.1, 2.2, 0.3]
size_m = 0.40
)")));
        settings.projector.pinhole = settings.projector.pinhole.scaled_to(width, height);
        settings.exhibit.captions = false;
        settings.exhibit.guidance = false;
        settings.exhibit.table_pictures = false;
        settings.screen.room = folder / "room.toml";
        settings.screen.width = width;
        settings.screen.height = height;
        settings.screen.corners_m[2].z = settings.screen.corners_m[3].z = 0.1; // square pixels
        devices.other_packs = true;
        display = display::SurfacelessDisplay::create(width, height).value();
        show::ArtifactShowOptions options;
        options.packs = packs;
        options.technique = "finest";
        options.waits = true;
        auto made = show::ArtifactShow::create(settings, devices, options, {display->framebuffer(), 0});
        ASSERT_TRUE(made) << made.error().message;
        exhibit::Exhibit exhibit = show::make_exhibit(settings, **made, start);
        live =
            std::make_unique<show::LiveExhibit>(settings, std::move(*made), std::move(exhibit), "a driver");
        const room::Room room = room::read_room(settings.screen.room).value();
        auto taking = show::RoomTaking::create(settings, room, start);
        ASSERT_TRUE(taking) << taking.error().message;
        live->set_room(std::move(*taking));
        auto screen = show::RoomShow::create(settings, {});
        ASSERT_TRUE(screen) << screen.error().message;
        room_show = std::move(*screen);
        hand.eye_m = settings.eye.default_m;
        hand.prop_known = true;
        hand.table_from_prop.translation = {0.0, 0.02, 0.27}; // in a hand, before the screen
    }

    void step(std::span<const settings::Command> commands = {}) {
        now += milliseconds(20);
        hand.time = now;
        live->step(now, commands, hand);
        // Artifacts are loaded as frames are drawn.
        static_cast<void>(live->draw(now, hand, {display->framebuffer(), 0}, render::Redraw::Everything));
    }
    void wait(milliseconds length) {
        for (milliseconds passed(0); passed < length; passed += milliseconds(20)) {
            step();
        }
    }
    void touch() {
        step();
        hand.table_from_prop.translation.x += 0.02;
        step();
    }
    image::Image8 prop_picture() {
        static_cast<void>(live->draw(now, hand, {display->framebuffer(), 0}, render::Redraw::Everything));
        return keep(render::read_colour(display->framebuffer(), width, height), "prop");
    }
    image::Image8 screen_picture() {
        room_show->set_taken(live->taken());
        static_cast<void>(room_show->draw(to_seconds(now - start), std::array{hand.eye_m},
                                          {display->framebuffer(), 0}, render::Redraw::Everything));
        return keep(render::read_colour(display->framebuffer(), width, height), "screen");
    }
    /// For people: the environment's FRUSTUMSCREEN_KEEP names a folder for the pictures.
    image::Image8 keep(image::Image8 picture, const std::string& which) {
        if (const char* const to = std::getenv("FRUSTUMSCREEN_KEEP")) {
            const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
            static_cast<void>(
                write_file(std::filesystem::path(to) / fmt::format("{}-{:05}-{}.png", test->name(),
                                                                   (now - start) / milliseconds(1), which),
                           image::encode_png(picture)));
        }
        return picture;
    }

    settings::Settings settings;
    scene::DevicePlan devices;
    std::vector<std::filesystem::path> packs;
    std::unique_ptr<display::SurfacelessDisplay> display;
    std::unique_ptr<show::LiveExhibit> live;
    std::unique_ptr<show::RoomShow> room_show;
    tracking::TrackedState hand;
    MonotonicTime now = start;
};

constexpr std::array next_artifact{settings::Command::NextArtifact};

TEST_F(TakenFromRoom, AllObjectsStandInTheRoomWithoutAVisitor) {
    wait(milliseconds(1000));
    EXPECT_TRUE(live->taken().empty());
    EXPECT_EQ(count(prop_picture(), 0), 0);
    const image::Image8 screen = screen_picture();
    EXPECT_GT(count(screen, 0), 500);
    EXPECT_GT(count(screen, 1), 500);
}

TEST_F(TakenFromRoom, FirstTouchTakesAnArtifactAndInactivityPutsItBack) {
    wait(milliseconds(400));
    const int stands = count(screen_picture(), 0);
    touch();
    wait(milliseconds(300));
    EXPECT_EQ(count(prop_picture(), 0), 0);
    EXPECT_GT(count(screen_picture(), 0), 50); // on its way
    wait(milliseconds(400));
    static_cast<void>(prop_picture());
    static_cast<void>(screen_picture());
    wait(milliseconds(2500));
    EXPECT_GT(count(prop_picture(), 0), 500);
    EXPECT_EQ(count(screen_picture(), 0), 0);
    EXPECT_TRUE(live->state().settled);
    wait(milliseconds(61'000)); // nobody touches it
    EXPECT_EQ(live->state().state, exhibit::State::Attract);
    EXPECT_EQ(count(prop_picture(), 0), 0);
    EXPECT_EQ(count(screen_picture(), 0), stands);
}

TEST_F(TakenFromRoom, ButtonSwapsArtifactsBetweenPropAndScreen) {
    touch();
    wait(milliseconds(3000));
    step(next_artifact);
    int in_prop = count(prop_picture(), 0);
    bool both_fly = false;
    for (int k = 0; k < 80; ++k) {
        step();
        if (k % 8 == 0) {
            const image::Image8 prop = prop_picture(), screen = screen_picture();
            EXPECT_LE(count(prop, 0), in_prop); // the old one leaves, and does not come again
            in_prop = count(prop, 0);
            EXPECT_GT(count(screen, 0) + count(prop, 0), 50) << k; // neither is anywhere not
            EXPECT_GT(count(screen, 1), 50) << k;                  // one of the two green ones stays
            both_fly = both_fly || live->taken().size() == 2;
        }
    }
    EXPECT_TRUE(both_fly);
    wait(milliseconds(2500));
    EXPECT_GT(count(prop_picture(), 1), 500);
    ASSERT_EQ(live->taken().size(), 1U);
    EXPECT_EQ(live->taken().front().object, 1U); // the nearer one
    step(next_artifact);                         // without an object: in the prop as without a room
    wait(milliseconds(600));
    EXPECT_GT(count(prop_picture(), 2), 500);
    wait(milliseconds(3000));
    EXPECT_TRUE(live->taken().empty());
}

TEST_F(TakenFromRoom, HoldingThePropBeforeAnObjectTakesThatInstance) {
    touch();
    wait(milliseconds(3000));
    // From the eye to the middle of the far green object, at a third of the way.
    const glm::dvec3 middle(0.1, 2.2, 0.48);
    const glm::dvec3 prop_middle = glm::mix(hand.eye_m, middle, 0.2);
    hand.table_from_prop.translation = prop_middle - settings::make_prop(settings.prop).middle;
    wait(milliseconds(1000));
    EXPECT_EQ(live->state().state, exhibit::State::Browse);
    static_cast<void>(screen_picture());
    EXPECT_EQ(live->taken().size(), 2U); // the one in the prop, and the one that leans
    wait(milliseconds(560));
    EXPECT_NE(live->state().state, exhibit::State::Browse);
    wait(milliseconds(400));
    static_cast<void>(screen_picture());
    wait(milliseconds(3000));
    ASSERT_EQ(live->taken().size(), 1U);
    EXPECT_EQ(live->taken().front().object, 2U);
    EXPECT_EQ(live->taken().front().opacity, 0.0);
}

/// The words' file has an invitation of 20 letters, and one of three where there is a room.
TEST(InvitationToARoom, ReplacesTheGeneralInvitationWhereThereIsARoom) {
    const TemporaryFolder folder;
    pack::LanguageWords words = block_words("en", pack::TextDirection::LeftToRight);
    for (const auto& [from, to] : {std::pair("stick.found", "attract_line"), {"stick.taken", "room_line"}}) {
        for (std::size_t k = 0; k < words.words.size(); ++k) {
            if (words.words[k].key == from) {
                words.words[k].key = words.runs.texts[k].key = to;
            }
        }
    }
    const auto width_m = [&](bool room) {
        EXPECT_TRUE(write_file(folder.path() / "own.fswords", *pack::write_words(std::array{words})));
        const auto read = show::read_advice_words(
            {.file = folder.path() / "own.fswords", .languages = {"en"}, .room = room});
        EXPECT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->languages.at(0).texts.size(), 1U);
        EXPECT_EQ(read->languages[0].texts.at(0).key, "attract_line");
        return read->languages[0].texts[0].sizes_m[0].x;
    };
    EXPECT_LT(width_m(true), 0.4 * width_m(false));
    words.words[5].key = words.runs.texts[5].key = "advice.other"; // a file of an earlier version
    EXPECT_EQ(words.words[0].key, "attract_line");
    const show::AdviceWordsRequest request{
        .file = folder.path() / "own.fswords", .languages = {"en"}, .room = true};
    EXPECT_TRUE(write_file(request.file, *pack::write_words(std::array{words})));
    EXPECT_EQ(show::read_advice_words(request)->languages[0].texts[0].key, "attract_line");
}

TEST_F(TakenFromRoom, SteppingAllocatesNothing) {
    touch();
    step(next_artifact);
    wait(milliseconds(3000));
    const long before = allocations_so_far();
    for (int k = 0; k < 100; ++k) {
        step();
    }
    EXPECT_TRUE(!allocations_are_counted || allocations_so_far() == before) << allocations_so_far() - before;
}

} // namespace
} // namespace frustumscreen::synthetic

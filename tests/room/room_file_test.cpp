// Rooms as designers write them: every key and its default; and wrong ones, each refused in one sentence.
#include "app/room/room_file.h"
#include "firmware_host/base/file.h"
#include "tests/base/temporary_folder.h"
#include "tests/base/told.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::room {
namespace {

Room read(const std::string& text) {
    const Result<Room> room = parse_room(text, "set/room.toml");
    EXPECT_TRUE(room) << room.error().message;
    return room ? *room : Room();
}
/// `sentence [id]`; empty if the room was taken.
std::string refusal(const std::string& text) {
    const Result<Room> room = parse_room(text, "set/room.toml");
    if (room) {
        return {};
    }
    EXPECT_EQ(room.error().kind, ErrorKind::BadInput);
    return test::told(room.error());
}
/// An object with these lines.
std::string object(const std::string& lines = {}) {
    return "[[object]]\npack = \"cup.fspack\"\n" + lines + "\n";
}
std::string objects(int count, const std::string& lines) {
    std::string text;
    for (int k = 0; k < count; ++k) {
        text += object(lines);
    }
    return text;
}

/// Each text is refused in one line of a readable length that has all of these words.
using Expectations = std::vector<std::pair<std::string, std::vector<std::string>>>;
void expect_refusals(const Expectations& expectations) {
    for (const auto& [text, words] : expectations) {
        const std::string message = refusal(text);
        EXPECT_TRUE(message.starts_with("set/room.toml")) << message;
        EXPECT_LT(message.size(), 400U) << message;
        for (const char c : message) {
            EXPECT_GE(static_cast<unsigned char>(c), 0x20U) << message;
        }
        for (const std::string& word : words) {
            EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' not in: " << message;
        }
    }
}

TEST(RoomFile, ParsesEveryKey) {
    const Room room = read("[[object]]\nname = \"the blue cup\"\npack = \"packs/cup.fspack\"\n"
                           "place_m = [-1.5, 2, 0.25]\nturn_deg = -45.5\nsize_m = 0.125\n"
                           "turns_per_minute = -2.5\nsway_m = [0.5, 0, -1]\nsway_s = 12\n");
    ASSERT_EQ(room.packs, (std::vector<std::filesystem::path>{"set/packs/cup.fspack"}));
    ASSERT_EQ(room.objects.size(), 1U);
    EXPECT_EQ(room.objects[0],
              (Object{.name = "the blue cup",
                      .pack = 0,
                      .place_m = {-1.5, 2.0, 0.25},
                      .turn_deg = -45.5,
                      .size_m = 0.125,
                      .motion = {.turns_per_minute = -2.5, .sway_m = {0.5, 0.0, -1.0}, .sway_s = 12.0}}));
}

TEST(RoomFile, RequiresOnlyAPack) {
    const Room room = read(object());
    ASSERT_EQ(room.objects.size(), 1U);
    Object usual;
    usual.name = "cup";
    EXPECT_EQ(room.objects[0], usual);
    EXPECT_FALSE(room.objects[0].motion.moves());
}

TEST(RoomFile, ListsEachPackOnceAndKeepsTheOrderOfTheObjects) {
    const Room room =
        read("[[object]]\npack = \"b.fspack\"\n[[object]]\npack = \"a.fspack\"\n"
             "[[object]]\npack = \"./sub/../b.fspack\"\n[[object]]\npack = \"/abs/c.fspack\"\n");
    EXPECT_EQ(room.packs,
              (std::vector<std::filesystem::path>{"set/b.fspack", "set/a.fspack", "/abs/c.fspack"}));
    std::vector<std::size_t> order;
    for (const Object& each : room.objects) {
        order.push_back(each.pack);
    }
    EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 0, 2}));
}

TEST(RoomFile, GivesUnnamedObjectsUniqueNames) {
    const Room room =
        read(object() + object("name = \"cup-2\"") + object() + object("name = \"cup\"") + object());
    std::vector<std::string> names;
    for (const Object& each : room.objects) {
        names.push_back(each.name);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"cup-3", "cup-2", "cup-4", "cup", "cup-5"}));
    EXPECT_EQ(read(object() + object()).objects[0].name, "cup");
    EXPECT_EQ(read(object() + object()).objects[1].name, "cup-2");
}

TEST(HostileRoom, IsRejectedWithoutObjects) {
    for (const char* nothing : {"", "\n\n", "# only a comment\n", "object = []\n"}) {
        expect_refusals(
            {{nothing, {"object is missing; write at least one table [[object]]", "[room.empty]"}}});
    }
    expect_refusals({{"[object]\npack = \"a.fspack\"\n",
                      {":1: object is a table; allowed is a list of", "[settings.list]"}},
                     {"object = 5\n", {":1: object is 5"}},
                     {"object = [5]\n", {":1: object[0] is 5; allowed is a table"}}});
}

TEST(HostileRoom, SuggestsTheNearestKey) {
    expect_refusals({
        {object("place = [0, 1, 0]"),
         {":3: object[0].place is not a known key", "nearest allowed key is object[0].place_m"}},
        {object("scale_m = 1"), {":3: object[0].scale_m is not a known key"}},
        {object("turn_per_minute = 1"), {"object[0].turns_per_minute"}},
        {"[[objects]]\npack = \"a\"\n",
         {":1: objects is not a known key; the nearest allowed key is object"}},
        {"[[object]]\npak = \"a.fspack\"\n",
         {":2: object[0].pak is not a known key; the nearest allowed key is object[0].pack"}},
        {object() + "[room]\nname = \"hall\"\n", {":4: room is not a known key"}},
    });
}

TEST(HostileRoom, NamesTheObjectWithoutAPack) {
    expect_refusals({
        {object() + "[[object]]\nname = \"vase\"\n",
         {":4: object[1].pack is missing; name the object's pack, a file *.fspack", "[room.no_pack]"}},
        {"[[object]]\npack = \"\"\n",
         {":2: object[0].pack is the text \"\"; allowed is a text in quotes of 1 to"}},
        {"[[object]]\npack = 5\n", {":2: object[0].pack is 5"}},
    });
}

TEST(HostileRoom, ReportsDuplicateAndLongNames) {
    expect_refusals({
        {object("name = \"a\"") + object("name = \"b\"") + object("name = \"a\""),
         {":9: object[2].name is \"a\", as at set/room.toml:3: object[0].name; give each object a name of "
          "its own",
          "[room.name_twice]"}},
        {object("name = \"a\\nb\\u001b\"") + object("name = \"a\\nb\\u001b\""), {"is \"a?b?\""}},
        {object("name = \"" + std::string(81, 'x') + "\""),
         {":3: object[0].name has 81 bytes; allowed are at most 80", "[room.long_name]"}},
    });
}

TEST(HostileRoom, ReportsTheRangeOfInvalidNumbers) {
    for (const std::string number : {"nan", "-nan", "inf", "-inf", "1e300", "99999999999"}) {
        expect_refusals({
            {object("place_m = [0, " + number + ", 0]"),
             {":3: object[0].place_m[1] is ", "-100 to 100 metres"}},
            {object("turn_deg = " + number), {":3: object[0].turn_deg is ", "-360 to 360 degrees"}},
            {object("size_m = " + number), {":3: object[0].size_m is ", "0.001 to 100 metres"}},
            {object("turns_per_minute = " + number), {"turns_per_minute is ", "-60 to 60 turns a minute"}},
            {object("sway_m = [" + number + ", 0, 0]"),
             {":3: object[0].sway_m[0] is ", "-100 to 100 metres"}},
            {object("sway_s = " + number), {":3: object[0].sway_s is ", "0.5 to 3600 seconds"}},
        });
    }
    expect_refusals({{object("size_m = 0"), {":3: object[0].size_m is 0; allowed are 0.001 to 100 metres"}},
                     {object("size_m = -1"), {"is -1"}},
                     {object("sway_s = 0"), {":3: object[0].sway_s is 0"}}});
}

TEST(HostileRoom, NamesTheExpectedType) {
    expect_refusals({
        {object("name = 5"), {":3: object[0].name is 5; allowed is a text in quotes"}},
        {object("place_m = 1"), {":3: object[0].place_m is 1; allowed is a list of 3 numbers, [x, y, z]"}},
        {object("place_m = [0, 1]"), {"is a list of 2"}},
        {object("place_m = [0, 1, \"2\"]"), {"object[0].place_m[2] is the text \"2\""}},
        {object("size_m = \"0.3\""), {"object[0].size_m is the text \"0.3\""}},
        {object("size_m = true"), {"object[0].size_m is true"}},
        {object("turn_deg = [1]"), {"object[0].turn_deg is a list of 1"}},
        {object("turn_deg = 1979-05-27"), {"object[0].turn_deg is a date"}},
        {object("sway_m = {x = 1}"), {"object[0].sway_m is a table"}},
    });
}

TEST(HostileRoom, ReportsTheLineOfInvalidToml) {
    expect_refusals({{"[[object]]\npack = \n", {":2: is not TOML", "[toml.syntax]"}},
                     {object("size_m = 1\nsize_m = 2"), {":4: is not TOML", "size_m"}},
                     {"# \xff\n", {":1: is not UTF-8"}},
                     {std::string("a\0", 2), {":1: is not UTF-8"}}});
}

TEST(HostileRoom, RejectsDeepNesting) {
    for (const std::string open : {"[", "{a="}) {
        std::string deep = "object = ";
        for (int k = 0; k < 100'000; ++k) {
            deep += open;
        }
        EXPECT_FALSE(refusal(deep).empty());
    }
    std::string keys = "a";
    std::string numbers = "1.1";
    for (int k = 0; k < 60'000; ++k) {
        keys += ".a";
        numbers += ".1";
    }
    expect_refusals({{keys + " = 1", {"60000 dots in keys; allowed are at most 5000"}},
                     {"[" + keys + "]\n", {"60000 dots"}},
                     {numbers + " = 1", {"60001 dots"}},
                     {"[" + numbers + "]\n", {"dots in keys"}}});
}

TEST(HostileRoom, AllowsAtMostTenThousandObjects) {
    const std::string lines = "place_m = [0.1, 1.5, 0.25]\nturn_deg = 12.5\nsize_m = 0.35\n"
                              "turns_per_minute = 0.5\nsway_m = [0.1, 0.2, 0.3]\nsway_s = 10.5";
    const Room room = read(objects(10'000, lines));
    EXPECT_EQ(room.objects.size(), 10'000U);
    EXPECT_EQ(room.packs.size(), 1U);
    EXPECT_EQ(room.objects.back().name, "cup-10000");
    expect_refusals({{objects(10'001, ""), {"object is a list of 10001", "at most 10000 tables"}}});
}

TEST(HostileRoom, NamesTheLimitsOfSizeAndObjects) {
    std::string text;
    for (int k = 0; k < 1'000'000; ++k) {
        text += "[[object]]\npack=\"a\"\n";
    }
    expect_refusals(
        {{text,
          {"is 20000000 bytes; allowed are at most 8388608 bytes and 10000 objects", "[room.too_large]"}}});
}

TEST(HostileRoom, AllowsAtMost256Packs) {
    std::string text;
    for (int k = 0; k < 256; ++k) {
        text += fmt::format("[[object]]\npack = \"{}.fspack\"\n", k);
    }
    EXPECT_EQ(read(text).packs.size(), 256U);
    expect_refusals({{text + "[[object]]\npack = \"x.fspack\"\n",
                      {"its objects name 257 different packs; allowed are at most 256", "[room.packs]"}}});
}

class RoomOnDisk : public WithTemporaryFolder {
protected:
    std::string refused(const std::string& name) const {
        const Result<Room> room = read_room(folder / name);
        EXPECT_FALSE(room);
        return room ? std::string() : test::told(room.error());
    }
};

TEST_F(RoomOnDisk, ResolvesPacksRelativeToTheFile) {
    put("room.toml", "[[object]]\npack = \"cup.fspack\"\n");
    const Result<Room> room = read_room(folder / "room.toml");
    ASSERT_TRUE(room) << room.error().message;
    EXPECT_EQ(room->packs, std::vector<std::filesystem::path>{folder / "cup.fspack"});
}

TEST_F(RoomOnDisk, ReportsAMissingFileAFolderAndATooLargeFile) {
    std::filesystem::create_directory(folder / "hall");
    put("large.toml", std::string(std::size_t{9} << 20, '#'));
    const std::string at = folder.string();
    EXPECT_EQ(refused("no.toml"), at + "/no.toml: there is no such file [file.not_opened]");
    EXPECT_EQ(refused("hall"), at + "/hall: this is a folder; name a file [file.not_regular]");
    EXPECT_EQ(refused("large.toml"),
              at + "/large.toml: is 9437184 bytes; allowed are at most 8388608 bytes and "
                   "10000 objects: write fewer objects [room.too_large]");
}

} // namespace
} // namespace frustumscreen::room

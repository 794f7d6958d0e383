// A room is a file that lists its objects, each with its pack, place, size and motion. Here: a cup that turns once a minute, and a
// second one beside it.
#include "app/room/room_file.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Room) {
    // example
    const room::Room hall = room::parse_room("[[object]]\n"
                                             "pack = \"cup.fspack\"\n"
                                             "place_m = [0.0, 2.0, 0.5]\n"
                                             "turns_per_minute = 1.0\n"
                                             "[[object]]\n"
                                             "pack = \"cup.fspack\"\n",
                                             "hall/room.toml")
                                .value();
    EXPECT_EQ(hall.packs.size(), 1U); // hall/cup.fspack, read once for both
    EXPECT_EQ(hall.objects[1].name, "cup-2");

    const geometry::RigidTransform half_turned = room::table_from_object(hall.objects[0], 30.0); // seconds
    EXPECT_LT(glm::distance(half_turned.point({1.0, 0.0, 0.0}), glm::dvec3(-1.0, 2.0, 0.5)), 1e-12);
    // end
}

} // namespace
} // namespace frustumscreen::example

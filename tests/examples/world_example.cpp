// A world is a tree of cells; a player moves them by behaviours, several at once, and back to rest. Here: a lid that a
// spring pulls open until it is triggered again.
#include "app/world/cell.h"
#include "app/world/player.h"

#include <gtest/gtest.h>

#include <chrono>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, World) {
    // example
    std::vector<world::Cell> cells(2); // a chest, and its lid with a hinge half a box above
    cells[1].parent = 0;
    cells[1].parent_from_base[3] = {0.0, 0.0, 0.5, 1.0};
    world::Behaviour open{.name = "open", .trigger = world::Trigger::Button, .stays = true};
    open.springs.push_back({.cell = 1, .turns = true, .axis = {1.0, 0.0, 0.0}, .reach = 1.5});

    world::Player player(cells, {open});
    const MonotonicTime pressed = from_microseconds(0);
    player.trigger(0, pressed);
    const world::CellPose lid = player.step(pressed + std::chrono::seconds(10))[1];
    EXPECT_NEAR(lid.box_from_geometry[1].z, std::sin(1.5), 1e-12); // its Y axis points up

    player.trigger(0, pressed + std::chrono::seconds(10)); // again: back to rest
    (void)player.step(pressed + std::chrono::seconds(20));
    EXPECT_FALSE(player.moves());
    // end
}

} // namespace
} // namespace frustumscreen::example

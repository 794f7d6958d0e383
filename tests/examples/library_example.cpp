// The new set is planned from the shown set and the packs of a stick. A newer pack replaces the older one
// in its place, and a new artifact is appended.
#include "app/library/set_plan.h"

#include <gtest/gtest.h>

#include <array>

namespace frustumscreen::example {
namespace {

library::InstalledPack pack(const std::string& id, std::uint64_t serial) {
    library::InstalledPack pack;
    pack.id = id;
    pack.serial = serial;
    return pack;
}

TEST(RoomExample, Library) {
    // example
    library::InstalledSet shown;
    shown.packs = {pack("cup", 1), pack("vase", 1)};
    library::StickPack newer, other;
    newer.pack = pack("cup", 2);
    other.pack = pack("mask", 1);
    const library::PlannedSet planned =
        library::plan_set(shown, std::array{newer, other}, {}, std::nullopt).value();
    const std::vector<library::InstalledPack> expected{pack("cup", 2), pack("vase", 1), pack("mask", 1)};
    EXPECT_EQ(planned.set.packs, expected);
    EXPECT_TRUE(planned.removed.empty());
    // end
}

} // namespace
} // namespace frustumscreen::example

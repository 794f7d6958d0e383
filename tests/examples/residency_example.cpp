// Each step loads a needed artifact, or releases another one if the budget is too small for it.
#include "app/residency/residency.h"

#include <gtest/gtest.h>

#include <array>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Residency) {
    // example
    std::array<residency::ResidentItem, 3> items{
        {{60, true, false, 1}, {30, true, false, 2}, {50, false, false, 0}}};
    const std::array<std::size_t, 2> needed{2, 1}; // the third artifact is chosen, the second still shown
    const std::uint64_t budget = 100;
    EXPECT_EQ(residency::next_step(items, needed, {}, budget),
              (residency::ResidencyStep{.release = 0, .load = {}})); // 60 + 30 + 50 > 100
    items[0].loaded = false;
    EXPECT_EQ(residency::next_step(items, needed, {}, budget),
              (residency::ResidencyStep{.release = {}, .load = 2}));
    items[2].loaded = true;
    EXPECT_EQ(residency::next_step(items, needed, {}, budget),
              residency::ResidencyStep{}); // nothing is left to do
    // end
}

} // namespace
} // namespace frustumscreen::example

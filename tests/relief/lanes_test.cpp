// Masks of eight lanes against bits, one by one.

#include "app/relief/lanes.h"

#include <gtest/gtest.h>

#include <bit>

namespace frustumscreen::relief {
namespace {

FRUSTUMSCREEN_INLINE Ints mask_of(unsigned bits) {
    Ints mask{};
    for (int lane = 0; lane < lanes; ++lane) {
        mask[lane] = (bits >> lane & 1U) != 0 ? -1 : 0;
    }
    return mask;
}

TEST(Lanes, AMaskHasABitForEachLane) {
    for (unsigned bits = 0; bits < 256; ++bits) {
        EXPECT_EQ(bits_of(mask_of(bits)), bits);
        EXPECT_EQ(any(mask_of(bits)), bits != 0);
    }
}

TEST(Lanes, ListsSetBitsInAscendingOrder) {
    for (unsigned bits = 0; bits < 256; ++bits) {
        unsigned found = 0;
        int before = -1;
        for (int k = 0; k < std::popcount(bits); ++k) {
            const int place = set_bits[bits][static_cast<std::size_t>(k)];
            EXPECT_GT(place, before) << bits;
            found |= 1U << place;
            before = place;
        }
        EXPECT_EQ(found, bits);
    }
}

TEST(Lanes, TheLargestIsFoundInAnyLane) {
    for (int lane = 0; lane < lanes; ++lane) {
        for (const int largest : {-3, 0, 70'000}) {
            Ints values = Ints{} + largest - 1;
            values[lane] = largest;
            EXPECT_EQ(max_of(values), largest) << lane;
        }
    }
}

} // namespace
} // namespace frustumscreen::relief

// A prop file is a plain OBJ. Here: a triangular prism, as text, its volume and its least width.
#include "app/solid/prop_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Solid) {
    // example
    const auto prop = solid::parse_prop_file("v 0 0 0\nv 100 0 0\nv 0 100 0\n" // millimetres
                                             "v 0 0 150\nv 100 0 150\nv 0 100 150\n"
                                             "g bottom\nf 3 2 1\ng top\nf 4 5 6\n"
                                             "g front\nf 1 2 5 4\ng left\nf 3 1 4 6\ng slope\nf 2 3 6 5\n",
                                             solid::LengthUnit::Millimetre);
    EXPECT_EQ(prop->solid.faces.back().name, "slope");
    EXPECT_NEAR(solid::volume_of(prop->solid), 0.1 * 0.1 / 2.0 * 0.15, 1e-12); // m3
    EXPECT_NEAR(solid::min_width(prop->solid).width_m, 0.1 / std::sqrt(2.0), 1e-12);

    const auto open =
        solid::parse_prop_file("v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n", solid::LengthUnit::Metre);
    EXPECT_EQ(open.error().id, "prop_file.size"); // a sentence for the person who wrote the file
    // end
}

} // namespace
} // namespace frustumscreen::example

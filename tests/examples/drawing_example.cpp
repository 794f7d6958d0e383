// Drawings are made from the settings: a prop 123.7 mm high has that dimension on its sheet.
#include "app/drawing/drawing.h"
#include "app/drawing/prop_net.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Drawing) {
    // example
    settings::Settings settings;
    settings.prop.height_m = 0.1237;
    const std::string svg = drawing::prop_sheet(settings, "kiosk.toml");
    EXPECT_NE(svg.find(">123.7<"), std::string::npos);

    const drawing::PropNet net = drawing::unfold(geometry::make_cube(0.16)); // to cut out and glue
    EXPECT_EQ(net.faces.size(), 6U);
    EXPECT_EQ(net.folds.size(), 5U);
    EXPECT_EQ(net.tabs.size(), 12U - 5U); // one for each edge that is no fold
    // end
}

} // namespace
} // namespace frustumscreen::example

// The drawing of a torch: sensor and tag are where the settings have them, read from the SVG.
#include "app/drawing/drawing.h"
#include "tests/drawing/svg_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen::drawing {
namespace {

constexpr double written_m = 1e-4;

/// The middle of a polygon's box; nothing: it is not drawn.
std::optional<glm::dvec2> middle_of(const std::string& svg, const std::string& name, std::size_t number) {
    for (const SvgPolygon& each : named_polygons(svg)) {
        if (each.name == name && number-- == 0) {
            glm::dvec2 low = each.corners.front(), high = low;
            for (const glm::dvec2& corner : each.corners) {
                low = glm::min(low, corner);
                high = glm::max(high, corner);
            }
            return 0.5 * (low + high);
        }
    }
    return std::nullopt;
}

settings::Settings with_both() {
    settings::Settings settings;
    settings.torch.source = settings::TorchSource::Both;
    settings.torch.sensor_from_torch.translation = {0.0, -0.002, 0.08};
    settings.torch.tag.centre_m = {0.004, -0.03, -0.05};
    return settings;
}

TEST(TorchSheet, DrawsSensorAndTagAtTheirPlaces) {
    const std::string svg = torch_sheet(with_both(), "kiosk.toml");
    // From the side the light goes to the right and up is up: z and -y. From above: z and -x. From the front: -x and -y.
    const std::optional<glm::dvec2> side = middle_of(svg, "sensor", 0), above = middle_of(svg, "sensor", 1);
    ASSERT_TRUE(side && above);
    EXPECT_LT(glm::distance(*side, glm::dvec2(-0.08, -0.002)), written_m);
    EXPECT_LT(glm::distance(*above, glm::dvec2(-0.08, 0.0)), written_m);
    const std::optional<glm::dvec2> tag = middle_of(svg, "tag plate", 0),
                                    front = middle_of(svg, "tag plate", 2);
    ASSERT_TRUE(tag && front);
    EXPECT_LT(glm::distance(*tag, glm::dvec2(-0.05, 0.03)), written_m);
    EXPECT_LT(glm::distance(*front, glm::dvec2(-0.004, 0.03)), written_m);
}

TEST(TorchSheet, DrawsOnlyThePartsOfItsSource) {
    settings::Settings settings = with_both();
    settings.torch.source = settings::TorchSource::Tracker;
    EXPECT_FALSE(middle_of(torch_sheet(settings, "kiosk.toml"), "tag plate", 0));
    settings.torch.source = settings::TorchSource::Camera;
    EXPECT_FALSE(middle_of(torch_sheet(settings, "kiosk.toml"), "sensor", 0));
    settings.torch.source = settings::TorchSource::None; // before it is chosen: as with a sensor
    EXPECT_TRUE(middle_of(torch_sheet(settings, "kiosk.toml"), "sensor", 0));
}

TEST(TorchSheet, TextsDoNotOverlapOrLeaveThePaper) {
    for (const settings::Settings& settings : {settings::Settings(), with_both()}) {
        const std::vector<SvgText> all = texts(torch_sheet(settings, "config/kiosk.toml"));
        EXPECT_GT(all.size(), 15U);
        for (std::size_t a = 0; a < all.size(); ++a) {
            EXPECT_TRUE(all[a].low.x > 10.0 && all[a].low.y > 10.0 && all[a].high.x < 410.0 &&
                        all[a].high.y < 287.0)
                << all[a].words;
            for (std::size_t b = a + 1; b < all.size(); ++b) {
                EXPECT_FALSE(all[a].meets(all[b])) << all[a].words << " / " << all[b].words;
            }
        }
    }
}

} // namespace
} // namespace frustumscreen::drawing

// A step takes the pressed buttons and the tracked state, and returns what is shown as plain values.
#include "app/exhibit/exhibit.h"

#include <gtest/gtest.h>

#include <array>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Exhibit) {
    // example
    using std::chrono::seconds;
    const MonotonicTime start{};
    const std::vector<glm::dvec2> sizes_m{glm::dvec2(0.2, 0.05)}; // of a caption
    const exhibit::CatalogueEntry artifact{{"en", "de"}, {sizes_m, sizes_m}};
    exhibit::ExhibitPlace place;
    place.prop = geometry::make_frustum({});
    place.picture_m = {{-0.4, -0.25}, {0.4, -0.25}, {0.4, 0.25}, {-0.4, 0.25}};
    exhibit::Exhibit exhibit({artifact, artifact, artifact}, place, "en", start);
    tracking::TrackedState tracked;
    tracked.prop_known = true;
    EXPECT_EQ(exhibit.step(start, {}, tracked).state, exhibit::State::Attract); // no visitor is present
    const std::array pressed{settings::Command::NextArtifact, settings::Command::NextLanguage};
    EXPECT_EQ(exhibit.step(start + seconds(1), pressed, tracked).state, exhibit::State::View);
    EXPECT_EQ(exhibit.chosen(), 1U);
    EXPECT_EQ(exhibit.language(), "de");
    // end
}

} // namespace
} // namespace frustumscreen::example

// A drift mark overlaps nothing that visitors are shown.
#include "app/show/mark_show.h"

#include <gtest/gtest.h>

namespace frustumscreen::show {
namespace {

constexpr double prop_m = 0.2;
const glm::dvec2 corner(-0.35, 0.2);

TEST(MarkShow, AvoidsThePropAndTheCaption) {
    exhibit::Presentation presentation;
    EXPECT_TRUE(has_space_for_mark(corner, presentation, prop_m));
    EXPECT_FALSE(has_space_for_mark({0.1, 0.1}, presentation, prop_m)) << "the prop stands there";
    presentation.table_from_prop.translation = {-0.3, 0.1, 0.0};
    EXPECT_FALSE(has_space_for_mark(corner, presentation, prop_m));
    EXPECT_TRUE(has_space_for_mark({0.1, 0.1}, presentation, prop_m));
    presentation.table_from_prop.translation = {};
    exhibit::PresentedCaption caption;
    caption.rectangle = {corner + glm::dvec2(0.05, 0.0), {0.1, 0.03}, 0};
    presentation.caption = caption;
    EXPECT_FALSE(has_space_for_mark(corner, presentation, prop_m));
}

TEST(MarkShow, AvoidsLitPictures) {
    exhibit::PresentedTable table;
    table.count = 1;
    table.places[0].place.picture = {corner, {0.06, 0.06}, 0};
    table.places[0].place.title = {corner - glm::dvec2(0.0, 0.05), {0.07, 0.02}, 0};
    exhibit::Presentation presentation;
    presentation.table = &table;
    EXPECT_TRUE(has_space_for_mark(corner, presentation, prop_m)) << "the place is empty";
    table.places[0].brightness = 0.5;
    EXPECT_FALSE(has_space_for_mark(corner, presentation, prop_m));
    EXPECT_TRUE(has_space_for_mark(-corner, presentation, prop_m));
}

} // namespace
} // namespace frustumscreen::show

// The section `hull`: written, read and refused.
#include "app/pack/pack_file.h"
#include "app/pack/pack_hull.h"
#include "tests/base/told.h"
#include "tests/pack/samples.h"

#include <gtest/gtest.h>

namespace frustumscreen::pack {
namespace {

const std::vector<glm::dvec3> corners{
    {0.5, 0.0, 0.0}, {0.1, 0.2, 0.0}, {0.0, 0.0, 1.0}, {-0.25, 0.5, 1.0 / 3.0}};

TEST(PackHull, RoundTripsAndScalesIntoAProp) {
    Pack pack = samples::pack();
    put_hull(corners, pack);
    const auto back = verify_pack(*write_pack(pack));
    ASSERT_TRUE(back);
    EXPECT_EQ(hull_of(**back).value(), corners);
    const geometry::PropShape prop = geometry::make_frustum({});
    const double scale = place(pack, prop).metres_per_box;
    EXPECT_EQ(hull_in(**back, prop).value()[0], scale * corners[0]);
}

TEST(PackHull, IsTheBoxWithoutAHullSection) {
    const Pack pack = samples::pack();
    const std::vector<glm::dvec3> box = hull_of(pack).value();
    ASSERT_EQ(box.size(), 8U);
    EXPECT_EQ(box[0], glm::dvec3(-0.5, -0.5, 0.0) * pack.box_size);
    EXPECT_EQ(box[7], glm::dvec3(0.5, 0.5, 1.0) * pack.box_size);
}

TEST(PackHull, RejectsMalformedData) {
    const auto refusal = [](const std::string& data) {
        Pack pack = samples::pack();
        pack.sections.push_back({"hull", data, {}});
        const auto hull = hull_of(pack);
        EXPECT_FALSE(hull) << data;
        return hull ? std::string() : test::told(hull.error());
    };
    EXPECT_NE(refusal(R"({"corners":[]})").find("has no corner"), std::string::npos);
    EXPECT_NE(refusal(R"({"corners":[[0,0,3]]})").find("farther than 2"), std::string::npos);
    EXPECT_NE(refusal(R"({"corners":[[0,0]]})").find("sections.hull.data.corners"), std::string::npos);
    EXPECT_NE(refusal(R"({"corners":[[0,0,1]],"more":1})").find("sections.hull.data.more"),
              std::string::npos);
    EXPECT_NE(refusal("{}").find("sections.hull.data.corners"), std::string::npos);
}

} // namespace
} // namespace frustumscreen::pack

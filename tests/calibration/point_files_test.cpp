#include "app/calibration/point_files.h"
#include "tests/base/told.h"

#include <gtest/gtest.h>

namespace frustumscreen::calibration {
namespace {

constexpr const char* touch_header = "tx_m,ty_m,tz_m,qw,qx,qy,qz,u_px,v_px,block_m\n";
constexpr const char* corner_header = "distance,corner,x_m,y_m,z_m\n";

std::string touch_error(const std::string& rows) {
    const auto read = parse_touches(touch_header + rows, "t.csv");
    return read ? "" : test::told(read.error());
}

TEST(PointFiles, ParsesATouch) {
    const auto read = parse_touches(std::string("# by hand\n") + touch_header +
                                        "0.1,-0.2,0.3,0.5,-0.5,0.5,-0.5,100.5,200,0.04\n",
                                    "t.csv");
    ASSERT_TRUE(read);
    ASSERT_EQ(read->size(), 1U);
    const Touch& touch = (*read)[0];
    EXPECT_EQ(touch.tracker_from_sensor.translation, glm::dvec3(0.1, -0.2, 0.3));
    EXPECT_EQ(touch.tracker_from_sensor.rotation, glm::dquat(0.5, -0.5, 0.5, -0.5));
    EXPECT_EQ(touch.pixel, glm::dvec2(100.5, 200.0));
    EXPECT_EQ(touch.block_m, 0.04);
}

TEST(PointFiles, TouchesRoundTrip) {
    const Touches touches{{{glm::dquat(0.5, -0.5, 0.5, -0.5), {0.1, -0.2, 1.0 / 3.0}}, {100.5, 200.0}, 0.04},
                          {{glm::dquat(1.0, 0.0, 0.0, 0.0), {1e-9, 0.0, -7.0}}, {0.5, 799.5}, 0.0}};
    const auto read = parse_touches(touches_text(touches), "t.csv");
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ((*read)[k].tracker_from_sensor.translation, touches[k].tracker_from_sensor.translation);
        EXPECT_EQ((*read)[k].tracker_from_sensor.rotation, touches[k].tracker_from_sensor.rotation);
        EXPECT_EQ((*read)[k].pixel, touches[k].pixel);
        EXPECT_EQ((*read)[k].block_m, touches[k].block_m);
    }
}

TEST(PointFiles, ReportsErrorsInTouchesWithTheirLine) {
    EXPECT_NE(touch_error("1,2,3\n").find("t.csv:2: the row has 3 fields"), std::string::npos);
    EXPECT_NE(touch_error("0,0,0,1,0,0,x,1,2,0\n").find("t.csv:2: qz is"), std::string::npos);
    EXPECT_NE(touch_error("0,0,0,1,0,0,nan,1,2,0\n").find("qz is"), std::string::npos);
    EXPECT_FALSE(parse_touches("tx_mm,ty_m\n", "t.csv"));
    EXPECT_FALSE(parse_touches("", "t.csv"));
}

TEST(PointFiles, RejectsQuaternionsThatAreNoRotation) {
    const auto touch_of = [](const std::string& turn) { return touch_error("0,0,0," + turn + ",1,2,0\n"); };
    EXPECT_NE(touch_of("0,0,0,0").find("t.csv:2: qw,qx,qy,qz are not a rotation"), std::string::npos);
    EXPECT_NE(touch_of("90,0,0,0").find("90; are these angles in degrees?"), std::string::npos);
    EXPECT_NE(touch_of("1.03,0,0,0").find("[points.no_rotation]"), std::string::npos);
    const auto rounded = parse_touches(std::string(touch_header) + "0,0,0,0.6,0.79,0,0,1,2,0\n", "t.csv");
    ASSERT_TRUE(rounded);
    EXPECT_NEAR(glm::length((*rounded)[0].tracker_from_sensor.rotation), 1.0, 1e-15);
    const std::string rest_rows =
        "rest,tx_m,ty_m,tz_m,qw,qx,qy,qz,x_m,y_m,z_m,u_px,v_px,block_m\n1,0,0,0,0.5,0,0,0,0,0,0,1,2,0\n";
    const auto rest = parse_rests(rest_rows, "r.csv");
    ASSERT_FALSE(rest);
    EXPECT_NE(rest.error().message.find("r.csv:2: qw,qx,qy,qz are not a rotation"), std::string::npos);
}

TEST(PointFiles, SightsRoundTrip) {
    const ReportedSights sights{
        {OpenEye::Left, {{0.6, 0.0, 0.8, 0.0}, {0.1, -0.2, 1.0 / 3.0}}, {100.25, 2e-7}, {0.04, 0.05, 0.155}},
        {OpenEye::Right, {{1.0, 0.0, 0.0, 0.0}, {1e-9, 0.0, -7.0}}, {5.0, 6.0}, {0.0, 0.0, 0.12}}};
    const auto read = parse_sights(sights_text(sights), "s.csv");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(sights_text(*read), sights_text(sights));
    EXPECT_EQ((*read)[1].eye, OpenEye::Right);
    EXPECT_EQ((*read)[0].pixel, sights[0].pixel);
    EXPECT_EQ((*read)[0].tip_m, sights[0].tip_m);
}

TEST(PointFiles, ParsesCornerNames) {
    const auto read = parse_corners(std::string(corner_header) + "2,bottom_left,0.1,0.2,0\n", "c.csv");
    ASSERT_TRUE(read);
    EXPECT_EQ((*read)[0].corner, PictureCorner::BottomLeft);
    EXPECT_EQ((*read)[0].distance, 2);
    EXPECT_FALSE(parse_corners(std::string(corner_header) + "1,left,0,0,0\n", "c.csv"));
    EXPECT_FALSE(parse_corners(std::string(corner_header) + "0,top_left,0,0,0\n", "c.csv"));
}

constexpr const char* rest_header = "rest,tx_m,ty_m,tz_m,qw,qx,qy,qz,x_m,y_m,z_m,u_px,v_px,block_m\n";

std::string rest_error(const std::string& rows) {
    const auto read = parse_rests(rest_header + rows, "r.csv");
    return read ? "" : test::told(read.error());
}

TEST(PointFiles, GroupsRowsByRestNumber) {
    const auto read =
        parse_rests(std::string(rest_header) + "7,0.1,0.2,0.3,1,0,0,0,0.01,0.02,0,100,200.5,0.04\n"
                                               "9,0.5,0.2,0.3,1,0,0,0,0.01,0.02,0,300,200.5,\n"
                                               "7,0.1,0.2,0.3,1,0,0,0,0.03,0.02,0.1,110,201,0.04\n",
                    "r.csv");
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->size(), 2U);
    const Rest& first = (*read)[0];
    EXPECT_EQ(first.name, 7);
    EXPECT_EQ(first.tracker_from_sensor.translation, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(first.block_m, 0.04);
    ASSERT_EQ(first.points.size(), 2U);
    EXPECT_EQ(first.points[1].prop_m, glm::dvec3(0.03, 0.02, 0.1));
    EXPECT_EQ(first.points[1].pixel, glm::dvec2(110.0, 201.0));
    EXPECT_EQ((*read)[1].name, 9);
    EXPECT_FALSE((*read)[1].block_m);
}

TEST(PointFiles, RestsRoundTrip) {
    const Rests rests{{3,
                       {{0.6, 0.0, 0.8, 0.0}, {0.1, -0.2, 1.0 / 3.0}},
                       {{{0.01, 0.02, 0.0}, {100.25, 2e-7}}, {{0.0, 0.0, 0.155}, {1.0, 2.0}}},
                       0.003},
                      {4, {}, {{{0.01, 0.0, 0.0}, {5.0, 6.0}}}, std::nullopt}};
    const auto read = parse_rests(rests_text(rests), "r.csv");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(rests_text(*read), rests_text(rests));
    EXPECT_EQ((*read)[0].tracker_from_sensor.translation, rests[0].tracker_from_sensor.translation);
    EXPECT_EQ((*read)[0].points[0].pixel, rests[0].points[0].pixel);
    EXPECT_EQ((*read)[0].block_m, 0.003);
    EXPECT_FALSE((*read)[1].block_m);
}

TEST(PointFiles, ReportsErrorsInRestsWithTheirLine) {
    const std::string good = "1,0,0,0,1,0,0,0,0,0,0,1,2,0\n";
    EXPECT_EQ(rest_error(good), "");
    EXPECT_NE(rest_error("x,0,0,0,1,0,0,0,0,0,0,1,2,0\n").find("r.csv:2: rest is"), std::string::npos);
    EXPECT_NE(rest_error("-1,0,0,0,1,0,0,0,0,0,0,1,2,0\n").find("rest is"), std::string::npos);
    EXPECT_NE(rest_error(good + "1,0,0,0,1,0,0,0,0,,0,1,2,0\n").find("r.csv:3: y_m is"), std::string::npos);
    EXPECT_NE(rest_error(good + "1,0,0,0.1,1,0,0,0,0,0,0,1,2,0\n").find("[points.rest_moved]"),
              std::string::npos);
    EXPECT_NE(rest_error(good + "1,0,0,0,1,0,0,0,0,0,0,1,2,\n").find("[points.rest_moved]"),
              std::string::npos);
    EXPECT_NE(rest_error("1,2\n").find("2 fields"), std::string::npos);
    EXPECT_FALSE(parse_rests("rest,x\n", "r.csv"));
}

} // namespace
} // namespace frustumscreen::calibration

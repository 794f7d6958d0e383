// The picture of a calibration's uncertainty shows the computed values.
#include "app/programs/calibrate/uncertainty_picture.h"
#include "tests/calibration/simulated_touches.h"

#include <gtest/gtest.h>

namespace frustumscreen::calibration {
namespace {

constexpr double top_m = 0.12;

/// A projector that looks straight down, so that its picture is undistorted on the table; the uncertainty
/// rises from 0.1 mm at the left edge to 1 mm at the right one, and is half of it at the prop's top.
TouchCalibration slope() {
    TouchCalibration calibration;
    calibration.verdict = Verdict::Usable;
    CalibratedTable& table = calibration.table.emplace();
    table.pinhole = {1920, 1200, 3000.0, 3000.0, 960.0, 600.0};
    table.table_from_projector = {{0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 2.0}};
    for (const double height : {0.0, 0.5 * top_m, top_m}) {
        for (std::size_t k = 0; k < zone_columns * zone_rows; ++k) {
            const glm::dvec2 share(static_cast<double>(k % zone_columns) / (zone_columns - 1),
                                   static_cast<double>(k / zone_columns) / (zone_rows - 1));
            const double rms_m = 1e-3 * (0.1 + 0.9 * share.x) * (height > 0.1 ? 0.5 : 1.0);
            calibration.zone.push_back({share * glm::dvec2(1920.0, 1200.0), height, rms_m});
        }
    }
    calibration.uncertainty = {0.5e-3, 1e-3};
    return calibration;
}

/// Index of the legend's colour at a pixel; steps are 0.15 mm if the worst place has 1 mm.
int legend_step(const image::Image8& picture, int x, int y) {
    for (int k = 0; k < 8; ++k) {
        if (picture.at(70 + 90 * k + 45, 796 + 15) == picture.at(x, y)) {
            return k;
        }
    }
    return -1;
}

TEST(UncertaintyPicture, ColoursShowTheUncertaintyOfEachPlace) {
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open();
    ASSERT_TRUE(typesetter);
    const image::Image8 picture =
        programs::uncertainty_picture(*programs::map_of(slope()), {}, top_m, *typesetter);
    // The fields' middles are at x = 420 and 1180, y = 440; the picture on the table fills 96 % of a field's width of 700.
    constexpr double width_px = 0.96 * 700.0;
    for (const double share : {0.1, 0.5, 0.8}) {
        const double mm = 0.1 + 0.9 * share;
        const double at_px = (share - 0.5) * width_px;
        const double nearer = (2.0 - top_m) / 2.0; // the picture at the prop's top is smaller
        EXPECT_EQ(legend_step(picture, static_cast<int>(420.0 + at_px), 400), static_cast<int>(mm / 0.15));
        EXPECT_EQ(legend_step(picture, static_cast<int>(1180.0 + nearer * at_px), 400),
                  static_cast<int>(0.5 * mm / 0.15));
    }
    EXPECT_EQ(legend_step(picture, 420 - 345, 400), -1) << "the light does not reach beside the picture";
}

/// True if anything but paper is along the picture's edge.
bool is_cut_off(const image::Image8& picture) {
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const bool is_edge = x < 20 || y < 20 || x >= picture.width - 20 || y >= picture.height - 20;
            if (is_edge && picture.at(x, y) != glm::u8vec4(255)) {
                return true;
            }
        }
    }
    return false;
}

TEST(UncertaintyPicture, WordsAndCrossesStayInsideThePicture) {
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open();
    ASSERT_TRUE(typesetter);
    ChosenCrosses crosses;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const simulators::SimulatedTable table = simulators::some_table(seed);
        simulators::SeededNumbers numbers(seed);
        const Touches touches = touches_of(table, crosses.of(table, 9), {}, numbers);
        const TouchCalibration found = calibrate_touch(touches, setup_for(table));
        ASSERT_TRUE(found.table);
        ASSERT_EQ(found.zone.size(), 3 * zone_columns * zone_rows);
        const image::Image8 picture = programs::uncertainty_picture(
            *programs::map_of(found), programs::places_of(touches), top_m, *typesetter);
        EXPECT_FALSE(is_cut_off(picture)) << "table " << seed;
    }
}

/// By hand: the measured places are the picture's own corners, and those on the board are at the prop's top.
TEST(UncertaintyPicture, DrawsCrossesAtTheMeasuredCorners) {
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open();
    ASSERT_TRUE(typesetter);
    CornerCalibration found;
    found.pinhole = slope().table->pinhole;
    found.table_from_projector = slope().table->table_from_projector;
    std::vector<MeasuredCorner> corners;
    for (int k = 0; k < 8; ++k) {
        corners.push_back({1 + k / 4, static_cast<PictureCorner>(k % 4), {0.0, 0.0, 0.4 * (k / 4)}});
    }
    const CornerUncertainty uncertainty{1e-3, slope().uncertainty, slope().zone};
    const auto map = programs::map_of(found, uncertainty);
    const image::Image8 picture =
        programs::uncertainty_picture(*map, programs::places_of(corners, 1920, 1200), top_m, *typesetter);
    EXPECT_FALSE(is_cut_off(picture));
    // The picture is 1.28 x 0.8 m on the table, and fills 96 % of a field's width of 700; the fields' middles
    // are at x = 420 and 1180, y = 440.
    constexpr double half_px = 0.5 * 0.96 * 700.0;
    constexpr double nearer = (2.0 - top_m) / 2.0;
    const glm::u8vec4 ink(34, 40, 49, 255);
    for (const double right : {-1.0, 1.0}) {
        for (const double up : {-1.0, 1.0}) {
            EXPECT_EQ(picture.at(static_cast<int>(420.0 + right * half_px),
                                 static_cast<int>(440.0 - up * half_px * 0.625)),
                      ink);
            EXPECT_EQ(picture.at(static_cast<int>(1180.0 + right * half_px * nearer),
                                 static_cast<int>(440.0 - up * half_px * 0.625 * nearer)),
                      ink);
        }
    }
}

} // namespace
} // namespace frustumscreen::calibration

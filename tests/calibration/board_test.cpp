// The board of the automatic calibration, and its printed sheet.
#include "app/calibration/board.h"
#include "app/calibration/procedure/board_view.h"
#include "app/drawing/board/board_sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <string>

namespace frustumscreen::calibration {
namespace {

constexpr geometry::FrustumSize sizes[] = {
    {0.30, 0.08, 0.155}, {0.16, 0.09, 0.12}, {0.20, 0.20, 0.20}, {0.10, 0.05, 0.10}, {0.33, 0.06, 0.2}};

/// The sheet as printed: its black rectangles, at some pixels per millimetre.
struct Print {
    static constexpr int per_mm = 4;
    int width = 420 * per_mm;
    int height = 297 * per_mm;
    std::vector<std::uint8_t> luma = std::vector<std::uint8_t>(static_cast<std::size_t>(width * height), 255);

    explicit Print(const std::string& svg) {
        const std::regex rectangle(
            R"re(<polygon points="([-0-9.]+),([-0-9.]+) [^ ]+ ([-0-9.]+),([-0-9.]+) [^"]+" [^>]*fill="#000000")re");
        for (auto it = std::sregex_iterator(svg.begin(), svg.end(), rectangle); it != std::sregex_iterator();
             ++it) {
            const auto pixel = [&](std::size_t k) {
                return static_cast<int>(std::lround(per_mm * std::stod((*it)[k])));
            };
            for (int y = std::max(0, pixel(2)); y < std::min(height, pixel(4)); ++y) {
                for (int x = std::max(0, pixel(1)); x < std::min(width, pixel(3)); ++x) {
                    luma[static_cast<std::size_t>(y * width + x)] = 0;
                }
            }
        }
    }
};

TEST(Board, DetectorFindsTagsAtTheirListedPlaces) {
    for (const geometry::FrustumSize& size : sizes) {
        const Result<Board> board = board_for(size);
        ASSERT_TRUE(board) << board.error().message;
        const Print print(drawing::board_sheet(*board, "some.toml"));
        tags::TagDetector detector;
        std::vector<tags::FoundTag> found;
        detector.find(print.luma, print.width, print.height, found);
        const std::vector<tags::FoundTag> tags = tags_of(*board, found);
        EXPECT_EQ(tags.size(), board->tags.size()) << size.base_m;
        for (const tags::FoundTag& tag : tags) {
            const auto known = std::find_if(board->tags.begin(), board->tags.end(),
                                            [&](const tags::PropTag& each) { return each.id == tag.id; });
            for (std::size_t k = 0; k < 4; ++k) {
                const glm::dvec2 at =
                    (tag.corners_px[k] / double{Print::per_mm} - glm::dvec2(210.0, 148.5)) * 1e-3;
                const glm::dvec2 expected(known->corners()[k]);
                if (known->id != board->top().id) {
                    EXPECT_NEAR(at.x, expected.x, 2e-4) << size.base_m << " tag " << tag.id;
                    EXPECT_NEAR(-at.y, expected.y, 2e-4) << size.base_m << " tag " << tag.id;
                }
            }
            EXPECT_NEAR(glm::distance(tag.corners_px[0], tag.corners_px[1]) / Print::per_mm,
                        1e3 * known->size_m, 0.3);
        }
    }
}

TEST(Board, TagsLieOnTheSheetBesideTheProp) {
    for (const geometry::FrustumSize& size : sizes) {
        const Board board = *board_for(size);
        for (std::size_t k = 0; k + 1 < board.tags.size(); ++k) {
            for (const glm::dvec3& corner : board.tags[k].corners()) {
                EXPECT_TRUE(std::abs(corner.x) > 0.5 * size.base_m || std::abs(corner.y) > 0.5 * size.base_m);
                EXPECT_LT(std::abs(corner.x), 0.5 * Board::size_m.x);
                EXPECT_LT(std::abs(corner.y), 0.5 * Board::size_m.y);
            }
            for (std::size_t j = 0; j < k; ++j) {
                const glm::dvec3 off = glm::abs(board.tags[k].prop_from_tag.translation -
                                                board.tags[j].prop_from_tag.translation);
                EXPECT_GT(std::fmax(off.x, off.y), 1.25 * board.tags[k].size_m - 1e-9);
            }
        }
        EXPECT_LE(board.top().size_m * 1.25, size.top_m);
        EXPECT_EQ(board.top().prop_from_tag.translation.z, size.height_m);
    }
}

TEST(Board, RejectsPropsWithoutRoomForTags) {
    EXPECT_EQ(board_for({0.36, 0.08, 0.15}).error().message,
              "the prop's bottom is 360 mm wide, which leaves no room for tags on a sheet of A3; allowed are "
              "at most 339 mm");
    EXPECT_EQ(board_for({0.16, 0.03, 0.15}).error().message,
              "the prop's top is 30 mm wide, which is too small for a tag; allowed are at least 35 mm");
    EXPECT_TRUE(board_for({0.339, 0.0353, 0.15}));
}

} // namespace
} // namespace frustumscreen::calibration

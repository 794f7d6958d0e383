// Decodes captures of another program's stripes, in procam-calibration's layout: Gray code down to stripes of
// one pixel, columns then rows, each bit and its inverse from the highest on, then white and black; no
// cosine.
//
// The figures of docs/calibration.md, with a copy of github.com/kamino410/procam-calibration:
//     export FRUSTUMSCREEN_CAPTURES=procam-calibration/sample_data
//     build/release/tests/calibration_auto_test --gtest_also_run_disabled_tests --gtest_filter='RealCaptures.*'
#include "app/calibration/gray_code.h"
#include "app/calibration/homography.h"
#include "app/image/image.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numbers>

namespace frustumscreen::calibration {
namespace {

using Grey = std::vector<std::uint8_t>;
using Places = std::vector<Eigen::Vector2d>;
/// A flat paper's corners in the camera's picture, clockwise from the top left one.
using Paper = std::array<glm::dvec2, 4>;

/// Stripes of one pixel are half a period, so the period is 2; the cosine has 3 steps.
StripeSetup stripes_of(int width, int height) {
    return {width, height, 2, 3};
}

struct Captured {
    int width = 0;
    int height = 0;
    std::vector<Grey> pictures; ///< in the order of patterns_of, without the cosines
};

std::filesystem::path picture_name(const std::filesystem::path& folder, std::size_t number) {
    return folder / fmt::format("graycode_{:02}.png", number);
}

Captured read_captures(const StripeSetup& stripes, const std::filesystem::path& folder) {
    Captured captured;
    for (const Pattern& pattern : patterns_of(stripes)) {
        if (pattern.stripes == Stripes::Cosine) {
            continue;
        }
        const std::filesystem::path file = picture_name(folder, captured.pictures.size());
        const Result<Bytes> bytes = read_file(file);
        const auto image = bytes ? image::decode_png8(*bytes) : tl::unexpected<Error>(bytes.error());
        if (!image) {
            ADD_FAILURE() << image.error().message;
            return {};
        }
        captured.width = image->width;
        captured.height = image->height;
        Grey& grey = captured.pictures.emplace_back();
        for (const glm::u8vec4& texel : image->texels) {
            grey.push_back(texel.r);
        }
    }
    return captured;
}

/// Adds the cosines as if each pixel showed the middle of its code's stripe.
std::vector<Grey> with_cosines(const StripeSetup& stripes, const Captured& captured) {
    const Grey& white = captured.pictures[captured.pictures.size() - 2];
    const Grey& black = captured.pictures.back();
    std::vector<Grey> all;
    std::vector<int> codes;
    std::size_t next = 0;
    for (const Pattern& pattern : patterns_of(stripes)) {
        if (pattern.stripes != Stripes::Cosine) {
            all.push_back(captured.pictures[next++]);
            if (pattern.stripes == Stripes::InverseBit) {
                codes.resize(all.back().size());
                for (std::size_t k = 0; k < codes.size();
                     ++k) { // a bit of the Gray code inverts the ones below it
                    const bool bit = all[all.size() - 2][k] > all.back()[k];
                    codes[k] = 2 * codes[k] + ((codes[k] & 1) != (bit ? 1 : 0) ? 1 : 0);
                }
            }
            continue;
        }
        Grey& cosine = all.emplace_back();
        for (std::size_t k = 0; k < codes.size(); ++k) {
            const double phase = (codes[k] + 0.5) / stripes.period_px - double(pattern.which) / stripes.steps;
            const double share = 0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * phase);
            const double grey = black[k] + std::fmax(0.0, white[k] - black[k]) * share;
            cosine.push_back(static_cast<std::uint8_t>(std::lround(std::fmin(grey, 254.0))));
        }
        if (pattern.which == stripes.steps - 1) {
            codes.clear(); // the rows begin again
        }
    }
    return all;
}

bool is_on(const Paper& paper, const glm::dvec2& place) {
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec2 side = paper[(k + 1) % 4] - paper[k];
        const glm::dvec2 to = place - paper[k];
        if (side.x * to.y - side.y * to.x < 0.0) {
            return false;
        }
    }
    return true;
}

struct Figures {
    double believed = 0.0;  ///< decoded share of the paper's pixels with a contrast of 12 grey levels or more
    double on_paper = 0.0;  ///< share of those within three pixels of the paper's homography
    double off_px = 0.0;    ///< root mean square of these, per coordinate
    double blocks_px = 0.0; ///< the same for means over 20 x 20 camera pixels
};

double rms(const Places& offs) {
    double squares = 0.0;
    for (const Eigen::Vector2d& off : offs) {
        squares += 0.5 * off.squaredNorm() / static_cast<double>(offs.size());
    }
    return std::sqrt(squares);
}

/// Fits a homography repeatedly to nearer points only, so that points off the paper do not count.
std::vector<bool> near_homography(const Places& from, const Places& to, Places& offs) {
    std::vector<bool> near(from.size(), true);
    for (const double limit : {30.0, 10.0, 3.0, 3.0}) {
        Places some_from;
        Places some_to;
        for (std::size_t k = 0; k < from.size(); ++k) {
            if (near[k]) {
                some_from.push_back(from[k]);
                some_to.push_back(to[k]);
            }
        }
        const auto fitted = homography(some_from, some_to);
        offs.clear();
        for (std::size_t k = 0; fitted && k < from.size(); ++k) {
            offs.push_back(to[k] - mapped(*fitted, from[k]));
            near[k] = offs.back().norm() < limit;
        }
    }
    return near;
}

Figures figures_of(const StripeSetup& stripes, const std::filesystem::path& folder, const Paper& paper) {
    const Captured captured = read_captures(stripes, folder);
    if (captured.pictures.empty()) {
        return {};
    }
    const std::vector<Grey> pictures = with_cosines(stripes, captured);
    const PixelMap map =
        decode(stripes, {captured.width, captured.height, {pictures.begin(), pictures.end()}});
    const Grey& white = captured.pictures[captured.pictures.size() - 2];
    const Grey& black = captured.pictures.back();
    Places from;
    Places to;
    double lit = 0.0;
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const auto k = static_cast<std::size_t>(y * map.width + x);
            if (!is_on(paper, {x + 0.5, y + 0.5}) || white[k] - black[k] < 12) {
                continue;
            }
            lit += 1.0;
            if (map.known[k] != 0) {
                from.push_back({x + 0.5, y + 0.5});
                to.push_back({map.pixels[k].x, map.pixels[k].y});
            }
        }
    }
    Places all_offs;
    const std::vector<bool> near = near_homography(from, to, all_offs);
    Places offs;
    std::map<std::pair<int, int>, Places> blocks;
    for (std::size_t k = 0; k < all_offs.size(); ++k) {
        if (near[k]) {
            offs.push_back(all_offs[k]);
            blocks[{int(from[k].x()) / 20, int(from[k].y()) / 20}].push_back(all_offs[k]);
        }
    }
    Places means;
    for (const auto& [block, those] : blocks) {
        if (those.size() >= 200) { // at least half of the block
            Eigen::Vector2d& mean = means.emplace_back(Eigen::Vector2d::Zero());
            for (const Eigen::Vector2d& off : those) {
                mean += off / static_cast<double>(those.size());
            }
        }
    }
    return {static_cast<double>(from.size()) / lit,
            static_cast<double>(offs.size()) / static_cast<double>(from.size()), rms(offs), rms(means)};
}

/// The projector pixel at a camera pixel that sees a slanted sheet; the top of a box on it is lit by shifted
/// pixels.
glm::dvec2 rendered_pixel(const glm::dvec2& place) {
    const double w = 1.0 + 4e-4 * place.x - 3e-4 * place.y;
    const glm::dvec2 pixel((0.45 * place.x + 0.05 * place.y + 4.0) / w,
                           (-0.03 * place.x + 0.42 * place.y + 6.0) / w);
    const bool is_box = place.x > 100.0 && place.x < 120.0 && place.y > 60.0 && place.y < 80.0;
    return is_box ? pixel + glm::dvec2(5.0, 0.0) : pixel;
}

/// Writes rendered captures to files of the same layout, without blur: a camera pixel shows its centre's
/// value. On black print, two columns of each twenty, the light is a tenth.
void render_captures(const StripeSetup& stripes, const std::filesystem::path& folder, int width, int height) {
    std::filesystem::create_directories(folder);
    std::size_t number = 0;
    for (const Pattern& pattern : patterns_of(stripes)) {
        if (pattern.stripes == Stripes::Cosine) {
            continue;
        }
        image::Image8 image(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const glm::dvec2 pixel = rendered_pixel({x + 0.5, y + 0.5});
                const int value = pattern_value(stripes, pattern, int(pattern.rows ? pixel.y : pixel.x));
                const int grey = 20 + value / (x % 20 < 2 ? 20 : 2);
                image.at(x, y) = glm::u8vec4(grey, grey, grey, 255);
            }
        }
        ASSERT_TRUE(write_file(picture_name(folder, number++), image::encode_png(image)));
    }
}

TEST(RealCaptures, RenderedSheetDecodesToWholePixelsExceptTheBox) {
    const StripeSetup stripes = stripes_of(128, 96);
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "rendered_captures";
    render_captures(stripes, folder, 200, 160);
    const Paper paper{{{0.0, 0.0}, {200.0, 0.0}, {200.0, 160.0}, {0.0, 160.0}}};
    const Figures figures = figures_of(stripes, folder, paper);
    EXPECT_EQ(figures.believed, 1.0);
    EXPECT_NEAR(figures.on_paper, 1.0 - 20.0 * 20.0 / (200.0 * 160.0), 1e-3); // the box
    EXPECT_NEAR(figures.off_px, std::sqrt(1.0 / 12.0), 0.02);                 // whole pixels
    EXPECT_LT(figures.blocks_px, 0.05);
    std::filesystem::remove_all(folder);
}

/// The area of each chess board within its outermost inner corners, read by eye from graycode_40.png.
TEST(RealCaptures, DISABLED_ProcamCalibrationCapturesDecode) {
    const char* const folder = std::getenv("FRUSTUMSCREEN_CAPTURES");
    if (folder == nullptr) {
        GTEST_SKIP() << "FRUSTUMSCREEN_CAPTURES does not name the folder with capture_0 to capture_4";
    }
    const std::array<Paper, 5> papers{{{{{322, 272}, {884, 272}, {884, 693}, {320, 691}}},
                                       {{{477, 259}, {843, 203}, {797, 719}, {424, 706}}},
                                       {{{152, 193}, {701, 244}, {724, 696}, {170, 706}}},
                                       {{{447, 287}, {1021, 300}, {1026, 714}, {422, 703}}},
                                       {{{569, 104}, {980, 84}, {947, 701}, {528, 691}}}}};
    for (std::size_t k = 0; k < papers.size(); ++k) {
        const Figures figures = figures_of(
            stripes_of(1024, 768), std::filesystem::path(folder) / fmt::format("capture_{}", k), papers[k]);
        std::printf("capture_%d: believed %.1f %%, of these %.3f %% on the paper, off by %.3f pixels, means "
                    "over 20 x 20 "
                    "by %.3f\n",
                    static_cast<int>(k), 100.0 * figures.believed, 100.0 * figures.on_paper, figures.off_px,
                    figures.blocks_px);
        EXPECT_GT(figures.on_paper, 0.999);
        EXPECT_LT(figures.off_px, 0.35);
        EXPECT_LT(figures.blocks_px, 0.12);
    }
}

} // namespace
} // namespace frustumscreen::calibration

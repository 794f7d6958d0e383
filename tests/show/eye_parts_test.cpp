// The staff's pictures in stereo: each eye sees the whole picture in its part of the display's, and the alignment pattern
// tells the eyes apart. The colour allowed for each pixel follows from the picture without stereo alone; the letters are compared with
// the typeface's own.

#include "app/render/read_back.h"
#include "app/show/exhibit_place.h"
#include "app/show/staff_show.h"
#include "app/typography/canvas.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace frustumscreen::show {
namespace {

using settings::Stereo;
using std::chrono::seconds;

constexpr int width = 640, height = 400; // of the projector
constexpr double max_other = 0.7;        ///< correlation with the other letter
constexpr double min_own = 0.85;         ///< with its own: in a half the letter is a dozen pixels wide

struct StereoCase {
    Stereo stereo;
    PixelSize display;
    std::array<PixelRectangle, 2> eyes;
};
const std::array cases{
    StereoCase{Stereo::SideBySide, {640, 400}, {{{0, 0, 320, 400}, {320, 0, 320, 400}}}},
    StereoCase{Stereo::TopBottom, {640, 400}, {{{0, 0, 640, 200}, {0, 200, 640, 200}}}},
    StereoCase{Stereo::FrameSequential, {640, 800}, {{{0, 0, 640, 400}, {0, 400, 640, 400}}}},
};

image::Image8 part_of(const image::Image8& picture, const PixelRectangle& part) {
    image::Image8 cut(part.width, part.height);
    for (int y = 0; y < part.height; ++y) {
        for (int x = 0; x < part.width; ++x) {
            cut.at(x, y) = picture.at(part.x + x, part.y + y);
        }
    }
    return cut;
}

/// The least and the greatest code of the whole picture's pixels that fall on pixel (x, y) of an eye's part.
std::pair<glm::ivec3, glm::ivec3> codes_on(const image::Image8& whole, PixelSize part, int x, int y) {
    const int across = whole.width / part.width, down = whole.height / part.height;
    glm::ivec3 low(255), high(0);
    for (int v = 0; v < down; ++v) {
        for (int u = 0; u < across; ++u) {
            const glm::ivec3 code(whole.at(across * x + u, down * y + v));
            low = glm::min(low, code);
            high = glm::max(high, code);
        }
    }
    return {low, high};
}

/// The pixels of the eye's part that are not the whole picture's, shrunk.
image::Image<std::uint8_t> changed_in(const image::Image8& seen, const image::Image8& whole,
                                      int tolerance = 1) {
    image::Image<std::uint8_t> changed(seen.width, seen.height);
    for (int y = 0; y < seen.height; ++y) {
        for (int x = 0; x < seen.width; ++x) {
            const auto [low, high] = codes_on(whole, {seen.width, seen.height}, x, y);
            const glm::ivec3 code(seen.at(x, y));
            if (glm::any(glm::lessThan(code, low - tolerance)) ||
                glm::any(glm::greaterThan(code, high + tolerance))) {
                const glm::ivec3 off = glm::abs(code - low);
                changed.at(x, y) = static_cast<std::uint8_t>(std::max({off.x, off.y, off.z}));
            }
        }
    }
    return changed;
}

PixelRectangle bounds_of(const image::Image<std::uint8_t>& marked, int above = 0) {
    PixelRectangle bounds;
    for (int y = 0; y < marked.height; ++y) {
        for (int x = 0; x < marked.width; ++x) {
            if (marked.at(x, y) > above) {
                bounds = united(bounds, {x, y, 1, 1});
            }
        }
    }
    return bounds;
}

/// The letter as the typeface has it, scaled to the size.
image::Image<std::uint8_t> glyph(const char* letter, PixelSize size) {
    const image::Image<std::uint8_t> line = typography::Typesetter::open().value().line(letter, 400.0, true);
    const PixelRectangle ink = bounds_of(line, 127);
    image::Image<std::uint8_t> scaled(size.width, size.height);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            double sum = 0.0;
            constexpr int samples = 8;
            for (int k = 0; k < samples * samples; ++k) {
                const double u = (x + (k % samples + 0.5) / samples) / size.width;
                const double v = (y + (k / samples + 0.5) / samples) / size.height;
                sum += line.at(ink.x + static_cast<int>(u * ink.width),
                               ink.y + static_cast<int>(v * ink.height));
            }
            scaled.at(x, y) = static_cast<std::uint8_t>(sum / (samples * samples));
        }
    }
    return scaled;
}

double correlation(const image::Image<std::uint8_t>& a, const image::Image<std::uint8_t>& b) {
    const auto n = static_cast<double>(a.texels.size());
    double sum_a = 0.0, sum_b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
    for (std::size_t k = 0; k < a.texels.size(); ++k) {
        const double x = a.texels[k], y = b.texels.at(k);
        sum_a += x;
        sum_b += y;
        aa += x * x;
        bb += y * y;
        ab += x * y;
    }
    return (ab - sum_a * sum_b / n) / std::sqrt((aa - sum_a * sum_a / n) * (bb - sum_b * sum_b / n));
}

/// `marked` holds one letter and nothing else.
void expect_letter(const image::Image<std::uint8_t>& marked, const char* letter, const char* other) {
    const PixelRectangle bounds = bounds_of(marked);
    ASSERT_GE(bounds.height, height / 50) << "too small to read";
    ASSERT_GE(bounds.width, 6);
    ASSERT_LE(std::max(bounds.width, bounds.height), height / 8) << "something else has changed, too";
    const std::uint8_t brightest = *std::max_element(marked.texels.begin(), marked.texels.end());
    const std::array<float, 256>& light = image::linear_from_srgb8();
    const PixelRectangle ink = bounds_of(marked, image::srgb8_from_linear(0.5 * light[brightest]));
    image::Image<std::uint8_t> found(ink.width, ink.height);
    for (int y = 0; y < ink.height; ++y) {
        for (int x = 0; x < ink.width; ++x) {
            found.at(x, y) = static_cast<std::uint8_t>(
                std::lround(255.0F * light[marked.at(ink.x + x, ink.y + y)] / light[brightest]));
        }
    }
    EXPECT_GT(correlation(found, glyph(letter, {ink.width, ink.height})), min_own) << letter;
    EXPECT_LT(correlation(found, glyph(other, {ink.width, ink.height})), max_other) << other;
}

/// Settings, and pictures drawn with them.
class Eyes : public testing::Test {
protected:
    void SetUp() override {
        settings.projector.pinhole = {width, height, 960.0, 960.0, width / 2.0, height / 2.0};
        aside.table_from_prop.translation = {-0.6, 0.0, 0.0}; // its edges are far from the letters
    }
    void use(Stereo stereo, PixelSize size) {
        settings.eye.stereo = stereo;
        display.reset();
        display = display::SurfacelessDisplay::create(size.width, size.height).value();
    }
    render::DrawResult draw(PatternShow& show, const tracking::TrackedState& state,
                            render::Redraw redraw = render::Redraw::Everything) {
        return show.draw({}, state, {display->framebuffer(), display->buffer_age()}, redraw);
    }
    [[nodiscard]] image::Image8 shown() const {
        return render::read_colour(display->framebuffer(), display->width(), display->height());
    }
    image::Image8 pattern(Stereo stereo, PixelSize size, const tracking::TrackedState& state) {
        use(stereo, size);
        const std::unique_ptr<PatternShow> show = PatternShow::create(settings).value();
        const render::DrawResult drawn = draw(*show, state);
        EXPECT_EQ(drawn.redrawn, (PixelRectangle{0, 0, size.width, size.height}));
        return shown();
    }
    image::Image8 plain(const tracking::TrackedState& state) {
        return pattern(Stereo::Off, {width, height}, state);
    }

    settings::Settings settings;
    std::unique_ptr<display::SurfacelessDisplay> display;
    tracking::TrackedState aside;
};

TEST_F(Eyes, EachSeesTheWholePatternAndItsOwnLetterAlone) {
    const image::Image8 whole = plain(aside);
    for (const StereoCase& at : cases) {
        SCOPED_TRACE(settings::name_of(at.stereo));
        const image::Image8 picture = pattern(at.stereo, at.display, aside);
        const image::Image<std::uint8_t> left = changed_in(part_of(picture, at.eyes[0]), whole);
        const image::Image<std::uint8_t> right = changed_in(part_of(picture, at.eyes[1]), whole);
        expect_letter(left, "L", "R");
        expect_letter(right, "R", "L");
        const PixelRectangle l = bounds_of(left), r = bounds_of(right);
        EXPECT_TRUE(intersected(l, r).empty()) << "with both eyes open the letters stand side by side";
        EXPECT_LT(l.x, r.x);
    }
}

/// The picture is averaged, not thinned out: lines one pixel wide stay.
TEST_F(Eyes, OnePixelLinesStayVisibleInAHalf) {
    const image::Image8 beside = pattern(Stereo::SideBySide, {width, height}, aside);
    const image::Image8 below = pattern(Stereo::TopBottom, {width, height}, aside);
    for (int k = 20; k < 45; ++k) {                                    // between the ticks
        for (const int x : {0, width / 2 - 1, width / 2, width - 1}) { // the picture's outermost columns
            EXPECT_GT(beside.at(x, k).r, 100);
            EXPECT_LT(beside.at(x, k).r, 220);
        }
        for (const int y : {0, height / 2 - 1, height / 2, height - 1}) { // and rows
            EXPECT_GT(below.at(k, y).r, 100);
            EXPECT_LT(below.at(k, y).r, 220);
        }
    }
}

TEST_F(Eyes, AnaglyphDrawsTheLeftLetterInRedAndTheRightInCyan) {
    const image::Image8 whole = plain(aside);
    const image::Image8 picture = pattern(Stereo::Anaglyph, {width, height}, aside);
    std::array<image::Image<std::uint8_t>, 3> changed;
    changed.fill(image::Image<std::uint8_t>(width, height));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int k = 0; k < 3; ++k) {
                changed.at(static_cast<std::size_t>(k)).at(x, y) =
                    static_cast<std::uint8_t>(std::abs(picture.at(x, y)[k] - whole.at(x, y)[k]));
            }
        }
    }
    expect_letter(changed[0], "L", "R");
    expect_letter(changed[1], "R", "L");
    EXPECT_EQ(changed[1].texels, changed[2].texels) << "cyan";
}

/// A letter lies where the pattern is dark, at each size of the picture and of its grid.
TEST(EyeLetter, HidesNoMarkOfThePattern) {
    const typography::Typesetter typesetter = typography::Typesetter::open().value();
    const std::array sizes{PixelSize{1280, 800}, PixelSize{1920, 1080}, PixelSize{1920, 1200},
                           PixelSize{854, 480}, PixelSize{3840, 2160}};
    for (const PixelSize& size : sizes) {
        const typography::PatternScene scene{
            .projector = {size.width, size.height, 1.875 * size.width, 1.875 * size.width, 0.5 * size.width,
                          0.5 * size.height},
            .table_from_projector = settings::ProjectorSettings().table_from_projector,
            .table_size_m = {0.8, 0.5},
            .prop = geometry::make_frustum({})};
        const image::Image8 pattern = typography::table_pattern(scene, typesetter);
        int inked = 0;
        for (const typography::EyeLetter& letter : typography::eye_letters(pattern, typesetter)) {
            EXPECT_GE(letter.square.height, size.height / 20 - 1);
            EXPECT_EQ((letter.square.x | letter.square.y | letter.square.width) % 2, 0)
                << "it covers whole pixels of a half";
            for (int y = 0; y < letter.square.height; ++y) {
                for (int x = 0; x < letter.square.width; ++x) {
                    const glm::u8vec4 mark = pattern.at(letter.square.x + x, letter.square.y + y);
                    ASSERT_LE(std::max({mark.r, mark.g, mark.b}), 8) << size.width << ": " << x << ' ' << y;
                    inked += letter.coverage.at(x, y) > 128 ? 1 : 0;
                }
            }
        }
        EXPECT_GT(inked, size.height * size.height / 2000);
    }
}

/// The prop's edges are on top, wherever the prop stands.
TEST_F(Eyes, LettersDoNotHideTheProp) {
    const StereoCase& at = cases[2]; // pixel for pixel
    int crossed = 0;
    for (const double x_m : {0.05, 0.1, 0.15, 0.2, 0.25}) {
        tracking::TrackedState state;
        state.table_from_prop.translation = {x_m, 0.1, 0.0};
        const image::Image8 whole = plain(state);
        const image::Image8 picture = pattern(at.stereo, at.display, state);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                for (const PixelRectangle& eye : at.eyes) {
                    const glm::ivec3 code(picture.at(eye.x + x, eye.y + y)), mark(whole.at(x, y));
                    ASSERT_TRUE(glm::all(glm::greaterThanEqual(code, mark - 1)));
                    crossed += mark.g > 200 && code != mark ? 1 : 0;
                }
            }
        }
    }
    EXPECT_GT(crossed, 0) << "an edge never lay on a letter: this proves nothing";
}

TEST_F(Eyes, EachSeesEachPageOfTheStaffsPicture) {
    const auto page = [&](exhibit::StaffPage which) {
        const std::unique_ptr<StaffShow> show =
            StaffShow::create(settings, true, "a driver", exhibit::State::View).value();
        exhibit::StaffView view;
        view.page = which;
        view.light = exhibit::StaffLight::Greys;
        show->show({}, view, {}, {});
        static_cast<void>(show->draw({}, aside, {display->framebuffer(), 0}, render::Redraw::Everything));
        return shown();
    };
    std::size_t compared = 0;
    for (std::size_t k = 0; k < exhibit::staff_page_names.size(); ++k) {
        const auto which = static_cast<exhibit::StaffPage>(k);
        SCOPED_TRACE(exhibit::staff_page_names.at(k));
        use(Stereo::Off, {width, height});
        const image::Image8 whole = page(which);
        for (const StereoCase& at : cases) {
            use(at.stereo, at.display);
            const image::Image8 picture = page(which);
            if (which == exhibit::StaffPage::Place) { // it has other words, and the letters
                EXPECT_NE(part_of(picture, at.eyes[0]).texels, part_of(picture, at.eyes[1]).texels);
                continue;
            }
            for (const PixelRectangle& eye : at.eyes) {
                EXPECT_TRUE(bounds_of(changed_in(part_of(picture, eye), whole)).empty());
            }
            ++compared;
        }
        use(Stereo::Anaglyph, {width, height});
        EXPECT_EQ(page(which).texels == whole.texels, which != exhibit::StaffPage::Place);
    }
    EXPECT_EQ(compared, cases.size() * (exhibit::staff_page_names.size() - 1));
}

/// In so small a projector's picture the camera's lies at an odd pixel, so in a half it is shifted by half a pixel.
TEST_F(Eyes, EachSeesTheCamerasPicture) {
    constexpr int steepest = 4; // codes from pixel to pixel
    settings.camera.kind = settings::CameraKind::V4l2;
    const auto with_camera = [&](Stereo stereo, PixelSize size) {
        use(stereo, size);
        const std::unique_ptr<PatternShow> show = PatternShow::create(settings).value();
        Viewfinder viewfinder(viewfinder_area_px(settings.projector.pinhole), 0);
        camera::CameraFrame frame{MonotonicTime{}, 1, 200, 120, std::vector<std::uint8_t>(200 * 120)};
        for (std::size_t k = 0; k < frame.luma.size(); ++k) {
            const int column = static_cast<int>(k % 200);
            frame.luma[k] = static_cast<std::uint8_t>(2 + std::min(column, 199 - column));
        }
        viewfinder.want(true);
        viewfinder.use(frame);
        show->set_viewfinder(&viewfinder);
        static_cast<void>(draw(*show, aside));
        return shown();
    };
    const image::Image8 whole = with_camera(Stereo::Off, {width, height});
    ASSERT_NE(whole.texels, plain(aside).texels);
    for (const StereoCase& at : cases) {
        SCOPED_TRACE(settings::name_of(at.stereo));
        const image::Image8 picture = with_camera(at.stereo, at.display);
        expect_letter(changed_in(part_of(picture, at.eyes[0]), whole, steepest), "L", "R");
        expect_letter(changed_in(part_of(picture, at.eyes[1]), whole, steepest), "R", "L");
    }
}

TEST_F(Eyes, RedrawingAnUnchangedPatternAllocatesNothing) {
    if (!synthetic::allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted here";
    }
    for (const StereoCase& at : cases) {
        use(at.stereo, at.display);
        const std::unique_ptr<PatternShow> show = PatternShow::create(settings).value();
        static_cast<void>(draw(*show, aside));
        const long before = synthetic::allocations_so_far();
        for (int k = 0; k < 3; ++k) {
            EXPECT_TRUE(draw(*show, aside).drawn);
        }
        EXPECT_EQ(synthetic::allocations_so_far(), before);
    }
}

/// Where the projector stretches or alternates the picture, the buttons do not offer to measure the table.
TEST_F(Eyes, StaffFactsOfferMeasuringOnlyPixelForPixel) {
    settings.tracker.kind = settings::TrackerKind::Usb;
    const auto facts = [&] { return staff_facts({}, settings, "a driver", exhibit::State::View, 0); };
    for (const Stereo on_eye : {Stereo::Off, Stereo::SideBySide}) {
        settings.eye.stereo = on_eye;
        settings.projector.stereo = settings::OutputStereo::Off;
        EXPECT_FALSE(facts().stereo);
        EXPECT_TRUE(facts().measures_pixels);
        EXPECT_TRUE(exhibit_place(settings).staff_stays);
    }
    settings.projector.stereo = settings::OutputStereo::AsEye;
    for (const StereoCase& at : cases) {
        settings.eye.stereo = at.stereo;
        EXPECT_TRUE(facts().stereo);
        EXPECT_FALSE(facts().measures_pixels);
        EXPECT_FALSE(exhibit_place(settings).staff_stays);
    }
    settings.eye.stereo = Stereo::Anaglyph;
    EXPECT_TRUE(facts().stereo);
    EXPECT_TRUE(facts().measures_pixels) << "pixel for pixel";
}

} // namespace
} // namespace frustumscreen::show

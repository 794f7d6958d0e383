#include "app/relief/relief_painter.h"
#include "app/relief/resolve_row.h"
#include "app/relief/sample_light.h"
#include "tests/relief/subject.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::relief {
namespace {

template <typename Texel> PictureSpan<Texel> span_of(image::Image<Texel>& image) {
    return {image.texels.data(), image.width, image.height, image.width};
}

struct Painting {
    Subject subject;
    settings::Settings settings = bench::near_settings();
    geometry::PropShape prop = settings::make_prop(settings.prop);
    std::vector<bench::BenchPose> poses = bench::draw_poses(settings, prop, 3, 5).value();
    BlockRelief relief = subject.relief(128);

    [[nodiscard]] image::Image8 blank(const glm::u8vec4& fill) const {
        return {settings.projector.pinhole.width, settings.projector.pinhole.height, fill};
    }
    [[nodiscard]] RasterView view(const bench::BenchPose& pose) const {
        RasterView view;
        subject.show(view, settings, prop, pose);
        return view;
    }
};

bool has(const PixelRectangle& part, int x, int y) {
    return x >= part.x && x < part.x + part.width && y >= part.y && y < part.y + part.height;
}

TEST(Painter, PaintsTheRasterizedSamplesAndNothingOutsideItsRectangles) {
    const Painting painting;
    const glm::u8vec4 untouched(1, 2, 3, 4);
    ReliefPainter painter(2);
    BlockItems items;
    RasterSamples samples;
    for (const bench::BenchPose& pose : painting.poses) {
        const RasterView view = painting.view(pose);
        image::Image8 picture = painting.blank(untouched);
        const std::span<const PixelRectangle> painted =
            painter.paint(painting.relief, view, 1, span_of(picture));
        ASSERT_FALSE(painted.empty());
        for (const PixelRectangle& part : painted) {
            EXPECT_EQ(view.lit, united(view.lit, part));
        }
        const PixelRectangle& lit = view.lit;
        list_blocks(items, painting.relief, view);
        samples.begin(lit, 1);
        rasterize(samples, painting.relief, view, items);
        int met = 0;
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                const bool is_met = has(lit, x, y) && samples.nearness[samples.at(x, y)] > 0.0F;
                const bool inside = std::any_of(painted.begin(), painted.end(),
                                                [&](const PixelRectangle& part) { return has(part, x, y); });
                ASSERT_TRUE(inside || !is_met) << x << " " << y;
                met += is_met ? 1 : 0;
                const std::size_t at = is_met ? samples.at(x, y) : 0;
                const glm::u8vec4 expected =
                    !inside  ? untouched
                    : is_met ? colour_at(painting.relief, samples.block[at], samples.place[at])
                             : glm::u8vec4(0);
                ASSERT_EQ(picture.at(x, y), expected) << x << " " << y;
            }
        }
        EXPECT_GT(met, 1000);
    }
}

/// The first pose's blocks, rasterized with any number of samples.
struct PoseRaster {
    Painting painting;
    SampleLight light;
    BlockItems items;
    RasterSamples samples;
    RasterView view = painting.view(painting.poses[0]);
    BlockPages pages;

    PoseRaster() {
        list_blocks(items, painting.relief, view);
        pages.add(painting.relief);
    }
    void take(int count) {
        samples.begin(view.lit, count);
        rasterize(samples, painting.relief, view, items);
    }
};

TEST(Painter, ColoursAreTheSameForEachInstructionSet) {
    PoseRaster pose;
    const auto& [painting, light, items, samples, view, pages] = pose;
    for (const int count : {1, 2, 4, 8, 16}) {
        pose.take(count);
        std::vector<glm::u8vec4> best(static_cast<std::size_t>(view.lit.width));
        std::vector<glm::u8vec4> plain = best;
        for (int y = view.lit.y; y < view.lit.y + view.lit.height; ++y) {
            resolve_row(samples, pages, light, y, view.lit.x, plain, Outline::OverBlack, Instructions::Plain);
            resolve_row(samples, pages, light, y, view.lit.x, best);
            ASSERT_EQ(best, plain) << count << " " << y;
        }
    }
}

/// Reference per sample, with colour_at and in linear light: if all samples of a pixel show one cell, their
/// mean code is within the range of theirs; if they show several blocks, or some show nothing, the result is
/// their mean light.
TEST(Painter, PixelIsTheMeanOfItsSamples) {
    PoseRaster pose;
    const auto& [painting, light, items, samples, view, pages] = pose;
    for (const unsigned count : {2U, 4U, 16U}) {
        pose.take(static_cast<int>(count));
        std::vector<glm::u8vec4> codes(static_cast<std::size_t>(view.lit.width));
        int mixed = 0;
        int even = 0;
        for (int y = view.lit.y; y < view.lit.y + view.lit.height; ++y) {
            resolve_row(samples, pages, light, y, view.lit.x, codes);
            for (int x = view.lit.x; x < view.lit.x + view.lit.width; ++x) {
                glm::uvec3 sum(0);
                glm::u8vec4 low(255);
                glm::u8vec4 high(0);
                unsigned met = 0;
                bool one_block = true;
                for (unsigned k = 0; k < count; ++k) {
                    const std::size_t at = samples.at(x, y, k);
                    if (samples.nearness[at] > 0.0F) {
                        const glm::u8vec4 code =
                            colour_at(painting.relief, samples.block[at], samples.place[at]);
                        sum += light.light(code);
                        low = glm::min(low, code);
                        high = glm::max(high, code);
                        one_block = one_block && samples.block[at] == samples.block[samples.at(x, y)];
                        ++met;
                    }
                }
                const glm::u8vec4 shown = codes[static_cast<std::size_t>(x - view.lit.x)];
                if (met == 0) {
                    ASSERT_EQ(shown, glm::u8vec4(0)) << x << " " << y;
                } else if (met < count || !one_block) {
                    ++mixed;
                    ASSERT_EQ(shown, light.mean(sum, count)) << x << " " << y;
                } else {
                    ++even;
                    for (int channel = 0; channel < 4; ++channel) {
                        ASSERT_GE(shown[channel] + 1, low[channel]) << x << " " << y;
                        ASSERT_LE(shown[channel], high[channel] + 1) << x << " " << y;
                    }
                }
            }
        }
        EXPECT_GT(mixed, 500) << count;
        EXPECT_GT(even, 1000) << count;
    }
}

TEST(Painter, PictureDoesNotDependOnTheThreadCount) {
    const Painting painting;
    ReliefPainter alone(1);
    ReliefPainter together(5);
    for (const bench::BenchPose& pose : painting.poses) {
        const RasterView view = painting.view(pose);
        image::Image8 a = painting.blank({});
        image::Image8 b = a;
        for (const int samples : {1, 4}) {
            EXPECT_TRUE(std::ranges::equal(alone.paint(painting.relief, view, samples, span_of(a)),
                                           together.paint(painting.relief, view, samples, span_of(b))));
            EXPECT_EQ(a.texels, b.texels);
        }
    }
}

/// More threads than bands: the assignment is random, and some threads paint their first band in a later
/// picture.
TEST(Painter, RepaintingAllocatesNothing) {
    if (!synthetic::allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    const Painting painting;
    const RasterView view = painting.view(painting.poses.front());
    image::Image8 picture = painting.blank(glm::u8vec4(0));
    ReliefPainter painter(24);
    static_cast<void>(painter.paint(painting.relief, view, 4, span_of(picture)));
    const long before = synthetic::allocations_so_far();
    for (int k = 0; k < 200; ++k) {
        static_cast<void>(painter.paint(painting.relief, view, 4, span_of(picture)));
    }
    EXPECT_EQ(synthetic::allocations_so_far(), before);
}

TEST(Painter, HitPointsMatchTheRayCast) {
    const Painting painting;
    ReliefPainter painter(2);
    image::ImageFloat points(painting.settings.projector.pinhole.width,
                             painting.settings.projector.pinhole.height);
    const glm::dmat4 prop_from_box = glm::inverse(painting.subject.frame.box_from_file);
    for (const bench::BenchPose& pose : painting.poses) {
        painter.hit_points(painting.relief, painting.view(pose), span_of(points));
        const bench::TruthPicture truth =
            painting.subject.truth.cast(painting.prop, bench::view_of(painting.settings, pose), false);
        int near = 0;
        int far = 0;
        int one_sided = 0;
        for (std::size_t k = 0; k < points.texels.size(); ++k) {
            const bool is_true = truth.hit.texels[k] != 0;
            const bool is_met = std::isfinite(points.texels[k].x);
            one_sided += is_true != is_met ? 1 : 0;
            if (is_true && is_met) {
                const glm::dvec3 at(prop_from_box * glm::dvec4(points.texels[k], 1.0));
                const double off_m = glm::distance(at, glm::dvec3(truth.point_m.texels[k]));
                (off_m < 5e-4 ? near : far) += 1;
            }
        }
        EXPECT_GT(near, 1000);
        EXPECT_LT(far + one_sided, near / 100);
    }
}

/// Error in codes against 16 rays per pixel, over the artifact and the pixels around it.
double rmse(const image::Image8& picture, const bench::TruthPicture& truth) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t k = 0; k < picture.texels.size(); ++k) {
        if (truth.colour16.texels[k].a != 0 || truth.hit.texels[k] != 0) {
            const glm::dvec3 off = glm::dvec3(picture.texels[k]) - glm::dvec3(truth.colour16.texels[k]);
            sum += glm::dot(off, off) / 3.0;
            ++count;
        }
    }
    return std::sqrt(sum / count);
}

TEST(Painter, MoreSamplesReduceTheColourError) {
    const Painting painting;
    ReliefPainter painter(2);
    for (const bench::BenchPose& pose : painting.poses) {
        const bench::TruthPicture truth =
            painting.subject.truth.cast(painting.prop, bench::view_of(painting.settings, pose), true);
        double before = INFINITY;
        for (const int samples : {1, 2, 4, 8}) {
            image::Image8 picture = painting.blank({});
            painter.paint(painting.relief, painting.view(pose), samples, span_of(picture));
            const double now = rmse(picture, truth);
            EXPECT_LT(now, before) << samples;
            before = now;
        }
    }
}

TEST(Painter, SamplesChangeOutlinesButNotEvenAreas) {
    const Painting painting;
    ReliefPainter painter(2);
    const RasterView view = painting.view(painting.poses[0]);
    image::Image8 one = painting.blank({});
    image::Image8 many = one;
    painter.paint(painting.relief, view, 1, span_of(one));
    painter.paint(painting.relief, view, 16, span_of(many));
    int outlines = 0;
    for (int y = 1; y + 1 < one.height; ++y) {
        for (int x = 1; x + 1 < one.width; ++x) {
            bool even = true;
            for (const glm::ivec2 step :
                 {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
                even = even && one.at(x + step.x, y + step.y) == one.at(x, y);
            }
            if (even) {
                const glm::ivec4 off = glm::abs(glm::ivec4(many.at(x, y)) - glm::ivec4(one.at(x, y)));
                ASSERT_LE(std::max({off.r, off.g, off.b, off.a}), 1) << x << " " << y;
            }
            outlines += many.at(x, y) != one.at(x, y) ? 1 : 0;
        }
    }
    EXPECT_GT(outlines, 100);
}

TEST(SampleLight, TheMeanOfEqualCodesIsThatCode) {
    const SampleLight light;
    for (int code = 0; code < 256; ++code) {
        const glm::u8vec4 texel(static_cast<std::uint8_t>(code), 0, 255, 255);
        for (const unsigned count : {1U, 2U, 16U}) {
            EXPECT_EQ(light.mean(light.light(texel) * count, count), texel) << code;
        }
    }
}

TEST(SampleLight, MeanOfBlackAndWhiteIsCode188) {
    const SampleLight light;
    const glm::u8vec4 mean = light.mean(light.light(glm::u8vec4(255)), 2);
    EXPECT_EQ(mean, glm::u8vec4(188, 188, 188, 255)); // 0.5 linear, IEC 61966-2-1
}

} // namespace
} // namespace frustumscreen::relief

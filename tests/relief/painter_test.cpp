#include "app/relief/relief_painter.h"
#include "tests/relief/subject.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen {
namespace {

template <typename Texel> PictureSpan<Texel> span_of(Image<Texel>& image) {
    return {image.texels.data(), image.width, image.height, image.width};
}

struct Painting {
    Subject subject;
    Settings settings = near_settings();
    PropShape prop = make_prop(settings.prop);
    std::vector<BenchPose> poses = draw_poses(settings, prop, 3, 5).value();
    BlockRelief relief = subject.relief(128);

    [[nodiscard]] Image8 blank(const glm::u8vec4& fill) const {
        return {settings.projector.pinhole.width, settings.projector.pinhole.height, fill};
    }
    [[nodiscard]] CastView view(const BenchPose& pose) const {
        CastView view;
        subject.show(view, settings, prop, pose);
        return view;
    }
};

TEST(Painter, PaintsWhatIsCastAndNothingOutsideItsRectangle) {
    const Painting painting;
    const glm::u8vec4 untouched(1, 2, 3, 4);
    ReliefPainter painter(2);
    BlockItems items;
    CastPicture cast_picture;
    for (const BenchPose& pose : painting.poses) {
        const CastView view = painting.view(pose);
        Image8 picture = painting.blank(untouched);
        const PixelRectangle lit = painter.paint(painting.relief, view, 1, span_of(picture));
        EXPECT_EQ(lit, united(lit, view.lit));
        cast_picture.resize(picture.width, picture.height);
        list_blocks(items, painting.relief, view);
        cast(cast_picture, painting.relief, view, items, {0, cast_picture.rows});
        int met = 0;
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                const bool inside =
                    x >= lit.x && x < lit.x + lit.width && y >= lit.y && y < lit.y + lit.height;
                const std::size_t at = cast_picture.at(x, y);
                const bool is_met = std::isfinite(cast_picture.t[at]);
                met += is_met ? 1 : 0;
                const glm::u8vec4 expected =
                    !inside  ? untouched
                    : is_met ? colour_at(painting.relief, cast_picture.block[at], cast_picture.place[at])
                             : glm::u8vec4(0);
                ASSERT_EQ(picture.at(x, y), expected) << x << " " << y;
            }
        }
        EXPECT_GT(met, 1000);
    }
}

TEST(Painter, OneThreadOrFivePaintTheSame) {
    const Painting painting;
    ReliefPainter alone(1);
    ReliefPainter together(5);
    for (const BenchPose& pose : painting.poses) {
        const CastView view = painting.view(pose);
        Image8 a = painting.blank({});
        Image8 b = a;
        EXPECT_EQ(alone.paint(painting.relief, view, 1, span_of(a)),
                  together.paint(painting.relief, view, 1, span_of(b)));
        EXPECT_EQ(a.texels, b.texels);
    }
}

TEST(Painter, HitPointsAreTheRayCastsOwn) {
    const Painting painting;
    ReliefPainter painter(2);
    ImageFloat points(painting.settings.projector.pinhole.width, painting.settings.projector.pinhole.height);
    const glm::dmat4 prop_from_box = glm::inverse(painting.subject.frame.box_from_file);
    for (const BenchPose& pose : painting.poses) {
        painter.hit_points(painting.relief, painting.view(pose), span_of(points));
        const TruthPicture truth =
            painting.subject.truth.cast(painting.prop, view_of(painting.settings, pose), false);
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

} // namespace
} // namespace frustumscreen

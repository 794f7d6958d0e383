// Two eyes' pictures in every layout, against pictures of one eye each.

#include "firmware_host/display/picture_framebuffer.h"
#include "tests/render/counted_new.h"
#include "tests/render/stereo_rig.h"

#include <set>
#include <string>

namespace frustumscreen::synthetic {
namespace {

using settings::Stereo;
using Pair = std::array<image::Image8, 2>;

const StereoRig::Light even_light = scene::LightCompensation{};

scene::StereoLayout layout_of(Stereo stereo, const geometry::Lens& lens = {}) {
    return scene::stereo_layout(table_of(lens).projector, stereo);
}

/// The layout's one eye alone.
scene::StereoLayout alone(const scene::StereoLayout& layout) {
    return scene::stereo_layout(layout.pinhole, Stereo::Off);
}

/// Compares a picture of both eyes with those of each eye alone. A part of the display's picture that does not begin at its
/// corner has larger window coordinates, of 32 bits: where triangles are drawn into it directly, a code may round to the
/// next, and a corner to another step of the rasterizer's grid. Several samples are drawn in the eye's own coordinates.
void expect_eyes(const scene::StereoLayout& layout, const image::Image8& picture, const Pair& eyes,
                 const std::string& name, bool direct, std::size_t min_lit = 100) {
    for (std::size_t eye = 0; eye < 2; ++eye) {
        const glm::bvec3& channels = layout.pictures[eye].channels;
        const Difference found =
            difference(coloured(eyes[eye], channels), coloured(seen_by(eye, layout, picture), channels));
        EXPECT_GE(found.lit, min_lit) << name;
        const PixelRectangle& part = layout.pictures[eye].viewport;
        const bool rounds = direct && (part.x > 0 || part.y > 0);
        EXPECT_LE(found.far, rounds ? 2 + found.lit / 100 : 0U)
            << name << ", eye " << eye << ": up to " << found.worst;
        EXPECT_LE(found.pixels, rounds ? 8 + found.lit / 50 : 0U)
            << name << ", eye " << eye << ": " << found.worst;
    }
}

class StereoLayouts : public ::testing::TestWithParam<Stereo> {
protected:
    static constexpr int poses = 3;

    /// Calls `draw(rig, part, light)` in some poses of every part, with and without even light.
    template <typename Draw> static void in_poses(StereoRig& rig, const Draw& draw) {
        std::mt19937 random(71);
        for (const scene::PlacedLevel& part : rig.part) {
            for (const StereoRig::Light& light : {StereoRig::Light{}, even_light}) {
                for (int pose = 0; pose < poses; ++pose) {
                    rig.shuffle(random);
                    draw(part, light);
                }
            }
        }
    }
    static void expect_each_eye_as_alone(int samples, const geometry::Lens& lens) {
        const scene::StereoLayout layout = layout_of(GetParam(), lens);
        std::vector<Pair> pairs;
        {
            StereoRig rig(alone(layout), samples);
            in_poses(rig, [&](const scene::PlacedLevel& part, const StereoRig::Light& light) {
                const std::array<glm::dvec3, 2> both = rig.eyes();
                Pair& pair = pairs.emplace_back();
                for (std::size_t eye = 0; eye < 2; ++eye) {
                    rig.plan_for(part, light, std::span(both).subspan(eye, 1), both);
                    pair[eye] = rig.drawn_plans();
                }
            });
        }
        StereoRig rig(layout, samples);
        std::size_t at = 0;
        in_poses(rig, [&](const scene::PlacedLevel& part, const StereoRig::Light& light) {
            rig.plan_both(part, light);
            expect_eyes(layout, rig.drawn_plans(), pairs[at],
                        std::to_string(samples) + " samples, picture " + std::to_string(at), samples == 1);
            ++at;
        });
    }
};

TEST_P(StereoLayouts, ShowEachEyeItsOwnPicture) {
    for (const int samples : {1, 4}) {
        expect_each_eye_as_alone(samples, {});
    }
}

TEST_P(StereoLayouts, ShowEachEyeItsOwnPictureThroughADistortingLens) {
    expect_each_eye_as_alone(1, lenses[2]);
}

TEST_P(StereoLayouts, ShowOnePictureTwiceToEyesInOnePlace) {
    const scene::StereoLayout layout = layout_of(GetParam());
    Pair one;
    {
        StereoRig rig(alone(layout), 4);
        rig.plan_for(rig.part[0], even_light, std::span(&rig.table.eye_m, 1), {});
        one[0] = one[1] = rig.drawn_plans();
    }
    StereoRig rig(layout, 4);
    rig.interocular_m = 0.0;
    rig.plan_both(rig.part[0], even_light);
    expect_eyes(layout, rig.drawn_plans(), one, "one place", false);
}

/// They look through different faces.
TEST_P(StereoLayouts, ShowEachEyeItsOwnPictureWhenAMetreApart) {
    const scene::StereoLayout layout = layout_of(GetParam());
    Pair each;
    {
        StereoRig rig(alone(layout));
        rig.interocular_m = 1.0;
        const std::array<glm::dvec3, 2> both = rig.eyes();
        for (std::size_t eye = 0; eye < 2; ++eye) {
            rig.plan_for(rig.part[0], even_light, std::span(both).subspan(eye, 1), both);
            each[eye] = rig.drawn_plans();
        }
    }
    StereoRig rig(layout);
    rig.interocular_m = 1.0;
    rig.plan_both(rig.part[0], even_light);
    std::array<std::set<int>, 2> faces;
    for (std::size_t eye = 0; eye < 2; ++eye) {
        for (const scene::FacePlan& face : rig.plans[eye].faces) {
            faces[eye].insert(face.face);
        }
    }
    EXPECT_NE(faces[0], faces[1]);
    expect_eyes(layout, rig.drawn_plans(), each, "a metre", true);
}

TEST_P(StereoLayouts, ShowNothingToAnEyeInsideTheProp) {
    const scene::StereoLayout layout = layout_of(GetParam());
    const std::array<glm::dvec3, 2> eyes{glm::dvec3(0.0, 0.0, 0.05), glm::dvec3(0.1, -0.5, 0.45)};
    Pair each;
    each[0] = image::Image8(layout.pinhole.width, layout.pinhole.height);
    {
        StereoRig rig(alone(layout));
        rig.plan_for(rig.part[0], even_light, std::span(eyes).last(1), {});
        each[1] = rig.drawn_plans();
        EXPECT_GT(lit_pixels(each[1]), 500U);
    }
    StereoRig rig(layout);
    rig.plan_for(rig.part[0], even_light, eyes, eyes);
    EXPECT_TRUE(rig.plans[0].draws.empty());
    expect_eyes(layout, rig.drawn_plans(), each, "in the prop", true, 0);
}

/// Each eye's picture takes the draws that it takes alone, and no other.
TEST_P(StereoLayouts, DrawCallsAreTheSumOfBothEyes) {
    const scene::StereoLayout layout = layout_of(GetParam());
    std::vector<int> calls;
    {
        StereoRig rig(alone(layout), 4);
        in_poses(rig, [&](const scene::PlacedLevel& part, const StereoRig::Light& light) {
            const std::array<glm::dvec3, 2> both = rig.eyes();
            int& sum = calls.emplace_back(0);
            for (std::size_t eye = 0; eye < 2; ++eye) {
                rig.plan_for(part, light, std::span(both).subspan(eye, 1), both);
                sum += rig.draw_plans(render::Redraw::Everything).draw_calls;
            }
        });
    }
    StereoRig rig(layout, 4);
    std::size_t at = 0;
    in_poses(rig, [&](const scene::PlacedLevel& part, const StereoRig::Light& light) {
        rig.plan_both(part, light);
        const int drawn = rig.draw_plans(render::Redraw::Everything).draw_calls;
        // A relief alone in its picture is copied, but in some of the colours it is drawn: one draw for each eye.
        const int not_copied = GetParam() == Stereo::Anaglyph && part.relief && !part.on_gpu ? 2 : 0;
        EXPECT_EQ(drawn, calls[at++] + not_copied);
    });
}

INSTANTIATE_TEST_SUITE_P(Layouts, StereoLayouts,
                         ::testing::Values(Stereo::SideBySide, Stereo::TopBottom, Stereo::FrameSequential,
                                           Stereo::Anaglyph));

/// The gain of each planned face; zero of others.
std::array<float, geometry::max_faces> gains_of(const scene::FramePlan& plan) {
    std::array<float, geometry::max_faces> gains{};
    for (const scene::FacePlan& face : plan.faces) {
        gains[static_cast<std::size_t>(face.face)] = face.light.per_cubic_metre;
    }
    return gains;
}

/// How far the artifact dims is one thing for both eyes: that of the eye that needs it more.
TEST(Stereo, BothEyesSeeTheSameBrightness) {
    StereoRig rig(layout_of(Stereo::SideBySide));
    rig.interocular_m = 0.4;
    std::mt19937 random(73);
    int unequal = 0;
    for (int pose = 0; pose < 40; ++pose) {
        rig.shuffle(random);
        const std::array<glm::dvec3, 2> both = rig.eyes();
        std::array<std::array<float, geometry::max_faces>, 2> apart{};
        for (std::size_t eye = 0; eye < 2; ++eye) {
            scene::PlanView view = rig.table.view(even_light);
            view.eyes_m = std::span(both).subspan(eye, 1);
            scene::plan_frame(rig.prop, rig.part[0], view, rig.plan);
            apart[eye] = gains_of(rig.plan);
        }
        rig.plan_both(rig.part[0], even_light);
        const auto left = gains_of(rig.plans[0]);
        const auto right = gains_of(rig.plans[1]);
        for (std::size_t face = 0; face < geometry::max_faces; ++face) {
            if (left[face] > 0.0F && right[face] > 0.0F) {
                EXPECT_EQ(left[face], right[face]) << pose;
                EXPECT_EQ(left[face], std::min(apart[0][face], apart[1][face])) << pose;
                unequal += apart[0][face] != apart[1][face] ? 1 : 0;
            }
        }
    }
    EXPECT_GT(unequal, 0) << "no pose tells";
}

struct RedrawCase {
    Stereo stereo;
    int samples;
    int buffers; ///< that take turns; 0: none keeps its picture
};

class StereoRedrawing : public ::testing::TestWithParam<RedrawCase> {
protected:
    static constexpr int steps = 32;

    /// Moves a little, moves one eye alone, changes everything, or leaves all as it is.
    static void step(StereoRig& rig, std::mt19937& random, int k) {
        std::normal_distribution<double> normal(0.0, 0.01);
        if (k % 8 == 7) {
            rig.shuffle(random);
        } else if (k % 8 == 5) {
            const glm::dvec3 outwards = rig.table_from_head * glm::dvec3(0.01, 0.0, 0.0);
            rig.interocular_m += 0.02; // the left eye stays
            rig.table.eye_m += outwards;
        } else if (k % 8 != 3) {
            rig.table.table_from_prop.translation += glm::dvec3(normal(random), normal(random), 0.0);
        }
        rig.plan_both(rig.part[static_cast<std::size_t>(k / 8) % StereoRig::parts]);
    }
};

TEST_P(StereoRedrawing, PartialRedrawEqualsFullRedraw) {
    const auto [stereo, samples, buffers] = GetParam();
    StereoRig rig(layout_of(stereo), samples);
    std::vector<image::Image8> full;
    std::mt19937 random(74);
    for (int k = 0; k < steps; ++k) {
        step(rig, random, k);
        full.push_back(rig.drawn_plans());
    }
    StereoRig again(layout_of(stereo), samples);
    std::vector<display::PictureFramebuffer> ring;
    for (int k = 0; k < std::max(buffers, 1); ++k) {
        ring.push_back(
            display::PictureFramebuffer::create(again.layout.display.width, again.layout.display.height)
                .value());
    }
    random.seed(74);
    int presented = 0;
    std::size_t shown = 0;
    for (int k = 0; k < steps; ++k) {
        step(again, random, k);
        const std::size_t next = static_cast<std::size_t>(presented) % ring.size();
        const int age = presented < buffers ? 0 : buffers;
        const render::DrawResult result = again.renderer->draw(again.plans, {ring[next].name(), age});
        shown = result.drawn ? next : shown;
        presented += result.drawn ? 1 : 0;
        const image::Image8 picture =
            render::read_colour(ring[shown].name(), again.layout.display.width, again.layout.display.height);
        ASSERT_EQ(picture.texels, full[static_cast<std::size_t>(k)].texels) << k;
    }
    EXPECT_EQ(presented<steps, buffers> 0) << "what did not change is not drawn where buffers keep it";
}

INSTANTIATE_TEST_SUITE_P(
    Layouts, StereoRedrawing,
    ::testing::Values(RedrawCase{Stereo::SideBySide, 1, 1}, RedrawCase{Stereo::SideBySide, 4, 2},
                      RedrawCase{Stereo::TopBottom, 4, 1}, RedrawCase{Stereo::TopBottom, 1, 0},
                      RedrawCase{Stereo::FrameSequential, 4, 2}, RedrawCase{Stereo::FrameSequential, 1, 1},
                      RedrawCase{Stereo::Anaglyph, 1, 1}, RedrawCase{Stereo::Anaglyph, 4, 2},
                      RedrawCase{Stereo::Anaglyph, 1, 0}));

TEST(Stereo, OnlyTheEyeWhosePictureChangedIsRedrawn) {
    StereoRig rig(layout_of(Stereo::TopBottom));
    std::array<glm::dvec3, 2> eyes = rig.eyes();
    rig.plan_for(rig.part[0], {}, eyes, eyes);
    rig.draw_plans();
    eyes[1].x += 0.01;
    rig.plan_for(rig.part[0], {}, eyes, eyes);
    const render::DrawResult result = rig.draw_plans();
    EXPECT_TRUE(result.drawn);
    EXPECT_EQ(intersected(result.redrawn, rig.layout.pictures[1].viewport), result.redrawn);
    rig.plan_for(rig.part[0], {}, eyes, eyes);
    EXPECT_FALSE(rig.draw_plans().drawn);
}

TEST(Stereo, AFrameOfTwoEyesAllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    for (const Stereo stereo : {Stereo::SideBySide, Stereo::Anaglyph}) {
        StereoRig rig(layout_of(stereo), 4);
        for (const scene::PlacedLevel& part : rig.part) {
            // The second time round the driver has compiled its shaders, and memory is as large as these pictures need.
            long counted = 0;
            for (const bool again : {false, true}) {
                std::mt19937 random(75);
                for (int k = 0; k < 12; ++k) {
                    rig.shuffle(random);
                    const long before = allocations_so_far();
                    rig.plan_both(part, even_light);
                    counted += allocations_so_far() - before;
                    const long before_draw = allocations_so_far();
                    rig.draw_plans();
                    counted += again ? allocations_so_far() - before_draw : 0;
                }
            }
            EXPECT_EQ(counted, 0) << settings::name_of(stereo);
        }
    }
}

} // namespace
} // namespace frustumscreen::synthetic

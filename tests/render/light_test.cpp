// The compensation of the projector's light fall-off in the drawn picture.

#include "tests/render/rig.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::synthetic {
namespace {

double linear(int code) {
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// Light that a white artifact reflects to the visitor's eye at each lit pixel: picture times cos / d^2.
struct SentBack {
    double least = 1e9;
    double most = 0.0;
    int brightest_code = 0;
    std::array<bool, 5> faces{};
};

SentBack sent_back(const TestTable& table, const image::Image8& picture) {
    SentBack result;
    const geometry::RigidTransform prop_from_projector =
        table.table_from_prop.inverse() * table.table_from_projector;
    const glm::dvec3 projector = prop_from_projector.translation;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const int code = picture.at(x, y).g;
            geometry::PropHit lit;
            const glm::dvec3 ray = prop_from_projector.direction(table.projector.ray({x + 0.5, y + 0.5}));
            if (code == 0 || !geometry::intersect(table.prop, projector, ray, lit)) {
                continue;
            }
            const auto face = static_cast<std::size_t>(lit.face);
            const glm::dvec3 to_light = -lit.t * ray;
            const double d = glm::length(to_light);
            const double cosine = glm::dot(table.prop.faces[face].plane.normal, to_light / d);
            const double light = linear(code) * cosine / (d * d);
            result.least = std::min(result.least, light);
            result.most = std::max(result.most, light);
            result.brightest_code = std::max(result.brightest_code, code);
            result.faces[face] = true;
        }
    }
    return result;
}

constexpr double aim = 0.2; ///< light that every face gets at least

class Light : public ::testing::Test {
protected:
    Light() : rig(320, 200), table(320, 200) {
        rig.pack.textures[0] = image::Image8(8, 8, {255, 255, 255, 255});
        rig.upload_again();
        table.prop = geometry::make_frustum({0.2, 0.06, 0.08}); // no grazing light on any face
    }
    SentBack draw(std::optional<scene::LightCompensation> light) {
        scene::plan_frame(table.prop, rig.level, table.view(light), rig.plan);
        rig.plan.feathers.clear(); // light at the edges is uneven on purpose
        rig.draw(render::Redraw::Everything);
        return sent_back(table, rig.picture());
    }
    Rig rig;
    TestTable table;
};

TEST_F(Light, WhiteArtifactReflectsEvenLightFromEveryFace) {
    table.eye_m = {0.0, -0.45, 0.5};
    const SentBack plain = draw(std::nullopt);
    EXPECT_TRUE(plain.faces[3] && plain.faces[4]) << "the front and the top are seen";
    EXPECT_GT(plain.most, 1.8 * plain.least) << "the light is uneven without compensation";
    EXPECT_EQ(plain.brightest_code, 255);
    const SentBack even = draw(scene::LightCompensation{aim});
    // A tolerance of one code at the darkest, about 105, is a factor of 1.02.
    EXPECT_LT(even.most, 1.03 * even.least);
    EXPECT_LE(even.brightest_code, 255);
    EXPECT_NEAR(even.least, aim, 0.03 * aim);
}

/// The face at a pixel's centre; -1 at an edge, where the rasterizer's grid decides.
int face_at(const TestTable& table, int x, int y) {
    const geometry::RigidTransform prop_from_projector =
        table.table_from_prop.inverse() * table.table_from_projector;
    constexpr double hair = 1.0 / 64.0;
    int face = -1;
    for (const glm::dvec2 aside : {glm::dvec2(-hair, -hair), {-hair, hair}, {hair, -hair}, {hair, hair}}) {
        geometry::PropHit lit;
        const glm::dvec2 pixel = glm::dvec2(x + 0.5, y + 0.5) + aside;
        if (!geometry::intersect(table.prop, prop_from_projector.translation,
                                 prop_from_projector.direction(table.projector.ray(pixel)), lit) ||
            (face >= 0 && face != lit.face)) {
            return -1;
        }
        face = lit.face;
    }
    return face;
}

struct Gains {
    std::size_t pixels = 0, clamped = 0;
    double least = 1.0;
    double worst_code = 0.0; ///< largest deviation from the exact gain
};

/// Compares a drawn picture of a white artifact with the exact gain and sRGB's own curve.
void compare_gains(const TestTable& table, const scene::FramePlan& plan, const image::Image8& picture,
                   Gains& gains) {
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const int face = picture.at(x, y).g > 0 ? face_at(table, x, y) : -1;
            const auto planned =
                std::find_if(plan.faces.begin(), plan.faces.end(),
                             [face](const scene::FacePlan& each) { return each.face == face; });
            if (planned == plan.faces.end()) {
                continue;
            }
            const double exact = scene::gain(planned->light, table.projector, {x + 0.5, y + 0.5});
            const double code = 255.0 * image::srgb_from_linear(exact);
            gains.worst_code = std::max(gains.worst_code, std::abs(code - picture.at(x, y).g));
            gains.least = std::min(gains.least, exact);
            gains.clamped += exact == static_cast<double>(planned->light.most) ? 1U : 0U;
            ++gains.pixels;
        }
    }
}

TEST_F(Light, PixelCodesMatchTheExactGain) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    Gains gains;
    for (int pose = 0; pose < 60; ++pose) {
        table.prop = pose % 2 == 0 ? geometry::make_frustum({}) : geometry::make_cube(0.1);
        table.shuffle(random);
        if (pose % 2 == 1) { // in the hand, as close to the lens as allowed
            table.table_from_prop = {glm::normalize(glm::dquat(u(random), u(random), u(random), u(random))),
                                     {0.05 * u(random), 0.03 * u(random), 0.2 + 0.2 * u(random)}};
        }
        scene::plan_frame(table.prop, rig.level,
                          table.view(scene::LightCompensation{pose % 3 == 0 ? 1.5 : 0.25}), rig.plan);
        rig.plan.feathers.clear();
        rig.draw(render::Redraw::Everything);
        compare_gains(table, rig.plan, rig.picture(), gains);
    }
    EXPECT_GT(gains.pixels, 50'000U);
    EXPECT_GT(gains.clamped, 1'000U);
    EXPECT_LT(gains.clamped, gains.pixels / 2);
    EXPECT_LT(gains.least, 0.05);
    // Half a code is the picture's own rounding. A visible face has a light sine of at least 0.12, so its
    // depth cancels to an eighth: ten roundings of 2^-24 are 5e-6 of a gain, a thousandth of a code.
    EXPECT_LT(gains.worst_code, 0.5 + 0.002);
}

/// Dim artifacts are shown brighter than their codes, by up to a factor of eight.
TEST_F(Light, PixelCodesMatchTheSetBrightness) {
    table.eye_m = {0.0, -0.45, 0.5};
    for (const int code : {1, 3, 6, 10, 12, 40, 120, 250}) {
        rig.pack.textures[0] =
            image::Image8(8, 8, glm::u8vec4(glm::u8vec3(static_cast<std::uint8_t>(code)), 255));
        rig.upload_again();
        for (const double brightness : {0.05, 0.5, 0.999, 1.001, 1.5, 4.0, 8.0}) {
            scene::PlanView view = table.view();
            view.brightness = brightness;
            scene::plan_frame(table.prop, rig.level, view, rig.plan);
            rig.draw(render::Redraw::Everything);
            const image::Image8 picture = rig.picture();
            const double shown = 255.0 * image::srgb_from_linear(std::min(1.0, brightness * linear(code)));
            std::size_t lit = 0;
            double off = 0.0;
            for (const glm::u8vec4& texel : picture.texels) {
                lit += texel.g != 0 ? 1U : 0U;
                off = std::max(off, texel.g != 0 ? std::abs(texel.g - shown) : 0.0);
            }
            // The rest is rounding; if only one of the two codes is on the curve's linear piece, the shader
            // has this additional error.
            const double crossing = (code <= 10) == (shown <= 10.5) ? 0.1 : (brightness > 4.0 ? 3.9 : 1.9);
            EXPECT_LE(off, 0.51 + crossing) << code << " x " << brightness;
            EXPECT_TRUE(lit > 1000 || shown < 0.6) << code << " x " << brightness;
        }
    }
}

} // namespace
} // namespace frustumscreen::synthetic

// The compensation of the projector's fall-off in the drawn picture.

#include "tests/render/rig.h"

#include <cmath>

namespace frustumscreen::synthetic {
namespace {

double linear(int code) {
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// What a white artifact sends back to the visitor's eye at each lit pixel: picture times cos / d^2.
struct SentBack {
    double least = 1e9;
    double most = 0.0;
    int brightest_code = 0;
    std::array<bool, 5> faces{};
};

SentBack sent_back(const Stage& stage, const Image8& picture) {
    SentBack result;
    const RigidTransform prop_from_projector = stage.table_from_prop.inverse() * stage.table_from_projector;
    const glm::dvec3 projector = prop_from_projector.translation;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const int code = picture.at(x, y).g;
            PropHit lit;
            const glm::dvec3 ray = prop_from_projector.direction(stage.projector.ray({x + 0.5, y + 0.5}));
            if (code == 0 || !intersect(stage.prop, projector, ray, lit)) {
                continue;
            }
            const auto face = static_cast<std::size_t>(lit.face);
            const glm::dvec3 to_light = -lit.t * ray;
            const double d = glm::length(to_light);
            const double cosine = glm::dot(stage.prop.faces[face].plane.normal, to_light / d);
            const double light = linear(code) * cosine / (d * d);
            result.least = std::min(result.least, light);
            result.most = std::max(result.most, light);
            result.brightest_code = std::max(result.brightest_code, code);
            result.faces[face] = true;
        }
    }
    return result;
}

constexpr double aim = 0.2; ///< every face gets at least this

class Light : public ::testing::Test {
protected:
    Light() : rig(320, 200), stage(320, 200) {
        rig.pack.textures[0] = Image8(8, 8, {255, 255, 255, 255});
        rig.upload_again();
        stage.prop = make_frustum({0.2, 0.06, 0.08}); // the light grazes no face
    }
    SentBack draw(std::optional<LightCompensation> light) {
        plan_frame(stage.prop, rig.level, stage.view(light), rig.plan);
        rig.plan.feathers.clear(); // at the edges the light is uneven on purpose
        rig.draw(Redraw::Everything);
        return sent_back(stage, rig.picture());
    }
    Rig rig;
    Stage stage;
};

TEST_F(Light, AWhiteArtifactSendsBackTheSameFromEveryFace) {
    stage.eye_m = {0.0, -0.45, 0.5};
    const SentBack plain = draw(std::nullopt);
    EXPECT_TRUE(plain.faces[3] && plain.faces[4]) << "the front and the top are seen";
    EXPECT_GT(plain.most, 1.8 * plain.least) << "the light is uneven without compensation";
    EXPECT_EQ(plain.brightest_code, 255);
    const SentBack even = draw(LightCompensation{aim});
    // One code either way at the darkest, about 105, is a factor of 1.02.
    EXPECT_LT(even.most, 1.03 * even.least);
    EXPECT_LE(even.brightest_code, 255);
    EXPECT_NEAR(even.least, aim, 0.03 * aim);
}

TEST_F(Light, HalfTheStrengthIsBrighterAndLessEven) {
    stage.eye_m = {0.0, -0.45, 0.5};
    const SentBack even = draw(LightCompensation{aim});
    const SentBack half = draw(LightCompensation{aim, 1.0, 0.5});
    const SentBack plain = draw(std::nullopt);
    // Half of the uncompensated picture's light and half of the even one's, at each place.
    EXPECT_NEAR(half.most, 0.5 * (plain.most + even.most), 0.03 * half.most);
    EXPECT_NEAR(half.least, 0.5 * (plain.least + even.least), 0.03 * half.least);
}

} // namespace
} // namespace frustumscreen::synthetic

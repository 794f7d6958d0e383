#include "tests/simulation/pixels_covered.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace frustumscreen::simulation {
namespace {

/// A painted egg in the prop, in closed form: smooth bands along z and around the axis.
struct Egg {
    glm::dvec3 centre{0.0, 0.0, 0.055};
    glm::dvec3 radii{0.040, 0.032, 0.050};

    [[nodiscard]] std::optional<glm::dvec3> colour(const glm::dvec3& origin,
                                                   const glm::dvec3& direction) const {
        const glm::dvec3 o = (origin - centre) / radii;
        const glm::dvec3 d = direction / radii;
        const double a = glm::dot(d, d);
        const double b = glm::dot(o, d);
        const double c = glm::dot(o, o) - 1.0;
        const double root = b * b - a * c;
        if (root < 0.0 || -b - std::sqrt(root) <= 0.0) {
            return std::nullopt;
        }
        const glm::dvec3 p = o + d * ((-b - std::sqrt(root)) / a);
        const double around = std::atan2(p.y, p.x);
        return glm::dvec3(0.55 + 0.4 * std::sin(14.0 * p.z), 0.5 + 0.35 * std::cos(6.0 * around),
                          0.45 + 0.3 * std::sin(5.0 * p.z + 3.0 * around));
    }
};

glm::u8vec4 codes(const std::optional<glm::dvec3>& linear) {
    if (!linear) {
        return {0, 0, 0, 255};
    }
    const auto code = [](double l) {
        const double s = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055;
        return static_cast<std::uint8_t>(std::lround(std::clamp(s, 0.0, 1.0) * 255.0));
    };
    return {code(linear->r), code(linear->g), code(linear->b), 255};
}

/// First face of the frustum on a ray; tests one quadrilateral after the other.
struct FaceHit {
    int face = -1;
    double t = std::numeric_limits<double>::infinity();
};
FaceHit first_face(const geometry::PropShape& prop, const glm::dvec3& origin, const glm::dvec3& direction) {
    FaceHit best;
    for (std::size_t k = 0; k < prop.faces.size(); ++k) {
        const auto& c = prop.faces[k].corners;
        const glm::dvec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
        const double t = glm::dot(normal, c[0] - origin) / glm::dot(normal, direction);
        const glm::dvec3 p = origin + t * direction;
        bool inside = t > 1e-9 && t < best.t;
        for (std::size_t e = 0; e < 4; ++e) {
            inside = inside && glm::dot(glm::cross(c[(e + 1) % 4] - c[e], p - c[e]), normal) >= 0.0;
        }
        if (inside) {
            best = {static_cast<int>(k), t};
        }
    }
    return best;
}

struct Kiosk {
    const char* name;
    geometry::Pinhole projector;
    double height_m;
};
const Kiosk kiosks[] = {{"near", {1280, 800, 2850.0, 2850.0, 640.0, 400.0}, 0.9},
                        {"shipped", {1280, 800, 1920.0, 1920.0, 640.0, 400.0}, 1.2}};

VisitorScene scene_of(const Kiosk& kiosk, const glm::dvec2& place, double yaw, const glm::dvec3& eye) {
    return {kiosk.projector,
            {glm::dquat(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, kiosk.height_m}},
            geometry::make_frustum({}),
            {glm::angleAxis(yaw, glm::dvec3(0, 0, 1)), {place, 0.0}},
            eye,
            {0.8, 0.5}};
}

/// The projector's picture by the conventions' definition, with plain rays.
image::Image8 projected(const VisitorScene& scene, const Egg& egg) {
    const geometry::RigidTransform prop_from_table = scene.table_from_prop.inverse();
    const glm::dvec3 lens = prop_from_table.point(scene.table_from_projector.translation);
    const glm::dvec3 eye = prop_from_table.point(scene.eye_m);
    image::Image8 picture(scene.projector.width, scene.projector.height, glm::u8vec4(0, 0, 0, 255));
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const glm::dvec3 in_lens((x + 0.5 - scene.projector.cx) / scene.projector.fx,
                                     (y + 0.5 - scene.projector.cy) / scene.projector.fy, 1.0);
            const glm::dvec3 ray = prop_from_table.direction(scene.table_from_projector.direction(in_lens));
            const FaceHit hit = first_face(scene.prop, lens, ray);
            if (hit.face < 0) {
                continue;
            }
            const glm::dvec3 s = lens + hit.t * ray;
            const geometry::PropFace& face = scene.prop.faces[static_cast<std::size_t>(hit.face)];
            if (glm::dot(face.plane.normal, eye - s) > 0.0) {
                picture.at(x, y) = codes(egg.colour(eye, s - eye));
            }
        }
    }
    return picture;
}

int worst_channel(const glm::u8vec4& a, const glm::u8vec4& b) {
    return std::max(
        {std::abs(int(a.r) - int(b.r)), std::abs(int(a.g) - int(b.g)), std::abs(int(a.b) - int(b.b))});
}

TEST(VisitorView, MatchesARayCastOfTheArtifactInTheProp) {
    const Egg egg;
    for (const Kiosk& kiosk : kiosks) {
        for (const auto& [place, yaw, eye] :
             {std::tuple{glm::dvec2(0.0, 0.0), 0.3, glm::dvec3(0.0, -0.55, 0.50)},
              std::tuple{glm::dvec2(0.06, 0.02), 0.75, glm::dvec3(-0.35, -0.45, 0.40)},
              std::tuple{glm::dvec2(-0.05, -0.03), -1.2, glm::dvec3(0.2, -0.7, 0.9)}}) {
            const VisitorScene scene = scene_of(kiosk, place, yaw, eye);
            const VisitorCamera camera = visitor_camera(scene.prop, scene.table_from_prop, eye, 480, 300);
            const image::Image8 view = visitor_view(scene, projected(scene, egg), camera, exact_check());
            const geometry::RigidTransform prop_from_table = scene.table_from_prop.inverse();
            const glm::dvec3 in_prop = prop_from_table.point(eye);
            int on_prop = 0;
            int on_egg = 0;
            int right = 0;
            int finer = 0;
            for (int y = 0; y < view.height; ++y) {
                for (int x = 0; x < view.width; ++x) {
                    const glm::dvec2 pixel(x + 0.5, y + 0.5);
                    const glm::dvec3 ray = prop_from_table.direction(
                        camera.table_from_camera.direction(camera.pinhole.ray(pixel)));
                    if (first_face(scene.prop, in_prop, ray).face < 0) {
                        continue;
                    }
                    const auto colour = egg.colour(in_prop, ray);
                    ++on_prop;
                    on_egg += colour ? 1 : 0;
                    right += worst_channel(view.at(x, y), codes(colour)) <= 16 ? 1 : 0;
                    finer += projector_pixels_covered(scene, camera, pixel) < 1.0 ? 1 : 0;
                }
            }
            EXPECT_GT(on_prop, 10000);
            EXPECT_GT(on_egg, on_prop / 8);
            EXPECT_LE(finer, on_prop / 50) << kiosk.name; // required for the comparison
            EXPECT_GE(right, 0.97 * on_prop) << kiosk.name << " yaw " << yaw;
        }
    }
}

TEST(VisitorView, CameraLooksAtTheCentreOfThePropUpright) {
    const geometry::PropShape prop = geometry::make_frustum({});
    const geometry::RigidTransform pose{glm::angleAxis(0.4, glm::dvec3(0, 0, 1)), {0.1, 0.05, 0.0}};
    const glm::dvec3 eye(-0.2, -0.6, 0.45);
    const VisitorCamera camera = visitor_camera(prop, pose, eye, 640, 400);
    const auto pixel = [&](const glm::dvec3& p) {
        return *camera.pinhole.pixel(camera.table_from_camera.inverse().point(p));
    };
    const glm::dvec3 centre(0.1, 0.05, 0.06);
    EXPECT_NEAR(glm::distance(pixel(centre), glm::dvec2(320, 200)), 0.0, 1e-9);
    EXPECT_NEAR(pixel(centre + glm::dvec3(0, 0, 0.01)).x, 320.0, 1e-9);
    EXPECT_LT(pixel(centre + glm::dvec3(0, 0, 0.01)).y, 200.0);
    EXPECT_NEAR(glm::distance(camera.table_from_camera.translation, eye), 0.0, 1e-15);
    // The prop's bounding sphere, at 0.62 of the height: its outline is a cone of half angle asin(r / d).
    const double r = std::hypot(std::hypot(0.08, 0.08), 0.06);
    const double d = glm::distance(eye, centre);
    EXPECT_NEAR(camera.pinhole.fx * std::tan(std::asin(r / d)), 0.62 * 200.0, 1e-9);
    const VisitorCamera above = visitor_camera(prop, pose, {0.1, 0.05, 1.0}, 640, 400);
    EXPECT_NEAR(above.table_from_camera.direction({1, 0, 0}).x, 1.0, 1e-12);
}

TEST(VisitorView, WithoutLightABlackPictureLeavesEverythingBlack) {
    const VisitorScene scene = scene_of(kiosks[0], {0, 0}, 0.2, {0.0, -0.55, 0.5});
    const VisitorCamera camera = visitor_camera(scene.prop, scene.table_from_prop, scene.eye_m, 160, 100);
    const image::Image8 black(1280, 800, glm::u8vec4(0, 0, 0, 255));
    for (const glm::u8vec4& texel : visitor_view(scene, black, camera, exact_check()).texels) {
        EXPECT_EQ(texel, glm::u8vec4(0, 0, 0, 255));
    }
    // In the room's light the prop stands out from the table, and neither is bright.
    const image::Image8 lit = visitor_view(scene, black, camera);
    EXPECT_GT(lit.at(80, 50).r, lit.at(20, 80).r + 8);
    EXPECT_LT(lit.at(80, 50).r, 70);
}

TEST(VisitorView, ThePropCastsAShadowInTheProjectorsLightOnTheTable) {
    // Off the axis, so the shadow falls outwards to +X; the eye looks at it along -X.
    const VisitorScene scene = scene_of(kiosks[1], {0.15, 0.0}, 0.0, {0.9, -0.3, 0.6});
    const VisitorCamera camera = visitor_camera(scene.prop, scene.table_from_prop, scene.eye_m, 320, 200);
    const image::Image8 white(1280, 800, glm::u8vec4(255));
    const image::Image8 view = visitor_view(scene, white, camera, exact_check());
    const auto at = [&](const glm::dvec3& p) {
        const glm::dvec2 pixel = *camera.pinhole.pixel(camera.table_from_camera.inverse().point(p));
        return view.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
    };
    // The base's edge is at 0.23; the top's edge, 0.195 m out at 0.12 m, casts its shadow to 0.195 / 0.9 =
    // 0.217: the +X face is lit and so is the table beyond it. A taller prop casts a shadow there.
    EXPECT_EQ(at({0.25, 0.0, 0.0}).r, 255);
    VisitorScene tall = scene;
    tall.prop = geometry::make_frustum({0.16, 0.16, 0.30});
    const image::Image8 shaded = visitor_view(tall, white, camera, exact_check());
    const glm::dvec2 pixel =
        *camera.pinhole.pixel(camera.table_from_camera.inverse().point({0.25, 0.0, 0.0}));
    EXPECT_EQ(shaded.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y)).r, 0);
}

TEST(VisitorView, LightFallsWithTheCosineAndTheSquareOfTheDistance) {
    const VisitorScene scene = scene_of(kiosks[1], {0.0, 0.0}, 0.0, {0.0, -0.6, 0.5});
    const VisitorCamera camera = visitor_camera(scene.prop, scene.table_from_prop, scene.eye_m, 320, 200);
    const image::Image8 grey(1280, 800, glm::u8vec4(60, 60, 60, 255));
    const image::Image8 view = visitor_view(scene, grey, camera, {true, 1, true});
    const image::Image8 dark =
        visitor_view(scene, image::Image8(1280, 800, glm::u8vec4(0, 0, 0, 255)), camera, {true, 1, true});
    const auto linear = [](std::uint8_t code) {
        const double s = code / 255.0;
        return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    };
    const auto light = [&](const glm::dvec3& p) {
        const glm::dvec2 pixel = *camera.pinhole.pixel(camera.table_from_camera.inverse().point(p));
        const int x = static_cast<int>(pixel.x);
        const int y = static_cast<int>(pixel.y);
        return linear(view.at(x, y).r) - linear(dark.at(x, y).r);
    };
    const glm::dvec3 top(0.0, 0.0, 0.12);
    const glm::dvec3 side(0.0, -0.0625, 0.06);
    const double tilt = std::atan2(0.035, 0.12); // of the side face from the vertical
    const glm::dvec3 normal(0.0, -std::cos(tilt), std::sin(tilt));
    const glm::dvec3 up = glm::dvec3(0, 0, 1.2) - side;
    const double expected = (glm::dot(normal, up) / std::pow(glm::length(up), 3)) / (1.0 / (1.08 * 1.08));
    EXPECT_NEAR(light(side) / light(top), expected, 0.04 * expected);
}

/// Without a picture only the room's light is visible: table and prop are dark grey.
TEST(VisitorView, ExposesADarkTableToGreyAndAWhiteSideToWhite) {
    VisitorScene scene = scene_of(kiosks[1], {0.0, 0.0}, 0.0, {0.6, -0.1, 0.5});
    const VisitorCamera camera = visitor_camera(scene.prop, scene.table_from_prop, scene.eye_m, 200, 200);
    const auto code_at = [&](const image::Image8& picture, const glm::dvec3& point) {
        const image::Image8 view = visitor_view(scene, picture, camera);
        const glm::dvec2 pixel = *camera.pinhole.pixel(camera.table_from_camera.inverse().point(point));
        return int(view.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y)).g);
    };
    const glm::dvec3 side(0.0625, 0.0, 0.06);
    const glm::dvec3 table(0.17, 0.0, 0.0);
    const image::Image8 dark(1280, 800, glm::u8vec4(0, 0, 0, 255));
    EXPECT_GT(code_at(dark, table), 24);
    EXPECT_LT(code_at(dark, table), 48);
    EXPECT_GT(code_at(dark, side), 24);
    EXPECT_LT(code_at(dark, side), 64);
    EXPECT_GT(code_at(image::Image8(1280, 800, glm::u8vec4(255)), side), 230);
}

TEST(VisitorView, ShowsABlockOnlyBeforeEverythingElse) {
    VisitorScene scene = scene_of(kiosks[1], {0.0, 0.0}, 0.0, {0.0, -0.6, 0.4});
    const VisitorCamera camera = visitor_camera(scene.prop, scene.table_from_prop, scene.eye_m, 120, 120);
    const image::Image8 white(1280, 800, glm::u8vec4(255));
    const image::Image8 before = visitor_view(scene, white, camera);
    scene.objects = {{{-5.0, 3.0, -5.0}, {5.0, 3.1, 5.0}, 0.6}}; // a wall behind everything
    const image::Image8 walled = visitor_view(scene, white, camera);
    EXPECT_EQ(walled.at(60, 60), before.at(60, 60));
    scene.objects.push_back({{-5.0, -0.41, -5.0}, {5.0, -0.4, 5.0}, 0.0}); // a black screen in front of the
                                                                           // eye
    const image::Image8 hidden = visitor_view(scene, white, camera);
    EXPECT_EQ(hidden.at(60, 60), glm::u8vec4(0, 0, 0, 255));
    EXPECT_GT(before.at(60, 60).g, 100);
}

} // namespace
} // namespace frustumscreen::simulation

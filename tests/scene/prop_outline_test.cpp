// The sample headroom against props slid and rotated by seeded hands, projected corner by corner.

#include "app/scene/prop_outline.h"
#include "app/scene/scene_level.h"
#include "app/scene/shader_key.h"
#include "app/settings/settings.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

namespace frustumscreen::scene {
namespace {

settings::Settings settings_of(const char* file) {
    return **settings::load_settings(std::filesystem::path(source_dir()) / "config" / file);
}

/// Upright, somewhere on the table.
geometry::RigidTransform slid(const settings::Settings& settings, std::mt19937& random) {
    std::uniform_real_distribution<double> u(-0.5, 0.5);
    return {glm::angleAxis(7.0 * u(random), glm::dvec3(0.0, 0.0, 1.0)),
            {u(random) * settings.table.width_m, u(random) * settings.table.depth_m, 0.0}};
}

/// Size of the part inside the picture.
glm::dvec2 size_in_picture(const settings::Settings& settings,
                           const geometry::RigidTransform& table_from_prop) {
    const geometry::Pinhole& pinhole = settings.projector.pinhole;
    glm::dvec2 low(1e9);
    glm::dvec2 high(-1e9);
    for (const glm::dvec3& corner : settings::make_prop(settings.prop).corners) {
        const glm::dvec3 seen =
            settings.projector.table_from_projector.inverse().point(table_from_prop.point(corner));
        const glm::dvec2 pixel = pinhole.pixel(seen).value();
        low = glm::min(low, pixel);
        high = glm::max(high, pixel);
    }
    const glm::dvec2 picture(pinhole.width, pinhole.height);
    return glm::max(glm::min(high, picture) - glm::max(low, glm::dvec2(0.0)), glm::dvec2(0.0));
}

TEST(PropOutline, FitsThePropAnywhereOnTheTable) {
    for (const char* file : {"near.toml", "kiosk.toml"}) {
        const settings::Settings settings = settings_of(file);
        const PixelSize room =
            largest_outline(settings, settings.projector.pinhole, visibility_of(settings)).value();
        std::mt19937 random(3);
        glm::dvec2 largest(0.0);
        for (int k = 0; k < 20000; ++k) {
            largest = glm::max(largest, size_in_picture(settings, slid(settings, random)));
        }
        EXPECT_GE(room.width, largest.x) << file;
        EXPECT_GE(room.height, largest.y) << file;
        EXPECT_LE(room.width, largest.x + 30.0) << file;
        EXPECT_LE(room.height, largest.y + 30.0) << file;
    }
}

TEST(PropOutline, IsTheLargestOfKnownViews) {
    const settings::Settings settings = settings_of("kiosk.toml");
    std::mt19937 random(4);
    std::vector<KnownView> views;
    glm::dvec2 largest(0.0);
    for (int k = 0; k < 5; ++k) {
        views.push_back({slid(settings, random), {0.0, -0.5, 0.5}});
        largest = glm::max(largest, size_in_picture(settings, views.back().table_from_prop));
    }
    const PixelSize room =
        largest_outline(settings, settings.projector.pinhole, visibility_of(settings, views)).value();
    EXPECT_NEAR(room.width, largest.x + 16.0, 4.0);
    EXPECT_NEAR(room.height, largest.y + 16.0, 4.0);
}

TEST(PropOutline, HeldPropNeedsTheWholePicture) {
    const settings::Settings settings = settings_of("cube.toml");
    EXPECT_FALSE(largest_outline(settings, settings.projector.pinhole, visibility_of(settings)));
}

TEST(PropOutline, UnionFitsBothNeeds) {
    const auto needs = [](int samples, std::optional<PixelSize> outline) {
        RenderNeeds needs;
        needs.samples = samples;
        needs.outline = outline;
        return needs;
    };
    const RenderNeeds whole = needs(4, std::nullopt);
    const RenderNeeds wide = needs(4, PixelSize{300, 100});
    const RenderNeeds high = needs(2, PixelSize{100, 300});
    EXPECT_EQ(united(wide, high).outline, (PixelSize{300, 300}));
    EXPECT_FALSE(united(wide, whole).outline) << "all of the picture";
    EXPECT_EQ(united(RenderNeeds{}, wide).outline, wide.outline) << "one sample needs no room";
    EXPECT_EQ(united(wide, RenderNeeds{}).outline, wide.outline);
}

/// Headroom for eight samples in the whole picture would take 65.5 and 147.5 MB.
TEST(PropOutline, LimitsTheMemoryOfSamplesToTheProp) {
    for (const auto& [file, max_mb] : {std::pair("near.toml", 18.0), std::pair("kiosk.toml", 35.0)}) {
        const settings::Settings settings = settings_of(file);
        const geometry::Pinhole& pinhole = settings.projector.pinhole;
        RenderNeeds needs{4, {}};
        needs.outline = largest_outline(settings, pinhole, visibility_of(settings));
        const double mb = 1e-6 * static_cast<double>(gpu_bytes(needs, pinhole.width, pinhole.height));
        EXPECT_LE(mb, max_mb) << file;
        EXPECT_GE(mb, 0.9 * max_mb) << file;
    }
}

} // namespace
} // namespace frustumscreen::scene

#include "app/bench/setup/advice_report.h"
#include "tests/settings/lit_at_each_yaw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <sstream>

namespace frustumscreen::bench {
namespace {

settings::Settings old_table() {
    settings::Settings settings;
    settings.projector.pinhole = {320, 200, 480.0, 480.0, 160.0, 100.0};
    settings.projector.table_from_projector.translation = {0.0, 0.0, 1.2};
    settings.prop = {settings::PropKind::Frustum, 0.16, 0.09, 0.12, settings::PropZone::Table};
    return settings;
}

/// Counts pixels whose ray ends on a face through which the eye sees the ellipsoid, in the ordinary way,
/// pixel by pixel.
double counted_pixels(const settings::Settings& settings, double yaw, const glm::dvec3& half) {
    const geometry::RigidTransform prop_from_table =
        geometry::RigidTransform{glm::angleAxis(yaw, glm::dvec3(0, 0, 1)), glm::dvec3(0.0)}.inverse();
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    const geometry::RigidTransform& table_from_projector = settings.projector.table_from_projector;
    const glm::dvec3 eye = prop_from_table.point(settings.eye.default_m);
    const glm::dvec3 lens = prop_from_table.point(table_from_projector.translation);
    constexpr int finer = 2;
    const geometry::Pinhole fine = settings.projector.pinhole.scaled_to(finer * 320, finer * 200);
    double count = 0.0;
    for (int y = 0; y < fine.height; ++y) {
        for (int x = 0; x < fine.width; ++x) {
            const glm::dvec3 ray =
                prop_from_table.direction(table_from_projector.direction(fine.ray({x + 0.5, y + 0.5})));
            geometry::PropHit hit;
            if (!geometry::intersect(prop, lens, ray, hit)) {
                continue;
            }
            const glm::dvec3 lit = lens + hit.t * ray;
            if (prop.faces[static_cast<std::size_t>(hit.face)].plane.distance(eye) <= 0.0) {
                continue;
            }
            double nearest = 1e9; // distance to the ellipsoid's middle, in its radii, along the eye's ray
            for (int k = 0; k <= 600; ++k) {
                const glm::dvec3 at = eye + (lit - eye) * (0.5 + k / 400.0);
                nearest = std::min(nearest, glm::length((at - glm::dvec3(0.0, 0.0, half.z)) / half));
            }
            count += nearest <= 1.0 ? 1.0 : 0.0;
        }
    }
    return count / (finer * finer);
}

TEST(Advice, CountsTheProjectorsPixelsOnAnArtifact) {
    const settings::Settings settings = old_table();
    const SetUpFigures figures = examine(settings);
    EXPECT_NEAR(figures.slim_height_m, 0.12, 1e-9) << "half as wide as high: the prop's height limits it";
    EXPECT_NEAR(figures.wide_height_m, 0.16 / (1.0 + 0.07 / 0.12), 1e-9) << "as wide as high: its walls do";
    const glm::dvec3 half(0.25 * figures.slim_height_m, 0.25 * figures.slim_height_m,
                          0.5 * figures.slim_height_m);
    const double counted =
        0.5 * (counted_pixels(settings, 0.0, half) + counted_pixels(settings, 0.25 * std::numbers::pi, half));
    EXPECT_NEAR(figures.pixels, counted, 0.03 * counted);
}

TEST(Advice, ReportsWhetherThePictureCoversTheTable) {
    settings::Settings settings = old_table();
    EXPECT_TRUE(examine(settings).covered);
    settings.projector.pinhole.fx *= 1.02;
    EXPECT_FALSE(examine(settings).covered);
    settings = old_table();
    settings.projector.table_from_projector.translation.x = 0.01;
    EXPECT_FALSE(examine(settings).covered);
}

TEST(Advice, WorkingChoicesMeetTheRequirements) {
    AdviceOptions options;
    options.lowest_m = options.highest_m = 1.5;
    options.sides_m = 0.2;
    options.evenness = 0.3;
    const settings::Settings settings = old_table();
    const SetUpFigures now = examine(settings);
    double done = 0.0;
    const std::vector<SetUpChoice> found = choices(settings, options, [&](double share) {
        EXPECT_GE(share, done);
        done = share;
    });
    EXPECT_EQ(done, 1.0);
    ASSERT_EQ(found.size(), 5U) << "above the middle, and on two sides by two mounts";
    const SetUpChoice* const best = best_of(found);
    ASSERT_NE(best, nullptr);
    EXPECT_TRUE(best->works);
    for (const SetUpChoice& choice : found) {
        if (!choice.works) {
            continue;
        }
        EXPECT_GE(choice.figures.light.evenness, options.evenness);
        EXPECT_GE(choice.figures.wide_height_m, 0.99 * now.wide_height_m);
        EXPECT_GE(choice.figures.slim_height_m, 0.99 * now.slim_height_m);
        EXPECT_GE(choice.figures.pixels, now.pixels);
        for (const glm::dvec2 side : {glm::dvec2(-1, -1), glm::dvec2(1, 1)}) {
            EXPECT_TRUE(settings::lit_at_each_yaw(choice.settings, 0.999 * side * choice.figures.reach_m,
                                                  settings.eye.default_m));
        }
        EXPECT_LE(choice.figures.reach_m.x * choice.figures.reach_m.y * std::sqrt(choice.figures.reference),
                  best->figures.reach_m.x * best->figures.reach_m.y * std::sqrt(best->figures.reference));
        const Result<settings::CheckedSettings> pasted =
            settings::parse_settings(setup_toml(choice), "advice.toml");
        ASSERT_TRUE(pasted) << pasted.error().message;
        EXPECT_NEAR(examine(**pasted).pixels, choice.figures.pixels, 0.01 * choice.figures.pixels);
    }
}

std::size_t fields_in(const std::string& line) {
    return static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
}

TEST(Advice, TableAndCsvContainMeasuredFrameCosts) {
    SetUpChoice now = as_it_is(old_table());
    std::vector<SetUpChoice> found(3, now);
    found[0].works = false;
    found[1].settings.prop.base_m = 0.15; // smaller, so it can be slid farther
    found[1].figures = examine(found[1].settings);
    const std::vector<SetUpChoice*> best = best_working(found, 5);
    ASSERT_EQ(best.size(), 2U) << "one does not work";
    EXPECT_EQ(best[0], &found[1]);
    EXPECT_EQ(best_working(found, 1), std::vector<SetUpChoice*>{&found[1]});
    EXPECT_EQ(setup_table(now, found, {}).find("frame"), std::string::npos);
    now.cost = SetUpCost{1.0, 1.0, 5e4};
    found[1].cost = SetUpCost{1.37, 1.21, 65'432.0};
    EXPECT_NE(setup_table(now, found, {}).find("1.37 (1.21)"), std::string::npos);
    std::istringstream csv(setup_csv(now, found));
    std::vector<std::string> lines;
    for (std::string line; std::getline(csv, line);) {
        lines.push_back(line);
        EXPECT_EQ(fields_in(line), fields_in(lines.front())) << line;
    }
    ASSERT_EQ(lines.size(), 5U);
    EXPECT_NE(lines[0].find(",frame_times_now,frame_cpu_times_now,frame_samples"), std::string::npos);
    EXPECT_NE(lines[3].find(",1.3700,1.2100,65432"), std::string::npos);
    EXPECT_NE(lines[2].find(",,,,"), std::string::npos) << "three empty fields";
}

TEST(Advice, ReportsWhenNothingWorks) {
    AdviceOptions options;
    options.lowest_m = options.highest_m = 0.6;
    options.sides_m = 0.0;
    options.evenness = 0.9;
    const std::vector<SetUpChoice> found = choices(old_table(), options, [](double) {});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_FALSE(found.front().works);
    const std::string table = setup_table(as_it_is(old_table()), found, options);
    EXPECT_LT(table.find(" no "), table.find("\nlens: ")); // in a row, not in the legend
}

} // namespace
} // namespace frustumscreen::bench

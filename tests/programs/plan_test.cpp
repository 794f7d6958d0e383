// The explained plan compared with the running show: a minimal, an ordinary and a full scene, on packs made in memory.
// Bytes and programs are queried from OpenGL; pictures are compared pixel by pixel with those of a show that leaves
// nothing out.

#include "app/render/read_back.h"
#include "app/scene/device_plan.h"
#include "app/show/artifact_show.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/base/temporary_folder.h"
#include "tests/render/synthetic_pack.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

namespace frustumscreen::synthetic {
namespace {

namespace fs = std::filesystem;

/// Rings at four levels, each with its own picture.
pack::Pack full_pack() {
    pack::Pack pack = rings(12, 4);
    for (const auto& [around, across] : {std::pair(16U, 8U), std::pair(24U, 12U), std::pair(48U, 24U)}) {
        pack::Pack finer = rings(around, across);
        finer.levels[0].texture = static_cast<std::uint32_t>(pack.textures.size());
        pack.levels.push_back(finer.levels[0]);
        image::Image8 texture(256, 192);
        for (std::size_t k = 0; k < texture.texels.size(); ++k) {
            const auto shade = static_cast<std::uint8_t>(60 + (k * 37 + k / 256 * 91) % 180);
            texture.texels[k] = {shade, 255 - shade, static_cast<std::uint8_t>(40 * around), 255};
        }
        pack.textures.push_back(texture);
    }
    const std::array<float, 4> p95{8e-3F, 4e-3F, 1e-3F, 1e-4F};
    for (std::size_t k = 0; k < p95.size(); ++k) {
        pack.levels[k].error = {p95[k] / 3, p95[k], 3 * p95[k], 1.0F};
    }
    pack.title = "Rings";
    pack.languages = {"en", "de"};
    pack.captions = {{"en", "Rings", "Three of them"}, {"de", "Ringe", "Drei Stück"}};
    complete(pack);
    pack.samples = 2;
    pack.default_level = 2;
    return pack;
}

constexpr std::string_view stage = "[projector]\nwidth = 320\nheight = 200\n";
constexpr std::string_view minimal =
    "[tracker]\nkind = \"none\"\n[eye]\ntracked = false\n[exhibit]\ncaptions = false\n";
constexpr std::string_view ordinary =
    "[render]\nerror_tolerance_px = 0.1\n[panel]\nscript = [{at_s = 1.0, button = 1}]\n";
constexpr std::string_view full =
    "[tracker]\nkind = \"replay\"\nposes = \"poses.csv\"\n[render]\nerror_tolerance_px = 0.01\n"
    "[panel]\nscript = [{at_s = 1.0, button = 1}, {at_s = 2.0, button = 2}]\n";

std::size_t programs_that_exist() {
    std::size_t count = 0;
    for (GLuint name = 1; name < 1000; ++name) {
        count += glIsProgram(name) == GL_TRUE ? 1U : 0U;
    }
    return count;
}

class PlanAgainstShow : public WithTemporaryFolder {
protected:
    void SetUp() override {
        file = folder / "full.fspack";
        const Result<Bytes> bytes = pack::write_pack(full_pack());
        ASSERT_TRUE(bytes) << bytes.error().message;
        ASSERT_TRUE(write_file(file, *bytes));
    }
    void configure(std::string_view text) {
        settings = **settings::parse_settings(std::string(stage) + std::string(text), "kiosk.toml");
        settings.projector.refresh_hz = 1e-3; // no deadline: both shows draw the level for the tolerance
    }
    std::unique_ptr<show::ArtifactShow> show(unsigned cull_kinds, const std::string& technique = "auto") {
        const scene::DevicePlan devices = scene::plan_devices(settings, false, false);
        return show::ArtifactShow::create(settings, devices,
                                          {{file}, technique, render::default_samples, cull_kinds},
                                          {display->framebuffer(), 0})
            .value();
    }
    image::Image8 picture(show::ArtifactShow& of, exhibit::Exhibit& exhibit, MonotonicTime now,
                          const tracking::TrackedState& tracked_state) {
        const exhibit::Presentation presentation = exhibit.step(now, {}, tracked_state);
        EXPECT_TRUE(of.draw(now, presentation, std::span(&tracked_state.eye_m, 1),
                            {display->framebuffer(), 0}, render::Redraw::Everything)
                        .drawn);
        return render::read_colour(display->framebuffer(), 320, 200);
    }
    /// Seeded situations that the settings allow.
    std::vector<tracking::TrackedState> situations(int count) {
        std::mt19937 random(11);
        std::uniform_real_distribution<double> u(-1.0, 1.0);
        std::vector<tracking::TrackedState> all;
        for (int k = 0; k < count; ++k) {
            tracking::TrackedState tracked_state;
            tracked_state.prop_known = true;
            tracked_state.eye_m = settings.eye.default_m;
            if (settings.tracker.kind != settings::TrackerKind::None) {
                const double yaw = 3.1416 * u(random);
                tracked_state.table_from_prop = {{std::cos(yaw / 2), 0.0, 0.0, std::sin(yaw / 2)},
                                                 {0.25 * u(random), 0.12 * u(random), 0.0}};
            }
            if (settings.tracker.kind ==
                settings::TrackerKind::Replay) { // lifted and tilted, seen from below
                tracked_state.table_from_prop.rotation =
                    glm::normalize(glm::dquat(1.0, 0.4 * u(random), 0.4 * u(random), u(random)));
                tracked_state.table_from_prop.translation.z = 0.1 + 0.1 * u(random);
            }
            if (settings.eye.tracked) {
                const bool anywhere = settings.tracker.kind == settings::TrackerKind::Replay;
                const double elevation = glm::radians(anywhere ? 80.0 * u(random) : 52.5 + 37.5 * u(random));
                const double azimuth = 3.1416 * u(random);
                tracked_state.eye_m =
                    tracked_state.table_from_prop.translation +
                    (1.2 + 0.8 * u(random)) * glm::dvec3(std::cos(elevation) * std::cos(azimuth),
                                                         std::cos(elevation) * std::sin(azimuth),
                                                         std::sin(elevation));
            }
            all.push_back(tracked_state);
        }
        return all;
    }
    /// Compares `count` pictures of both shows; returns the number that are not entirely black.
    int expect_same_pictures(show::ArtifactShow& a, show::ArtifactShow& b, int count) {
        int lit = 0;
        const std::size_t programs = programs_that_exist();
        MonotonicTime now;
        exhibit::Exhibit exhibit_of_a = show::make_exhibit(settings, a, now);
        exhibit::Exhibit exhibit_of_b = show::make_exhibit(settings, b, now);
        for (const tracking::TrackedState& tracked_state : situations(count)) {
            now += std::chrono::milliseconds(700);
            const image::Image8 first = picture(a, exhibit_of_a, now, tracked_state);
            const image::Image8 second = picture(b, exhibit_of_b, now, tracked_state);
            EXPECT_EQ(first.texels, second.texels);
            lit += std::any_of(first.texels.begin(), first.texels.end(),
                               [](const glm::u8vec4& t) { return t.r + t.g + t.b > 0; })
                       ? 1
                       : 0;
        }
        EXPECT_EQ(programs_that_exist(), programs); // no frame creates a program
        return lit;
    }
    void expect_as_planned(const show::ArtifactShow& of, std::size_t programs) {
        const show::ShowUse use = of.use();
        EXPECT_EQ(use.planned_gpu_bytes, use.gpu_bytes);
        EXPECT_EQ(use.planned_shaders, use.shaders);
        EXPECT_EQ(use.shaders.size(), programs);
        EXPECT_EQ(programs_that_exist(), programs);
        for (const residency::LevelUse& level : of.levels(0).uses()) {
            EXPECT_EQ(level.planned_gpu_bytes, level.gpu_bytes);
        }
    }

    fs::path file;
    settings::Settings settings;
    std::unique_ptr<display::SurfacelessDisplay> display =
        display::SurfacelessDisplay::create(320, 200).value();
};

TEST_F(PlanAgainstShow, MatchesForAMinimalScene) {
    int lit = 0;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (int k = 0; k < 12; ++k) { // each viewer is a scene and a plan of its own
        configure(minimal);
        settings.eye.default_m = {0.6 * u(random), -0.6 + 0.3 * u(random), 0.45 + 0.35 * u(random)};
        const auto lean = show(scene::AllCullKinds, "level3");
        expect_as_planned(*lean, 6); // outline, artifact, edges, three for the sample headroom
        EXPECT_EQ(lean->levels(0).uses().size(), 1U);
        EXPECT_GT(lean->levels(0).uses()[0].unseen_triangles, 1000U); // of 6912; one eye sees about half
        EXPECT_EQ(lean->use().captions, 0U);
        const auto everything = show(0, "level3");
        EXPECT_LT(lean->use().gpu_bytes, everything->use().gpu_bytes);
        lit += expect_same_pictures(*lean, *everything, 1);
    }
    EXPECT_EQ(lit, 12);
}

TEST_F(PlanAgainstShow, MatchesForAnOrdinaryScene) {
    configure(ordinary);
    const auto lean = show(scene::AllCullKinds);
    const scene::ScenePlan& plan = lean->plan(0);
    EXPECT_FALSE(plan.left_out.empty());
    EXPECT_LT(plan.levels.size(), 4U);
    EXPECT_EQ(lean->use().captions, 1U); // no button changes the language
    EXPECT_GT(lean->levels(0).uses()[0].unseen_triangles, 0U);
    expect_as_planned(*lean, scene::shaders_of(plan.needs).size());
    const auto everything = show(0);
    EXPECT_EQ(everything->levels(0).uses().size(), 4U);
    EXPECT_EQ(everything->use().planned_gpu_bytes, everything->use().gpu_bytes);
    EXPECT_LT(lean->use().gpu_bytes, everything->use().gpu_bytes);
    EXPECT_GT(expect_same_pictures(*lean, *everything, 30), 25);
}

TEST_F(PlanAgainstShow, MatchesForEachCullKindAlone) {
    configure(ordinary);
    const auto everything = show(0);
    for (unsigned cull_kind = 1; cull_kind < scene::AllCullKinds; cull_kind <<= 1U) {
        const auto one = show(cull_kind);
        EXPECT_EQ(one->use().planned_gpu_bytes, one->use().gpu_bytes) << cull_kind;
        EXPECT_EQ(one->use().planned_shaders, one->use().shaders) << cull_kind;
        expect_same_pictures(*one, *everything, 4);
    }
}

TEST_F(PlanAgainstShow, MatchesForAFullScene) {
    configure(full);
    const auto lean = show(scene::AllCullKinds);
    EXPECT_EQ(lean->plan(0).levels, (std::vector<std::uint32_t>{3U, 2U, 1U, 0U}));
    EXPECT_EQ(lean->use().captions, 2U);
    for (const residency::LevelUse& level : lean->levels(0).uses()) {
        EXPECT_EQ(level.unseen_triangles, 0U); // nothing can be proved about a recording
    }
    expect_as_planned(*lean, 8); // every shader except those without light compensation
    const auto everything = show(0);
    EXPECT_EQ(everything->use().gpu_bytes, lean->use().gpu_bytes);
    EXPECT_EQ(everything->use().shaders.size(), 10U);
    EXPECT_GT(expect_same_pictures(*lean, *everything, 30), 20);
}

TEST_F(PlanAgainstShow, FixedSceneLeavesOutTheFinestMipLevels) {
    pack::Pack fine = full_pack();
    image::Image8 texture(2048, 1536);
    for (std::size_t k = 0; k < texture.texels.size(); ++k) {
        texture.texels[k] = glm::u8vec4(glm::u8vec3(static_cast<std::uint8_t>(40 + k / 16 % 200)), 255);
    }
    fine.textures[1] = texture;
    fine.samples = 1;
    ASSERT_TRUE(write_file(file, *pack::write_pack(fine)));
    configure(minimal);
    const auto lean = show(scene::AllCullKinds, "level1");
    const residency::LevelUse& level = lean->levels(0).uses()[0];
    EXPECT_GE(level.finest_mip, 2);
    EXPECT_EQ(level.texture, glm::ivec2(2048 >> level.finest_mip, 1536 >> level.finest_mip));
    EXPECT_EQ(lean->use().planned_gpu_bytes, lean->use().gpu_bytes);
    const auto everything = show(0, "level1");
    EXPECT_EQ(expect_same_pictures(*lean, *everything, 1), 1);
}

} // namespace
} // namespace frustumscreen::synthetic

// The reader's thread, with work invented by the test.

#include "app/pack/pack_relief.h"
#include "app/residency/artifact_reader.h"
#include "app/residency/loaded.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/render/ring_relief.h"
#include "tests/show/shown_packs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <random>
#include <thread>

namespace frustumscreen::show {
namespace {

/// Waits without a limit: a failing test is ended from outside.
std::unique_ptr<residency::ArtifactReader::Answer> await(residency::ArtifactReader& reader) {
    while (true) {
        if (auto answer = reader.take()) {
            return answer;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

Result<residency::ArtifactReader::Prepared> numbered(std::size_t artifact) {
    return bad_input("test.refusal", std::to_string(artifact)); // the quickest answer
}

TEST(ArtifactReader, AnswersEachRequest) {
    residency::ArtifactReader reader([](std::size_t artifact, const auto&) { return numbered(artifact); });
    for (const std::size_t artifact : {3U, 0U, 7U, 7U}) {
        reader.request(artifact);
        const auto answer = await(reader);
        EXPECT_EQ(answer->item, artifact);
        EXPECT_EQ(answer->prepared.error().message, std::to_string(artifact));
        reader.request(std::nullopt);
    }
    EXPECT_FALSE(reader.take());
}

TEST(ArtifactReader, CancelsAReadThatIsNoLongerRequested) {
    std::atomic<int> begun = 0;
    std::atomic<int> given_up_count = 0;
    residency::ArtifactReader reader([&](std::size_t artifact, const auto& given_up) {
        ++begun;
        while (artifact == 1 && !given_up()) { // does not end by itself
            std::this_thread::yield();
        }
        given_up_count += artifact == 1 ? 1 : 0;
        return numbered(artifact);
    });
    reader.request(1);
    while (begun == 0) {
        std::this_thread::yield();
    }
    reader.request(2);
    EXPECT_EQ(await(reader)->item, 2U);
    EXPECT_EQ(given_up_count, 1);
}

TEST(ArtifactReader, DestructorCancelsTheReadInProgress) {
    std::atomic<bool> begun = false;
    std::atomic<bool> gave_up = false;
    {
        residency::ArtifactReader reader([&](std::size_t artifact, const auto& given_up) {
            begun = true;
            while (!given_up()) {
                std::this_thread::yield();
            }
            gave_up = true;
            return numbered(artifact);
        });
        reader.request(0);
        while (!begun) {
            std::this_thread::yield();
        }
    }
    EXPECT_TRUE(gave_up) << "the reader is gone, and its thread still works";
}

/// Requests faster than the reader: every answer was requested, and the last request is answered.
TEST(ArtifactReader, AnswersTheLastOfManyRequests) {
    std::mt19937 random(3);
    for (int round = 0; round < 50; ++round) {
        residency::ArtifactReader reader([](std::size_t artifact, const auto& given_up) {
            for (int piece = 0; piece < 20 && !given_up(); ++piece) {
                std::this_thread::yield();
            }
            return numbered(artifact);
        });
        for (int wish = 0; wish < 100; ++wish) {
            reader.request(random() % 3 == 0 ? std::nullopt : std::optional<std::size_t>(random() % 4));
            if (const auto answer = reader.take()) {
                EXPECT_EQ(answer->prepared.error().message, std::to_string(answer->item));
            }
        }
        reader.request(9);
        while (await(reader)->item != 9) {
        }
    }
}

TEST(ArtifactReader, PreparesTheSameDataAsPrepareLevel) {
    const synthetic::ShownPacks packs(1);
    const residency::KnownArtifact known = packs.known(0);
    residency::ArtifactReader reader(
        [&](std::size_t, const auto& given_up) -> Result<residency::ArtifactReader::Prepared> {
            return residency::prepare_artifact(known, "auto", 16.0, given_up);
        });
    reader.request(0);
    const auto answer = await(reader);
    ASSERT_TRUE(answer->prepared) << answer->prepared.error().message;
    const auto& prepared = std::get<residency::PreparedArtifact>(*answer->prepared);
    const Result<pack::VerifiedPack> pack = pack::load_pack(known.file);
    ASSERT_EQ(prepared.data.size(), known.plan.levels.size());
    std::vector<residency::PreparedLevel> before;
    for (std::size_t place = 0; place < known.plan.levels.size(); ++place) {
        const residency::PreparedLevel level =
            residency::prepare_level(**pack, known.plan.levels[place], known.plan, before);
        const scene::LevelData& data = prepared.data[place];
        EXPECT_EQ(data.texture_of, place == 0 ? std::nullopt : std::optional<std::size_t>(0));
        EXPECT_EQ(level.data.texture_of, data.texture_of);
        EXPECT_EQ(data.vertices.size(), level.data.vertices.size());
        ASSERT_EQ(data.mips.size(), level.data.mips.size());
        for (std::size_t mip = 0; mip < data.mips.size(); ++mip) {
            EXPECT_EQ(data.mips[mip].texels, level.data.mips[mip].texels);
        }
        before.push_back(level);
    }
}

/// The relief's own colours are those of a darker artifact, so its own exposure would be much brighter.
TEST(ArtifactReader, ExposesAReliefLikeTheMeshesOfItsArtifact) {
    const synthetic::ShownPacks packs(1);
    residency::KnownArtifact known = packs.known(0);
    pack::Pack pack = synthetic::numbered_pack(0);
    std::shared_ptr<relief::BlockRelief> relief =
        std::make_shared<relief::BlockRelief>(*synthetic::relief_of(pack, 96));
    std::fill(relief->colours.begin(), relief->colours.end(), glm::u8vec4(60, 60, 60, 255));
    pack::put_reliefs(pack, std::vector<pack::MeasuredRelief>{{*relief, {1e-3F, 2e-3F, 3e-3F, 0.0F}}});
    ASSERT_TRUE(write_file(known.file, pack::write_pack(pack).value()));
    known.outline = pack::outline_of(pack);
    const auto exposure = [&](const std::string& technique) {
        scene::SceneRequest request;
        request.technique = technique;
        known.plan = scene::plan_scene(settings::steep_table(), known.outline, request).value();
        return residency::prepare_artifact(known, technique, 16.0, [] { return false; }).value().exposure;
    };
    const double of_mesh = exposure(fmt::format("level{}", pack.default_level));
    EXPECT_GT(of_mesh, 0.0);
    EXPECT_EQ(exposure("relief"), of_mesh);
    EXPECT_EQ(exposure("relief96"), of_mesh);
}

/// The governor measures what its quality levels draw; the relief is in the GPU memory only if one of them draws it there.
TEST(ArtifactReader, PreparesAReliefOnlyInTheWaysItsQualityLevelsDrawIt) {
    const synthetic::ShownPacks packs(1);
    residency::KnownArtifact known = packs.known(0);
    pack::Pack pack = synthetic::numbered_pack(0);
    pack::put_reliefs(pack, std::vector<pack::MeasuredRelief>{
                                {*synthetic::relief_of(pack, 96), {1e-6F, 1e-6F, 1e-6F, 0.0F}}});
    ASSERT_TRUE(write_file(known.file, pack::write_pack(pack).value()));
    known.outline = pack::outline_of(pack);
    settings::Settings settings = settings::steep_table();
    settings.render.error_tolerance_px = 100.0;
    auto display = display::SurfacelessDisplay::create(320, 200).value();
    render::Renderer renderer = render::Renderer::create(320, 200).value();
    const synthetic::TestTable table(320, 200);
    for (const std::uint32_t max_blocks : {0U, 1U << 20U}) {
        scene::SceneRequest request;
        request.light = false;
        request.max_blocks_on_gpu = max_blocks;
        known.plan = scene::plan_scene(settings, known.outline, request).value();
        const std::uint64_t before = renderer.store().bytes();
        residency::LoadedLevels loaded(
            residency::prepare_artifact(known, "auto", 1e9, [] { return false; }).value());
        residency::RunLevels& levels = loaded.artifact.levels;
        ASSERT_TRUE(renderer.prepare(levels.needs()));
        while (!loaded.ready()) {
            ASSERT_TRUE(loaded.upload(renderer.store(), 10'000));
        }
        std::uint64_t planned = 0;
        std::size_t on_gpu = 0;
        for (const residency::LevelUse& use : levels.uses()) {
            planned += use.planned_gpu_bytes;
            EXPECT_EQ(use.planned_gpu_bytes, use.gpu_bytes);
            on_gpu += use.on_gpu ? 1U : 0U;
        }
        EXPECT_EQ(on_gpu, max_blocks > 0 ? 1U : 0U);
        EXPECT_EQ(renderer.store().bytes() - before, planned);
        const scene::PlanView view = table.view();
        levels.measure(table.prop, std::span(&view, 1), renderer, {display->framebuffer(), 0});
        for (const scene::QualityLevelTime& time : levels.times()) {
            EXPECT_GT(time.ms, 0.0);
            EXPECT_LT(time.ms, 60e3) << "it was measured";
        }
        for (const char* way : {"relief96", "relief96-gpu"}) {
            std::vector<scene::QualityLevelTime> times = levels.times();
            for (scene::QualityLevelTime& time : times) {
                time.ms = time.relief && time.on_gpu == (std::string_view(way) == "relief96-gpu") ? 2.0 : 9.0;
            }
            levels.start(times);
            const bool is_there = max_blocks > 0 || std::string_view(way) == "relief96";
            EXPECT_EQ(levels.state().level == way, is_there) << way << " " << levels.state().level;
        }
        levels.release(renderer.store());
        EXPECT_EQ(renderer.store().bytes(), before);
    }
}

} // namespace
} // namespace frustumscreen::show

// Torches' contents in memory: read from a pack by the thread, uploaded in pieces, released with its artifact; films frame by
// frame.
#include "app/image/film_frame.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_torches.h"
#include "app/residency/torch_contents.h"
#include "firmware_host/base/file.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/base/comes_true.h"
#include "tests/base/temporary_folder.h"
#include "tests/render/synthetic_pack.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <string>
#include <thread>

namespace frustumscreen::residency {
namespace {

constexpr int side = 16;
constexpr std::uint32_t frames = 5;

torch::Content content(const std::string& name, torch::Source source, std::uint32_t item = 0) {
    torch::Stage stage;
    stage.source = source;
    stage.item = item;
    return {.name = name, .blend = torch::Blend::Light, .stages = {stage}};
}

class TorchContentsTest : public WithTemporaryFolder {
protected:
    /// A ring, a picture, a film, and a second picture of `large` texels a side.
    void SetUp() override {
        pack::Pack pack = synthetic::rings();
        pack.title = "Rings";
        pack.provenance.source_name = "rings.glb";
        pack.provenance.source_sha256 = std::string(64, 'a');
        pack.relief_size = 512;
        for (unsigned k = 0; k < 8; ++k) {
            pack.extremes.emplace_back(((k & 1U) != 0 ? 0.5 : -0.5) * pack.box_size.x,
                                       ((k & 2U) != 0 ? 0.5 : -0.5) * pack.box_size.y,
                                       (k & 4U) != 0 ? pack.box_size.z : 0.0);
        }
        pack::PackTorches torches;
        torches.contents = {{content("ring", torch::Source::Ring), {}},
                            {content("picture", torch::Source::Picture, 0), {}},
                            {content("film", torch::Source::Film, 0), {}},
                            {content("large", torch::Source::Picture, 1), {}}};
        torches.pictures = {{side, side, ""}, {large, large, ""}};
        torches.films = {{.width = side, .height = side, .frames = frames, .rate_hz = 10.0}};
        pack::TorchParts parts;
        parts.pictures = {image::encode_webp(image::Image8(side, side, {200, 0, 0, 255})),
                          image::encode_webp(image::Image8(large, large, {0, 0, 200, 255}))};
        parts.films.emplace_back();
        for (std::uint32_t k = 0; k < frames; ++k) {
            parts.films[0].push_back(image::encode_film_frame(
                image::Image8(side, side, {static_cast<std::uint8_t>(40 * k), 0, 0, 255}), 90.0F));
        }
        const Result<void> put = pack::put_torches(pack, torches, std::move(parts));
        ASSERT_TRUE(put) << put.error().message;
        const Result<Bytes> bytes = pack::write_pack(pack);
        ASSERT_TRUE(bytes) << bytes.error().message;
        ASSERT_TRUE(write_file(folder / "rings.fspack", *bytes));
        const Result<pack::PackTorches> read = pack::torches_of(pack);
        ASSERT_TRUE(read) << read.error().message;
        thrown_ = {.file = folder / "rings.fspack", .torches = *read};
    }
    [[nodiscard]] TorchContents contents(bool waits, std::uint64_t max_bytes = 48'000'000) const {
        return TorchContents({thrown_, thrown_}, {.max_bytes = max_bytes, .waits = waits, .program = "test"});
    }
    /// Steps until the content is there; may loop forever.
    void await(TorchContents& torches, std::size_t content) {
        const std::array wanted{WantedContent{content, 0.0}};
        for (torches.step(store_, 0, wanted); !torches.shown(content).ready;
             torches.step(store_, 0, wanted)) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    static constexpr int large = 1500;
    std::unique_ptr<display::Display> display_ = display::SurfacelessDisplay::create(64, 64).value();
    render::GpuStore store_;
    ThrownContents thrown_;
};

TEST_F(TorchContentsTest, ReadsAPictureOnlyWhenRequestedAndNothingForAnEffect) {
    TorchContents torches = contents(true);
    const std::array ring{WantedContent{0, 0.0}};
    torches.step(store_, 0, ring);
    EXPECT_TRUE(torches.shown(0).ready);
    EXPECT_EQ(torches.bytes(), 0U);
    EXPECT_FALSE(torches.shown(1).ready);
    const std::array picture{WantedContent{1, 0.0}};
    torches.step(store_, 0, picture);
    EXPECT_TRUE(torches.shown(1).ready);
    EXPECT_NE(store_.find(torches.shown(1).picture), nullptr);
    EXPECT_GT(torches.bytes(), 4U * side * side);
    torches.release(store_);
}

TEST_F(TorchContentsTest, HalvesAPictureThatIsTooLargeToUploadInAFrame) {
    TorchContents torches = contents(true);
    torches.step(store_, 0, std::array{WantedContent{3, 0.0}});
    ASSERT_TRUE(torches.shown(3).ready);
    EXPECT_LE(torches.bytes(), TorchContents::max_upload_bytes * 4 / 3);
    EXPECT_GE(torches.bytes(), std::uint64_t{4} * (large / 2) * (large / 2));
    torches.release(store_);
}

TEST_F(TorchContentsTest, FilmShowsTheFrameOfItsTimeAndLoops) {
    TorchContents torches = contents(true);
    std::uint32_t version = 0;
    torches.step(store_, 0, std::array{WantedContent{2, 0.0}});
    ASSERT_TRUE(torches.shown(2).ready);
    const scene::TextureId texture = torches.shown(2).picture;
    for (int k = 1; k < 12; ++k) { // a frame each
        torches.step(store_, 0, std::array{WantedContent{2, 0.1 * k + 0.01}});
        EXPECT_EQ(torches.shown(2).picture, texture);
        EXPECT_EQ(torches.shown(2).version, ++version) << k;
    }
    for (int k = 0; k < 3; ++k) { // the same moment: nothing is uploaded
        torches.step(store_, 0, std::array{WantedContent{2, 1.11 + 0.01 * k}});
        EXPECT_EQ(torches.shown(2).version, version);
    }
    torches.release(store_);
}

TEST_F(TorchContentsTest, ThreadLoadsAllContentsAndAdvancesTheFilm) {
    TorchContents torches = contents(false);
    for (const std::size_t content : {1U, 2U, 3U}) {
        await(torches, content);
    }
    std::uint32_t last = torches.shown(2).version;
    int changes = 0;
    int step = 0; // of the film's time, which stands still while the test does
    EXPECT_TRUE(comes_true([&] {
        torches.step(store_, 0, std::array{WantedContent{2, 0.002 * step++}});
        changes += torches.shown(2).version != last ? 1 : 0;
        last = torches.shown(2).version;
        return changes == 8;
    }));
    torches.release(store_);
}

TEST_F(TorchContentsTest, ChangingTheArtifactReleasesItsContents) {
    TorchContents torches = contents(true);
    torches.step(store_, 0, std::array{WantedContent{1, 0.0}, WantedContent{2, 0.0}});
    const scene::TextureId picture = torches.shown(1).picture, film = torches.shown(2).picture;
    torches.step(store_, 1, {});
    EXPECT_EQ(store_.find(picture), nullptr);
    EXPECT_EQ(store_.find(film), nullptr);
    EXPECT_EQ(torches.bytes(), 0U);
    EXPECT_FALSE(torches.shown(1).ready);
    torches.step(store_, 1, std::array{WantedContent{1, 0.0}});
    EXPECT_TRUE(torches.shown(1).ready);
    torches.release(store_);
    EXPECT_EQ(store_.bytes(), 0U);
}

TEST_F(TorchContentsTest, LeavesOutOnlyContentsThatAreTooLargeOrUnreadable) {
    TorchContents small = contents(true, 10'000);
    small.step(store_, 0, std::array{WantedContent{1, 0.0}, WantedContent{3, 0.0}});
    EXPECT_TRUE(small.shown(1).ready);
    EXPECT_FALSE(small.shown(3).ready);
    EXPECT_LE(small.bytes(), 10'000U);
    small.release(store_);

    std::filesystem::remove(folder / "rings.fspack");
    TorchContents none = contents(true);
    none.step(store_, 0, std::array{WantedContent{0, 0.0}, WantedContent{1, 0.0}});
    EXPECT_TRUE(none.shown(0).ready);
    EXPECT_FALSE(none.shown(1).ready);
    none.step(store_, 0, std::array{WantedContent{1, 0.0}}); // it is not tried again
    none.release(store_);
}

} // namespace
} // namespace frustumscreen::residency

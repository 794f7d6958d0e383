#include "app/bench/measures/counts.h"
#include "assets_baked/artifacts/builtin.h"
#include "assets_baked/bake/bake.h"
#include "firmware_host/base/file.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace frustumscreen::bench {
namespace {

SetUp set_up_of(const char* name) {
    const Result<settings::CheckedSettings> settings = settings::load_settings(
        std::filesystem::path(source_dir()) / "config" / (std::string(name) + ".toml"));
    EXPECT_TRUE(settings) << settings.error().message;
    return {name, **settings};
}

/// The reference's small amphora, baked for this test.
const pack::Pack& small_amphora() {
    static const pack::Pack pack = [] {
        const Result<bake::SourceMesh> mesh = artifacts::make_builtin("amphora", 20'000);
        bake::BakeOptions options;
        options.size = 128;
        options.unlit = true;
        pack::Pack made = *bake::bake(*mesh, options);
        made.provenance.source_name = "amphora.glb";
        return made;
    }();
    return pack;
}

std::vector<CountedPack> reference() {
    const Result<Bytes> bytes =
        read_file(std::filesystem::path(source_dir()) / "docs" / "reference_counts.json");
    EXPECT_TRUE(bytes) << bytes.error().message;
    Result<std::vector<CountedPack>> counts = read_counts(as_text(*bytes));
    EXPECT_TRUE(counts) << counts.error().message;
    return *counts;
}

TEST(Counts, AFrameTakesNoMoreThanTheProjectsReference) {
    for (const char* name : {"near", "kiosk"}) {
        const Result<CountedPack> counted = count_frames(set_up_of(name), small_amphora(), 50, 1);
        ASSERT_TRUE(counted) << counted.error().message;
        const std::vector<CountedPack> now{*counted};
        const std::vector<CountChange> against = changes(now, reference());
        ASSERT_EQ(against.size(), 1U) << counted->artifact << " in " << name << " is not in the reference";
        EXPECT_FALSE(against[0].grown) << counts_table(now, against)
                                       << "explain the growth, then write docs/reference_counts.json again";
    }
}

TEST(Counts, CountsATriangleAtMostOncePerPropFace) {
    const Result<CountedPack> counted = count_frames(set_up_of("near"), small_amphora(), 8, 3);
    ASSERT_TRUE(counted) << counted.error().message;
    const pack::PackLevel& level = small_amphora().levels[small_amphora().default_level];
    const FrameCounts& counts = counted->counts;
    EXPECT_GT(counts.triangles,
              0.25 * static_cast<double>(level.indices.size()) / 3.0); // one side of it is visible
    EXPECT_LT(counts.triangles, counts.draw_calls * static_cast<double>(level.indices.size()) / 3.0);
    EXPECT_LE(counts.vertices, static_cast<double>(level.vertices.size()));
    EXPECT_LE(counts.vertices, 3.0 * counts.triangles);
    EXPECT_GE(counts.bytes, 12.0 * counts.triangles + 12.0 * counts.vertices + 4.0 * 1280 * 800);
}

TEST(Counts, RoundTrip) {
    const std::vector<CountedPack> written{{"a.glb, 5 triangles", "near", {1.5, 2.0, 3.0, 4.0, 5e6}}};
    const Result<std::vector<CountedPack>> read = read_counts(counts_json(written));
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->size(), 1U);
    EXPECT_EQ((*read)[0].artifact, written[0].artifact);
    EXPECT_EQ((*read)[0].counts.triangles, 1.5);
    EXPECT_EQ((*read)[0].counts.bytes, 5e6);
}

TEST(Counts, ReportsGrowthBeyondAFewPercent) {
    const std::vector<CountedPack> before{{"a", "near", {100, 100, 4, 1000, 1e6}}, {"b", "near", {}}};
    std::vector<CountedPack> now{{"a", "near", {104, 100, 4, 1000, 1e6}}, {"c", "near", {1, 1, 1, 1, 1}}};
    ASSERT_EQ(changes(now, before).size(), 1U); // only packs in both
    EXPECT_FALSE(changes(now, before)[0].grown);
    now[0].counts.samples = 1100;
    EXPECT_TRUE(changes(now, before)[0].grown);
    EXPECT_NE(counts_table(now, changes(now, before)).find("1100 (+10.0 %)"), std::string::npos);
    EXPECT_NE(counts_table(now, changes(now, before)).find("GROWN"), std::string::npos);
}

TEST(Counts, NamesArtifactsMissingFromTheReference) {
    const std::vector<CountedPack> reference{{"a", "near", {}}, {"b", "near", {}}};
    const std::vector<CountedPack> now{{"a", "near", {}}, {"a", "kiosk", {}}, {"c", "near", {}}};
    EXPECT_EQ(without_reference(now, reference), (std::vector<std::string>{"a in kiosk", "c in near"}));
    EXPECT_TRUE(without_reference(reference, reference).empty());
}

TEST(Counts, RejectsAnInvalidReferenceInOneLine) {
    for (const char* text : {"", "{}", "[1]", R"({"mean_of_a_frame":[{"artifact":3}]})"}) {
        const Result<std::vector<CountedPack>> read = read_counts(text);
        ASSERT_FALSE(read) << text;
        EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
    }
}

} // namespace
} // namespace frustumscreen::bench

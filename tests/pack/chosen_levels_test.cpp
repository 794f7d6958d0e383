// Packs of which only some levels are read.
#include "tests/pack/samples.h"

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

ChooseLevels only(std::vector<std::uint32_t> levels) {
    return [levels = std::move(levels)](const PackOutline&) -> Result<std::vector<std::uint32_t>> {
        return levels;
    };
}

} // namespace

TEST(ChosenLevels, are_read_unchanged_and_others_are_empty) {
    const Pack pack = samples::pack();
    ASSERT_GT(pack.levels.size(), 1U);
    const Bytes bytes = samples::bytes_of(pack);
    for (std::uint32_t chosen = 0; chosen < pack.levels.size(); ++chosen) {
        const Result<VerifiedPack> read = verify_pack(bytes, only({chosen}));
        ASSERT_TRUE(read) << read.error().message;
        ASSERT_EQ((*read)->levels.size(), pack.levels.size());
        for (std::uint32_t k = 0; k < pack.levels.size(); ++k) {
            EXPECT_EQ((*read)->levels[k].indices.size(), k == chosen ? pack.levels[k].indices.size() : 0U);
            EXPECT_EQ((*read)->levels[k].error.p95_box, pack.levels[k].error.p95_box);
            EXPECT_EQ((*read)->levels[k].texture, pack.levels[k].texture);
        }
        const std::uint32_t worn = pack.levels[chosen].texture;
        EXPECT_EQ((*read)->textures[worn].texels, pack.textures[worn].texels);
        const bool relief = pack.levels[chosen].technique == LevelTechnique::Relief;
        EXPECT_EQ((*read)->relief.relief.texels.empty(), !relief);
    }
}

TEST(ChosenLevels, are_chosen_from_the_whole_outline) {
    const Pack pack = samples::pack();
    std::size_t seen = 0;
    const Result<VerifiedPack> read = verify_pack(
        samples::bytes_of(pack), [&](const PackOutline& outline) -> Result<std::vector<std::uint32_t>> {
            seen = outline.levels.size();
            for (std::size_t k = 0; k < seen; ++k) {
                EXPECT_EQ(outline.levels[k].triangles, pack.levels[k].indices.size() / 3);
                EXPECT_EQ(outline.levels[k].vertices, pack.levels[k].vertices.size());
            }
            EXPECT_TRUE(outline.description == pack);
            return std::vector<std::uint32_t>{};
        });
    EXPECT_TRUE(read);
    EXPECT_EQ(seen, pack.levels.size());
    const Result<VerifiedPack> refused =
        verify_pack(samples::bytes_of(pack), [](const PackOutline&) -> Result<std::vector<std::uint32_t>> {
            return bad_input("test.refusal", "none of them");
        });
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "none of them");
}

TEST(ChosenLevels, fail_only_when_their_own_parts_are_altered) {
    const Bytes bytes = samples::bytes_of(samples::pack());
    const Bytes picture = samples::take_apart(bytes).part("textures/0.png");
    const auto there = std::search(bytes.begin(), bytes.end(), picture.begin(), picture.end());
    ASSERT_NE(there, bytes.end());
    Bytes altered = bytes;
    altered[static_cast<std::size_t>(there - bytes.begin()) + picture.size() / 2] ^= std::byte{0x10};
    const Pack pack = samples::pack();
    for (std::uint32_t chosen = 0; chosen < pack.levels.size(); ++chosen) {
        EXPECT_EQ(verify_pack(altered, only({chosen})).has_value(), pack.levels[chosen].texture != 0)
            << chosen;
    }
    EXPECT_FALSE(verify_pack(altered));
}

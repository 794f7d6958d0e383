// The section relief_blocks: written, read and refused.
#include "app/pack/block_part.h"
#include "app/pack/pack_relief.h"
#include "tests/base/told.h"
#include "tests/folders.h"
#include "tests/pack/samples.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

/// Offsets from FORMAT.md, for three blocks in two directions.
constexpr std::size_t blocks = 3;
constexpr std::size_t first_grid = 24;
constexpr std::size_t columns = first_grid + 2 * 32;
constexpr std::size_t numbers = columns + 2 * 2 * blocks;
constexpr std::size_t masks = numbers + 9 * 4 * blocks;
constexpr std::size_t cuts = masks + 8 * blocks;
constexpr std::size_t heights = cuts + 8 * blocks;
constexpr std::size_t reds = heights + 81 * blocks;
constexpr std::size_t covers = reds + 3 * 81 * blocks; // four: one, two and one cell are cut

template <typename Number> Number read_at(const Bytes& bytes, std::size_t at) {
    Number number;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
}

template <typename Number> Bytes with(Bytes bytes, std::size_t at, Number number) {
    std::memcpy(bytes.data() + at, &number, sizeof number);
    return bytes;
}

std::string refusal(const Bytes& bytes) {
    const Result<relief::BlockRelief> relief = pack::decode_blocks(bytes);
    return relief ? std::string() : test::told(relief.error());
}

void expect_equal(const relief::BlockRelief& a, const relief::BlockRelief& b) {
    EXPECT_EQ(a.texel_box, b.texel_box);
    ASSERT_EQ(a.grids.size(), b.grids.size());
    for (std::size_t k = 0; k < a.grids.size(); ++k) {
        EXPECT_EQ(a.grids[k].axis, b.grids[k].axis);
        EXPECT_EQ(a.grids[k].sign, b.grids[k].sign);
        EXPECT_EQ(a.grids[k].origin_box, b.grids[k].origin_box);
    }
    EXPECT_EQ(a.first_block, b.first_block);
    ASSERT_EQ(a.blocks.size(), b.blocks.size());
    for (std::size_t k = 0; k < a.blocks.size(); ++k) {
        const relief::ReliefBlock& x = a.blocks[k];
        const relief::ReliefBlock& y = b.blocks[k];
        EXPECT_EQ(std::tuple(x.u0, x.v0, x.w0, x.w_u, x.w_v, x.residual_low, x.residual_step),
                  std::tuple(y.u0, y.v0, y.w0, y.w_u, y.w_v, y.residual_low, y.residual_step));
        EXPECT_EQ(x.gradient_u, y.gradient_u);
        EXPECT_EQ(x.gradient_v, y.gradient_v);
        EXPECT_EQ(x.cells, y.cells);
        EXPECT_EQ(std::tuple(x.mask, x.cut, x.first_cover), std::tuple(y.mask, y.cut, y.first_cover));
    }
    EXPECT_EQ(a.corner_codes, b.corner_codes);
    EXPECT_EQ(a.colours, b.colours);
    EXPECT_EQ(a.covers, b.covers);
}

} // namespace

TEST(ReliefBlocks, encoding_matches_the_format_page) {
    const relief::BlockRelief relief = samples::block_relief(32);
    const Bytes bytes = pack::encode_blocks(relief);
    ASSERT_EQ(bytes.size(), covers + 8 * relief.covers.size());
    EXPECT_EQ(as_text(bytes).substr(0, 4), "FSRB");
    EXPECT_EQ(read_at<std::uint32_t>(bytes, 8), 32U);
    EXPECT_EQ(read_at<std::uint32_t>(bytes, first_grid), 1U) << "-X";
    EXPECT_EQ(read_at<std::uint32_t>(bytes, first_grid + 32 + 4), 2U) << "blocks in +Z";
    EXPECT_EQ(read_at<double>(bytes, first_grid + 32 + 8 + 16), 0.0) << "z of its origin";
    EXPECT_EQ(read_at<std::uint16_t>(bytes, columns + 2), 1U) << "u0 is 8";
    EXPECT_EQ(read_at<float>(bytes, numbers + 4), 12.0F) << "w0 of the second block";
    EXPECT_EQ(read_at<std::uint64_t>(bytes, masks + 16), relief.blocks[2].mask);
    // Corner (0, 0) has code 40, its right neighbour 12 more, the one in the next row 7 more than the one above.
    EXPECT_EQ(read_at<std::uint8_t>(bytes, heights), 40U);
    EXPECT_EQ(read_at<std::uint8_t>(bytes, heights + 1), 12U);
    EXPECT_EQ(read_at<std::uint8_t>(bytes, heights + 9), 7U);
    EXPECT_EQ(read_at<std::uint8_t>(bytes, reds), 200U);
    EXPECT_EQ(read_at<std::uint8_t>(bytes, reds + 1), 255U) << "one less than on the left";
    EXPECT_EQ(read_at<std::uint64_t>(bytes, covers + 8), relief.covers[1]);
    // The same bytes, from a program written from the format page alone.
    EXPECT_EQ(bytes, read_file(source_dir() + "/tests/fuzz/corpus/relief_blocks/hill").value());
}

TEST(ReliefBlocks, a_part_written_and_read_is_equal) {
    const relief::BlockRelief relief = samples::block_relief(64);
    const Result<relief::BlockRelief> read = pack::decode_blocks(pack::encode_blocks(relief));
    ASSERT_TRUE(read) << read.error().message;
    expect_equal(*read, relief);
}

TEST(ReliefBlocks, a_damaged_part_is_refused) {
    const Bytes good = pack::encode_blocks(samples::block_relief(32));
    ASSERT_EQ(refusal(good), "");
    struct Fault {
        Bytes bytes;
        const char* words;
    };
    const float no_number = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Fault> faults{
        {{}, "FSRB"},
        {with(good, 0, 'X'), "FSRB"},
        {with(good, 4, std::uint32_t{2}), "version 2"},
        {with(good, 8, std::uint32_t{0}), "0 texels"},
        {with(good, 8, std::uint32_t{5000}), "5000 texels"},
        {with(good, 12, std::uint32_t{7}), "7 directions"},
        {with(good, 16, std::uint32_t{4}), "need"},
        {with(good, 16, std::numeric_limits<std::uint32_t>::max()), "blocks"},
        {Bytes(good.begin(), good.end() - 1), "need"},
        {with(good, first_grid, std::uint32_t{6}), "number 6"},
        {with(good, first_grid, std::uint32_t{4}), "number 4"}, // a repeated direction
        {with(good, first_grid + 4, std::uint32_t{4}), "more than"},
        {with(good, first_grid + 4, std::uint32_t{0}), "in all, it has"},
        {with(good, first_grid + 8, 1e30), "[blocks.origin]"},
        {with(good, columns, std::uint16_t{9}), "[blocks.outside_grid]"},
        {with(good, numbers, no_number), "block 0"},
        {with(good, numbers + 4, 2e6F), "block 1"},
        {with(good, numbers + 4 * 4 * blocks, 0.0F), "[blocks.step]"},
        {with(good, numbers + 5 * 4 * blocks, 1.0F), "[blocks.step]"},
        {with(good, masks, std::uint64_t{0}), "[blocks.step]"},
        {with(good, cuts, std::uint64_t{1}), "not there"},
        {with(good, cuts, std::uint64_t{0}), "cut 3 cells"},
        {with(good, 20, std::uint32_t{5}), "need"},
    };
    for (const Fault& fault : faults) {
        const std::string message = refusal(fault.bytes);
        EXPECT_TRUE(samples::is_one_line(message)) << message;
        EXPECT_NE(message.find(fault.words), std::string::npos) << fault.words << ": " << message;
    }
}

TEST(ReliefBlocks, each_relief_of_a_pack_is_read_alone) {
    const Pack pack = samples::pack_with_reliefs();
    const Bytes bytes = samples::bytes_of(pack);
    const Result<VerifiedPack> read = verify_pack(bytes);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(check_reliefs(**read));
    const std::vector<ReliefOutline> reliefs = reliefs_of(**read).value();
    ASSERT_EQ(reliefs.size(), 2U);
    EXPECT_EQ(reliefs[0].texels, 32U);
    EXPECT_EQ(reliefs[1].error, (LevelError{0.001F, 0.002F, 0.25F, 0.0F}));
    const std::filesystem::path file = "reliefs.fspack";
    ASSERT_TRUE(write_file(file, bytes));
    const Result<relief::BlockRelief> finer = load_relief(file, reliefs[1]);
    ASSERT_TRUE(finer) << finer.error().message;
    expect_equal(*finer, samples::block_relief(64));
    // A relief that contradicts the manifest is refused; a part that is not chosen is not read.
    ReliefOutline other = reliefs[1];
    other.blocks = 4;
    EXPECT_FALSE(load_relief(file, other));
    samples::Entries entries = samples::take_apart(bytes);
    entries.part(reliefs[0].part)[40] ^= std::byte{1};
    ASSERT_TRUE(write_file(file, samples::put_together(entries)));
    EXPECT_TRUE(load_relief(file, reliefs[1]));
    EXPECT_FALSE(load_relief(file, reliefs[0])) << "its hash is wrong";
}

TEST(ReliefBlocks, pack_without_reliefs_has_an_empty_list) {
    EXPECT_TRUE(reliefs_of(samples::pack()).value().empty());
    EXPECT_TRUE(reliefs_of(samples::full_pack()).value().empty());
    EXPECT_TRUE(check_reliefs(samples::full_pack()));
}

TEST(ReliefBlocks, inconsistent_section_is_refused) {
    const auto refusal_with = [](const std::string& from, const std::string& to) {
        Pack pack = samples::pack_with_reliefs();
        std::string& data = pack.sections.front().data;
        data.replace(data.find(from), from.size(), to);
        const Result<void> good = check_reliefs(pack);
        return good ? std::string() : test::told(good.error());
    };
    for (const auto& [from, to, words] :
         {std::tuple("\"texels\":32", "\"texels\":64", "finer"),
          std::tuple("\"texels\":32", "\"texels\":31", "altered"),
          std::tuple("\"blocks\":3", "\"blocks\":2", "altered"),
          std::tuple("\"max_box\":0.25", "\"max_box\":-1", "not a measured one"),
          std::tuple("relief_blocks/32.bin", "relief_blocks/33.bin", "exactly its own parts"),
          std::tuple("\"texels\":32", "\"texels\":32,\"x\":1", "x")}) {
        const std::string message = refusal_with(from, to);
        EXPECT_TRUE(samples::is_one_line(message)) << message;
        EXPECT_NE(message.find(words), std::string::npos) << to << ": " << message;
    }
}

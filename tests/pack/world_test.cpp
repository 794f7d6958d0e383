// The sections cells and behaviours: written and read. The refusals are in hostile_world_test.cpp.
#include "app/pack/check_parts.h"
#include "app/pack/container/limits.h"
#include "app/pack/curves_part.h"
#include "app/pack/pack_world.h"
#include "app/pack/sign_pack.h"
#include "app/pack/world_sections.h"
#include "tests/folders.h"
#include "tests/pack/world_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <regex>
#include <sstream>

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

ChooseLevels only_level(std::uint32_t level) {
    return [level](const PackOutline&) -> Result<std::vector<std::uint32_t>> { return std::vector{level}; };
}

/// As the manifest alone has it.
PackWorld without_curves(PackWorld world) {
    for (PackBehaviour& packed : world.behaviours) {
        for (world::Channel& channel : packed.behaviour.channels) {
            channel.curve = {};
        }
    }
    return world;
}

/// The bytes of the dump in FORMAT.md's chapter of curves.
Bytes dump_of_curves() {
    std::ifstream page(source_dir() + "/app/pack/FORMAT.md");
    std::stringstream text;
    text << page.rdbuf();
    std::string chapter = text.str();
    chapter = chapter.substr(chapter.find("## Curves"));
    chapter = chapter.substr(0, chapter.find("\n## "));
    Bytes bytes;
    const std::regex row(R"((?:^|\n)[0-9a-f]{4}  ((?:[0-9a-f]{2} ?)+))");
    for (std::sregex_iterator match(chapter.begin(), chapter.end(), row), end; match != end; ++match) {
        std::istringstream numbers((*match)[1].str());
        for (int value = 0; numbers >> std::hex >> value;) {
            bytes.push_back(static_cast<std::byte>(value));
        }
    }
    return bytes;
}

class WorldFile : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove("world.fspack"); }
    static void put(const Bytes& bytes) { ASSERT_TRUE(write_file("world.fspack", bytes)); }
};

} // namespace

TEST_F(WorldFile, round_trip) {
    const Pack pack = samples::pack_with_world();
    const Bytes bytes = samples::bytes_of(pack);
    const Result<VerifiedPack> read = verify_pack(bytes);
    ASSERT_TRUE(read) << read.error().message;
    const Result<void> good = check_world(**read);
    EXPECT_TRUE(good) << good.error().message;
    EXPECT_EQ(world_of(**read).value(), samples::world());
    EXPECT_EQ(world_outline_of(**read).value(), without_curves(samples::world()));
    put(bytes);
    EXPECT_EQ(load_world("world.fspack").value(), samples::world());
}

TEST_F(WorldFile, a_cell_is_read_alone) {
    const Bytes bytes = samples::bytes_of(samples::pack_with_world());
    put(bytes);
    const PackWorld world = load_world("world.fspack").value();
    const Result<VerifiedPack> lid = load_cell("world.fspack", world.cells[2]);
    ASSERT_TRUE(lid) << lid.error().message;
    EXPECT_EQ(write_pack(**lid).value(), write_pack(samples::cell_pack(12)).value());
    const Result<VerifiedPack> coarse = load_cell("world.fspack", world.cells[2], only_level(0));
    ASSERT_TRUE(coarse) << coarse.error().message;
    EXPECT_FALSE((*coarse)->levels[0].indices.empty());
    EXPECT_TRUE((*coarse)->levels[1].indices.empty());
    // An altered cell does not affect the others.
    samples::Entries entries = samples::take_apart(bytes);
    entries.part("cells/0.fspack")[100] ^= std::byte{1};
    put(samples::put_together(entries));
    EXPECT_TRUE(load_cell("world.fspack", world.cells[2]));
    EXPECT_EQ(load_world("world.fspack").value(), samples::world());
    EXPECT_FALSE(load_cell("world.fspack", world.cells[0])) << "its hash is wrong";
}

TEST_F(WorldFile, stores_drawn_at_rest_and_rejects_it_without_geometry) {
    PackWorld world = samples::world();
    world.drawn_at_rest = true;
    Pack pack = samples::full_pack();
    ASSERT_TRUE(put_world(pack, world, samples::cell_packs()));
    put(samples::bytes_of(pack));
    EXPECT_EQ(load_world("world.fspack").value(), world);
    PackWorld empty;
    empty.drawn_at_rest = true;
    Pack other = samples::full_pack();
    const Result<void> refused = put_world(other, empty, {});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("none has geometry"), std::string::npos)
        << refused.error().message;
}

TEST(World, is_empty_and_adds_no_bytes_without_cells) {
    EXPECT_EQ(world_of(samples::full_pack()).value(), PackWorld());
    EXPECT_TRUE(check_world(samples::full_pack()));
    Pack pack = samples::full_pack();
    ASSERT_TRUE(put_world(pack, {}, {}));
    EXPECT_EQ(samples::bytes_of(pack), samples::bytes_of(samples::full_pack())) << "it costs nothing";
}

TEST(World, equal_worlds_give_equal_bytes) {
    const Bytes bytes = samples::bytes_of(samples::pack_with_world());
    EXPECT_EQ(samples::bytes_of(samples::pack_with_world()), bytes);
    // A reader has the sections in the names' order; from then on nothing changes.
    const Bytes again = samples::bytes_of(*verify_pack(bytes).value());
    EXPECT_EQ(samples::bytes_of(*verify_pack(again).value()), again);
    EXPECT_EQ(world_of(*verify_pack(again).value()).value(), samples::world());
}

TEST(World, cells_are_stored_as_packs_of_their_own) {
    const Bytes bytes = samples::bytes_of(samples::pack_with_world());
    const Bytes lid = write_pack(samples::cell_pack(12)).value();
    EXPECT_NE(std::search(bytes.begin(), bytes.end(), lid.begin(), lid.end()), bytes.end())
        << "stored, not packed once more";
    samples::Entries entries = samples::take_apart(bytes);
    EXPECT_EQ(entries.part("cells/2.fspack"), lid);
    EXPECT_EQ(entries.manifest["sections"]["cells"]["parts"],
              nlohmann::json({"cells/0.fspack", "cells/2.fspack"}));
    EXPECT_EQ(entries.manifest["sections"]["behaviours"]["parts"], nlohmann::json({"behaviours/curves.bin"}));
    const auto& hinge = entries.manifest["sections"]["cells"]["data"]["cells"][1];
    EXPECT_EQ(hinge["parent"], 0);
    EXPECT_EQ(hinge["part"], "");
    EXPECT_EQ(hinge["parent_from_base"],
              nlohmann::json({1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.05, 0.4}));
    EXPECT_NEAR(hinge["rotation"][0].get<double>(), std::sin(0.25), 1e-15) << "x, y, z, w";
    EXPECT_NEAR(hinge["rotation"][3].get<double>(), std::cos(0.25), 1e-15);
}

TEST(World, chosen_levels_are_read_without_the_cells) {
    Bytes bytes = samples::bytes_of(samples::pack_with_world());
    // A reader of levels does not look at the cells.
    samples::Entries entries = samples::take_apart(bytes);
    entries.part("cells/2.fspack").assign(entries.part("cells/2.fspack").size(), std::byte{0});
    const Bytes altered = samples::put_together(entries);
    EXPECT_NE(samples::refusal_of(altered), "") << "a reader of all does";
    const Result<VerifiedPack> read = verify_pack(altered, only_level(1));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE((*read)->section_parts.empty());
    PackDescription description = **read;
    EXPECT_EQ(std::erase_if(description.sections,
                            [](const PackSection& section) {
                                return section.name == "cells" || section.name == "behaviours";
                            }),
              2U);
    const Result<VerifiedPack> plain = verify_pack(samples::bytes_of(samples::full_pack()), only_level(1));
    ASSERT_TRUE(plain);
    EXPECT_EQ(description, static_cast<const PackDescription&>(**plain));
    EXPECT_EQ((*read)->levels[1].indices, (*plain)->levels[1].indices);
}

TEST(World, signing_changes_no_byte_of_its_parts) {
    const Bytes bytes = samples::bytes_of(samples::pack_with_world());
    const samples::Entries before = samples::take_apart(bytes);
    const samples::Entries after =
        samples::take_apart(with_signature(bytes, "untrusted comment: a signature\n").value());
    ASSERT_EQ(after.parts.size(), before.parts.size() + 1);
    for (std::size_t k = 0; k < before.parts.size(); ++k) {
        EXPECT_EQ(after.parts[k], before.parts[k]);
    }
    EXPECT_EQ(after.manifest, before.manifest);
}

TEST(World, part_check_detects_an_altered_cell) {
    const Bytes bytes = samples::bytes_of(samples::pack_with_world());
    Result<PackReader> reader = PackReader::open(bytes);
    ASSERT_TRUE(reader);
    EXPECT_TRUE(check_parts(*reader, [](std::uint64_t) {}));
    samples::Entries entries = samples::take_apart(bytes);
    entries.part("cells/2.fspack").back() ^= std::byte{1};
    const Bytes altered = samples::put_together(entries);
    Result<PackReader> wrong = PackReader::open(altered);
    ASSERT_TRUE(wrong);
    EXPECT_FALSE(check_parts(*wrong, [](std::uint64_t) {}));
}

TEST(World, maximum_number_of_cells_fits_the_section) {
    // Seventeen digits and an exponent: no number is longer.
    constexpr double longest = -2.2250738585072014e-308;
    PackCell cell = samples::cells()[2];
    cell.cell.name = std::string(max_line_bytes, 'n');
    cell.cell.parent_from_base = cell.cell.cell_from_geometry = glm::dmat4(longest);
    for (int column = 0; column < 4; ++column) {
        cell.cell.parent_from_base[column] = cell.cell.cell_from_geometry[column] = glm::dvec4(longest);
    }
    cell.cell.rest = {glm::dvec3(longest), glm::dquat(longest, longest, longest, longest),
                      glm::dvec3(longest)};
    cell.low = cell.high = glm::dvec3(longest);
    cell.triangles = std::numeric_limits<std::uint64_t>::max();
    PackWorld most;
    most.cells = std::vector(world::max_cells, cell);
    EXPECT_LT(write_cells(most).size(), max_section_data_bytes * 3 / 4);
    // A chain of as many is read.
    PackWorld chain;
    for (std::size_t k = 0; k < world::max_cells; ++k) {
        PackCell& link = chain.cells.emplace_back();
        link.cell.name = "link " + std::to_string(k);
        link.cell.parent = k == 0 ? std::nullopt : std::optional(k - 1);
        link.cell.rest.translation = {0.0, 0.0, 0.001};
    }
    Pack pack = samples::pack();
    ASSERT_TRUE(put_world(pack, chain, std::vector<Pack>(world::max_cells)));
    EXPECT_EQ(world_of(*verify_pack(samples::bytes_of(pack)).value()).value(), chain);
}

TEST(Curves, encoding_matches_the_format_page) {
    const std::vector<StoredCurve> curves{
        {{world::Interpolation::Linear, {0.0F, 2.0F}, {{0, 0, 0, 1}, {1, 0, 0, 0}}}, 4},
        {{world::Interpolation::Step, {0.5F}, {{1, -1, 0.25F, 0}}}, 3}};
    const Bytes dump = dump_of_curves();
    ASSERT_EQ(dump.size(), 16U + (8 + 2 * 4 + 2 * 16) + (8 + 4 + 12));
    EXPECT_EQ(encode_curves(curves), dump);
    EXPECT_EQ(decode_curves(dump).value(), curves);
}

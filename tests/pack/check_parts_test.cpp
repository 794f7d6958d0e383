// Checking a pack against its manifest in little memory gives the same results as reading all of it, within its
// scope.
#include "app/pack/binary_parts.h"
#include "app/pack/check_parts.h"
#include "tests/base/told.h"
#include "tests/pack/samples.h"

#include <random>

namespace frustumscreen::pack {
namespace {

std::string fault_of(const Bytes& pack, std::uint64_t* passed = nullptr) {
    Result<pack::PackReader> reader = pack::PackReader::open(pack);
    if (!reader) {
        return test::told(reader.error());
    }
    std::uint64_t bytes_passed = 0;
    const Result<void> good = check_parts(*reader, [&](std::uint64_t bytes) { bytes_passed += bytes; });
    if (passed != nullptr) {
        *passed = bytes_passed;
    }
    return good ? "" : test::told(good.error());
}

TEST(CheckParts, takes_every_kind_of_part) {
    for (const Pack& pack : {samples::pack(), samples::full_pack(), samples::pack_with_words()}) {
        const Bytes bytes = samples::bytes_of(pack);
        std::uint64_t passed = 0;
        EXPECT_EQ(fault_of(bytes, &passed), "");
        std::uint64_t all = 0;
        for (const auto& [name, part] : samples::take_apart(bytes).parts) {
            all += part.size();
        }
        EXPECT_EQ(passed, all);
    }
}

TEST(CheckParts, refuses_a_level_whenever_reading_it_does) {
    const samples::Entries good = samples::take_apart(samples::bytes_of(samples::pack()));
    std::mt19937 random(11);
    int refused = 0;
    constexpr int mutants = 3000;
    for (int k = 0; k < mutants; ++k) {
        samples::Entries entries = good;
        Bytes& part = entries.part("levels/0.bin");
        const int bytes = 1 + static_cast<int>(random() % 3);
        for (int byte = 0; byte < bytes; ++byte) {
            part[random() % part.size()] = static_cast<std::byte>(random());
        }
        if (random() % 8 == 0) {
            part.resize(part.size() - random() % 30);
        }
        samples::right_hashes(entries);
        const Bytes pack = samples::put_together(entries);
        const std::string fault = fault_of(pack);
        EXPECT_EQ(fault.empty(), samples::refusal_of(pack).empty()) << fault << samples::refusal_of(pack);
        refused += fault.empty() ? 0 : 1;
    }
    EXPECT_GT(refused, mutants / 4);
    EXPECT_LT(refused, mutants);
}

TEST(CheckParts, scans_a_level_in_pieces_of_any_size) {
    const samples::Entries entries = samples::take_apart(samples::bytes_of(samples::pack()));
    std::mt19937 random(3);
    int levels = 0;
    for (const auto& [name, part] : entries.parts) {
        if (!name.starts_with("levels/")) {
            continue;
        }
        ++levels;
        const bool is_mesh = name == "levels/0.bin";
        const nlohmann::ordered_json& record = entries.manifest["levels"][is_mesh ? 0 : 1];
        for (int k = 0; k < 200; ++k) {
            pack::LevelScan scan(part.size());
            std::span<const std::byte> left(part);
            while (!left.empty()) {
                const std::size_t piece = std::min<std::size_t>(left.size(), random() % 70);
                scan.add(left.first(piece));
                left = left.subspan(piece);
            }
            const LevelTechnique technique = is_mesh ? LevelTechnique::Mesh : LevelTechnique::Relief;
            EXPECT_TRUE(scan.finish(technique, record["triangles"], record["vertices"])) << name;
            EXPECT_FALSE(scan.finish(technique, record["triangles"], 7)) << name;
        }
    }
    EXPECT_EQ(levels, 2);
}

TEST(CheckParts, refuses_oversized_and_invalid_pictures) {
    const samples::Entries good = samples::take_apart(samples::bytes_of(samples::pack()));
    const auto with_texture = [&](const Bytes& picture) {
        samples::Entries entries = good;
        entries.part(good.manifest["textures"][0]) = picture;
        samples::right_hashes(entries);
        return fault_of(samples::put_together(entries));
    };
    EXPECT_EQ(with_texture(image::encode_png(image::Image8(3, 3))), "");
    EXPECT_NE(with_texture(image::encode_png(image::Image8(16385, 1))).find("16385 x 1"), std::string::npos);
    EXPECT_NE(with_texture(samples::some_bytes("no picture")), "");
    // A PNG that only claims to be large: its width is in bytes 16 to 19, the checksum in bytes 29 to 32.
    Bytes png = image::encode_png(image::Image8(3, 3));
    png[16] = std::byte{0x7f};
    EXPECT_NE(with_texture(png), "");
}

} // namespace
} // namespace frustumscreen::pack

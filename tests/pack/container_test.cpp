// The container is an ordinary ZIP, and the dump in FORMAT.md is a real one.
#include "app/pack/binary_parts.h"
#include "tests/folders.h"
#include "tests/pack/samples.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

/// The bytes of the dump between the fence lines that follow `heading` in FORMAT.md: an offset, then
/// hexadecimal pairs.
Bytes dump_in_format_page(const std::string& heading) {
    std::ifstream page(source_dir() + "/app/pack/FORMAT.md");
    std::string line;
    while (std::getline(page, line) && line.find(heading) == std::string::npos) {
    }
    while (std::getline(page, line) && line.rfind("```", 0) != 0) {
    }
    Bytes bytes;
    while (std::getline(page, line) && line.rfind("```", 0) != 0) {
        std::istringstream words(line.substr(0, line.find('|')));
        std::string word;
        words >> word; // the offset
        while (words >> word) {
            bytes.push_back(static_cast<std::byte>(std::stoul(word, nullptr, 16)));
        }
    }
    return bytes;
}

std::uint32_t number_at(const Bytes& bytes, std::size_t offset, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < count; ++k) {
        value |= std::to_integer<std::uint32_t>(bytes.at(offset + k)) << (8 * k);
    }
    return value;
}

} // namespace

TEST(Container, level_matches_the_dump_in_the_format_page) {
    PackLevel level;
    level.vertices = {
        {{0, 0, 0}, 0, {0, 0}}, {{65535, 0, 0}, 0, {65535, 0}}, {{0, 32768, 65535}, 0, {256, 65535}}};
    level.indices = {0, 1, 2};
    level.clusters = {{0, 3, {0.0F, 0.0F, 0.5F}, 1.0F, {0.0F, 0.0F, -0.5F}, {0.0F, 0.0F, 1.0F}, 2.0F}};
    const Bytes dump = dump_in_format_page("One triangle");
    ASSERT_FALSE(dump.empty());
    EXPECT_EQ(pack::encode_level(level, {}, glm::dvec3(1.0)).value(), dump);
    const Result<PackLevel> back = pack::decode_level(dump, {}, glm::dvec3(1.0));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->indices, level.indices);
    EXPECT_EQ(back->vertices[2].uv, level.vertices[2].uv);
}

TEST(Container, the_manifest_is_the_first_thing_in_the_file) {
    const Bytes bytes = samples::bytes_of(samples::pack());
    EXPECT_EQ(number_at(bytes, 0, 4), 0x04034b50U); // APPNOTE.TXT 4.3.7, local file header
    EXPECT_EQ(number_at(bytes, 26, 2), 13U);
    EXPECT_EQ(as_text(bytes).substr(30, 13), "manifest.json");
}

TEST(Container, dates_are_fixed) {
    const Bytes bytes = samples::bytes_of(samples::pack());
    EXPECT_EQ(number_at(bytes, 10, 2), 0U);      // 0:00
    EXPECT_EQ(number_at(bytes, 12, 2), 0x0021U); // 1980-01-01
}

TEST(Container, an_entry_listed_twice_is_refused) {
    samples::Entries entries = samples::take_apart(samples::bytes_of(samples::pack()));
    entries.parts.push_back(entries.parts.front());
    const std::string message = samples::refusal_of(samples::put_together(entries));
    EXPECT_NE(message.find("[zip.entry_twice]"), std::string::npos) << message;
}

TEST(Container, an_entry_that_is_not_listed_is_refused) {
    samples::Entries entries = samples::take_apart(samples::bytes_of(samples::pack()));
    entries.parts.push_back({"autorun.sh", Bytes(3)});
    const std::string message = samples::refusal_of(samples::put_together(entries));
    EXPECT_NE(message.find("autorun.sh is not listed"), std::string::npos) << message;
}

TEST(Container, accepts_a_signature_of_limited_size) {
    samples::Entries entries = samples::take_apart(samples::bytes_of(samples::pack()));
    entries.parts.push_back({"signature", Bytes(64)});
    EXPECT_EQ(samples::refusal_of(samples::put_together(entries)), "");
    entries.parts.back().second.resize(100000);
    EXPECT_NE(samples::refusal_of(samples::put_together(entries)).find("signature"), std::string::npos);
}

TEST(Container, entry_that_claims_too_many_bytes_is_refused) {
    Bytes bytes = samples::bytes_of(samples::pack());
    // The manifest's unpacked size in the directory, which the end record points at
    // (APPNOTE.TXT 4.3.12, 4.3.16).
    const std::size_t directory = number_at(bytes, bytes.size() - 6, 4);
    ASSERT_EQ(number_at(bytes, directory, 4), 0x02014b50U);
    for (std::size_t k = 0; k < 4; ++k) {
        bytes.at(directory + 24 + k) = static_cast<std::byte>(k == 3 ? 0x7F : 0xFF);
    }
    const std::string message = samples::refusal_of(bytes);
    EXPECT_NE(message.find("manifest.json claims 2147483647 bytes"), std::string::npos) << message;
}

TEST(Container, python_opens_it) {
    if (std::system("python3 -c 'import zipfile' > /dev/null 2>&1") != 0) {
        GTEST_SKIP() << "there is no python3 here to open the container with";
    }
    ASSERT_TRUE(write_file("container.fspack", samples::bytes_of(samples::pack())));
    EXPECT_EQ(std::system("python3 -m zipfile -t container.fspack > container.txt && "
                          "python3 -m zipfile -l container.fspack | grep -q levels/1.bin"),
              0);
    std::remove("container.fspack");
    std::remove("container.txt");
}

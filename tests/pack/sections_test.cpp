// Sections of a pack: read, skipped, altered, and read alone.
#include "app/pack/pack_contents.h"
#include "app/pack/pack_sections.h"
#include "tests/base/told.h"
#include "tests/pack/samples.h"

#include <filesystem>
#include <functional>

using namespace frustumscreen;
using namespace frustumscreen::pack;
using Json = nlohmann::ordered_json;

namespace {

std::string refusal_with(const std::function<void(Json&)>& change) {
    samples::Entries entries = samples::take_apart(samples::bytes_of(samples::full_pack()));
    change(entries.manifest);
    return samples::refusal_of(samples::put_together(entries));
}

void expect_refused(const char* words, const std::function<void(Json&)>& change) {
    const std::string message = refusal_with(change);
    EXPECT_TRUE(samples::is_one_line(message)) << words << ": " << message;
    EXPECT_NE(message.find(words), std::string::npos) << words << ": " << message;
}

std::string refusal_to_write(const std::function<void(Pack&)>& change) {
    Pack pack = samples::full_pack();
    change(pack);
    const Result<Bytes> bytes = write_pack(pack);
    return bytes ? std::string() : test::told(bytes.error());
}

/// The full sample as a file; one byte of the part `altered_part` is changed if it is named.
class PackFile : public testing::Test {
protected:
    void write(const std::string& altered_part = {}) {
        Bytes bytes = samples::bytes_of(samples::full_pack());
        if (!altered_part.empty()) {
            const Bytes part = samples::take_apart(bytes).part(altered_part);
            const auto there = std::search(bytes.begin(), bytes.end(), part.begin(), part.end());
            ASSERT_NE(there, bytes.end()) << "a section's parts are stored as they are";
            *there ^= std::byte{1};
        }
        ASSERT_TRUE(write_file(file, bytes));
    }
    void TearDown() override { std::filesystem::remove(file); }
    const std::filesystem::path file = "sections.fspack";
};

ChooseParts only(std::vector<std::string> names) {
    return [names = std::move(names)](const PackDescription&) -> Result<std::vector<std::string>> {
        return names;
    };
}

} // namespace

TEST(Sections, manifest_has_the_sections_of_the_format_page) {
    const Json sections = samples::take_apart(samples::bytes_of(samples::full_pack())).manifest["sections"];
    std::vector<std::string> names;
    for (const auto& [name, section] : sections.items()) {
        names.push_back(name);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"details", "glyphs", "hotspots", "identity", "sounds",
                                               "table_picture"}));
    EXPECT_EQ(sections["identity"].dump(), R"({"parts":[],"data":{"id":"museum-1234.a"}})");
    EXPECT_EQ(
        sections["hotspots"]["data"]["hotspots"][1].dump(),
        R"({"labels":[{"language":"en","text":"The foot"}],"normal":[-1.0,0.0,0.0],"point":[-0.5,0.0,0.0]})");
    EXPECT_EQ(sections["details"]["data"]["captions"][1]["place"], "Atenas");
    EXPECT_EQ(sections["table_picture"]["data"], Json::object());
    EXPECT_FALSE(samples::take_apart(samples::bytes_of(samples::pack())).manifest.contains("sections"))
        << "a pack without any has none";
}

TEST(Sections, unknown_section_is_kept_and_its_parts_are_checked) {
    samples::Entries entries = samples::take_apart(samples::bytes_of(samples::pack()));
    entries.parts.push_back({"relief_blocks/0.bin", samples::some_bytes("to come")});
    entries.manifest["parts"].push_back({{"name", "relief_blocks/0.bin"}, {"bytes", 0}, {"sha256", ""}});
    entries.manifest["sections"]["relief_blocks"] = {{"parts", {"relief_blocks/0.bin"}},
                                                     {"data", {{"anything", {1, nullptr, "x"}}}}};
    samples::right_hashes(entries);
    const Result<VerifiedPack> read = verify_pack(samples::put_together(entries));
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ((*read)->sections.size(), 1U);
    EXPECT_EQ((*read)->sections[0].data, R"({"anything":[1,null,"x"]})");
    EXPECT_EQ(as_text((*read)->section_parts.at("relief_blocks/0.bin")), "to come");
    entries.parts.back().second[0] ^= std::byte{1};
    EXPECT_NE(samples::refusal_of(samples::put_together(entries)).find("does not match its hash"),
              std::string::npos);
}

TEST(Sections, reader_of_chosen_levels_skips_section_parts) {
    samples::Entries entries = samples::take_apart(samples::bytes_of(samples::full_pack()));
    for (const char* name : {"sounds/en/0.opus", "glyphs/runs.bin", "table_picture.png"}) {
        entries.part(name)[0] ^= std::byte{1}; // the container's checksum is valid, the hash is not
    }
    const Bytes bytes = samples::put_together(entries);
    const Result<VerifiedPack> read = verify_pack(bytes, [](const PackOutline& outline) {
        EXPECT_EQ(outline.description.sections.size(), 2U);
        EXPECT_EQ(outline.description.hotspots.size(), 2U);
        return Result<std::vector<std::uint32_t>>(std::vector<std::uint32_t>{0});
    });
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE((*read)->section_parts.empty());
    EXPECT_TRUE((*read)->table_picture.texels.empty());
    EXPECT_TRUE(static_cast<const PackDescription&>(**read) == samples::full_pack());
    EXPECT_FALSE(verify_pack(bytes));
}

TEST(Sections, invalid_known_sections_are_refused) {
    expect_refused("sections.identity.data.colour",
                   [](Json& m) { m["sections"]["identity"]["data"]["colour"] = 1; });
    expect_refused("sections.identity.data.id is missing",
                   [](Json& m) { m["sections"]["identity"]["data"] = Json::object(); });
    expect_refused("the id is '../a'", [](Json& m) { m["sections"]["identity"]["data"]["id"] = "../a"; });
    expect_refused("sections.identity.parts has 1; allowed is 0", [](Json& m) {
        m["sections"]["identity"]["parts"] = {"sounds/en/0.opus"};
        m["sections"].erase("sounds");
    });
    expect_refused("sections.table_picture.parts has 0; allowed is 1",
                   [](Json& m) { m["sections"]["table_picture"]["parts"] = Json::array(); });
    expect_refused("table_picture.png", [](Json& m) { m["sections"].erase("table_picture"); });
    expect_refused("glyphs/runs.bin", [](Json& m) { // not a picture
        m["sections"]["table_picture"]["parts"] = {"glyphs/runs.bin"};
        m["sections"]["glyphs"]["parts"] = {"glyphs/atlas.png", "table_picture.png"};
    });
    expect_refused("has the language 'fr'",
                   [](Json& m) { m["sections"]["details"]["data"]["captions"][0]["language"] = "fr"; });
    expect_refused("has the language 'en'",
                   [](Json& m) { m["sections"]["details"]["data"]["captions"][1]["language"] = "en"; });
    expect_refused("caption 0's maker has the control character U+001B",
                   [](Json& m) { m["sections"]["details"]["data"]["captions"][0]["maker"] = "\x1b[2J"; });
}

TEST(Sections, invalid_hotspots_are_refused) {
    const auto hotspot = [](Json& m) -> Json& { return m["sections"]["hotspots"]["data"]["hotspots"][0]; };
    expect_refused("hotspot 0 lies at", [&](Json& m) { hotspot(m)["point"] = {0.6, 0.0, 0.0}; });
    expect_refused("hotspot 0 lies at", [&](Json& m) { hotspot(m)["point"] = {0.0, 0.0, -0.1}; });
    expect_refused("allowed is a list of 3", [&](Json& m) { hotspot(m)["point"] = {0.0, nullptr, 0.0}; });
    expect_refused("allowed is a list of 3", [&](Json& m) { hotspot(m)["point"] = {0.0, 0.0}; });
    expect_refused("normal", [&](Json& m) { hotspot(m)["normal"] = {0.0, 0.0, 0.0}; });
    expect_refused("normal", [&](Json& m) { hotspot(m)["normal"] = {1e300, 1e300, 0.0}; });
    expect_refused("two labels in en", [&](Json& m) { hotspot(m)["labels"][1]["language"] = "en"; });
    expect_refused("language is '-'", [&](Json& m) { hotspot(m)["labels"][1]["language"] = "-"; });
    expect_refused("1001 bytes", [&](Json& m) { hotspot(m)["labels"][0]["text"] = std::string(1001, 'x'); });
    expect_refused("at most 3", [&](Json& m) {
        Json& list = m["sections"]["hotspots"]["data"]["hotspots"];
        list.push_back(list[0]);
        list.push_back(list[0]);
    });
}

TEST(Sections, names_counts_sizes_and_depth_are_limited) {
    expect_refused("a section is called 'Texts'", [](Json& m) {
        m["sections"]["Texts"] = {{"parts", Json::array()}, {"data", Json::object()}};
    });
    expect_refused("sections.texts.colour", [](Json& m) {
        m["sections"]["texts"] = {{"parts", Json::array()}, {"data", Json::object()}, {"colour", 1}};
    });
    expect_refused("allowed is an object", [](Json& m) {
        m["sections"]["texts"] = {{"parts", Json::array()}, {"data", 5}};
    });
    expect_refused("at most 64", [](Json& m) {
        for (int k = 0; k < 64; ++k) {
            m["sections"]["s" + std::to_string(k)] = {{"parts", Json::array()}, {"data", Json::object()}};
        }
    });
    expect_refused("bytes of data in all", [](Json& m) {
        m["sections"]["sounds"]["data"] = {{"large", std::string(1 << 20, 'x')}};
    });
    expect_refused("more than 524288 values", [](Json& m) {
        m["sections"]["sounds"]["data"] = {{"many", std::vector<int>(1 << 19)}};
    });
    expect_refused("an object of more than 4096 names", [](Json& m) {
        for (int k = 0; k <= 4096; ++k) {
            m["sections"]["sounds"]["data"]["x" + std::to_string(k)] = 0;
        }
    });
    expect_refused("twice", [](Json& m) { m["sections"]["sounds"]["parts"].push_back("sounds/en/0.opus"); });
    expect_refused("twice", [](Json& m) { m["sections"]["sounds"]["parts"].push_back("levels/0.bin"); });
    expect_refused("[pack.part_not_in_manifest]",
                   [](Json& m) { m["sections"]["sounds"]["parts"].push_back("sounds/x"); });
    expect_refused("[pack.part_unused]", [](Json& m) { m["sections"].erase("sounds"); });
    const auto nested = [](int depth) {
        return [depth](Json& m) {
            Json data = Json::object();
            for (int k = 1; k < depth; ++k) {
                data = Json{{"in", data}};
            }
            m["sections"]["texts"] = {{"parts", Json::array()}, {"data", data}};
        };
    };
    EXPECT_EQ(refusal_with(nested(29)), "");
    expect_refused("more than 32 objects", nested(30));
}

TEST(Sections, the_writer_refuses_what_the_reader_would) {
    EXPECT_EQ(refusal_to_write([](Pack&) {}), "");
    const auto refused = [](const char* words, const std::function<void(Pack&)>& change) {
        const std::string message = refusal_to_write(change);
        EXPECT_NE(message.find(words), std::string::npos) << words << ": " << message;
    };
    refused("'identity'", [](Pack& p) { p.sections[0].name = "identity"; });
    refused("'sounds'", [](Pack& p) { p.sections[0].name = "sounds"; });
    refused("[sections.data]", [](Pack& p) { p.sections[0].data = "[]"; });
    refused("[sections.data]", [](Pack& p) { p.sections[0].data = R"({"a":1,"a":2})"; });
    refused("[sections.too_large]",
            [](Pack& p) { p.sections[0].data = '"' + std::string(1 << 20, 'x') + '"'; });
    refused("[pack.section_part]", [](Pack& p) { p.section_parts.clear(); });
    refused("[pack.parts_of_one_name]", [](Pack& p) {
        p.sections[0].parts = {"levels/0.bin"};
        p.section_parts["levels/0.bin"] = samples::some_bytes("x");
    });
    refused("0 bytes", [](Pack& p) { p.section_parts["glyphs/runs.bin"].clear(); });
    refused("1025 x 1", [](Pack& p) { p.table_picture = image::Image8(1025, 1); });
}

TEST_F(PackFile, card_has_id_titles_languages_and_picture) {
    write();
    const Result<PackCard> card = load_pack_card(file);
    ASSERT_TRUE(card) << card.error().message;
    const Pack pack = samples::full_pack();
    EXPECT_EQ(card->id, pack.id);
    EXPECT_EQ(card->title, pack.title);
    EXPECT_EQ(card->languages, pack.languages);
    EXPECT_EQ(card->titles, (std::vector<PackLabel>{{"en", "Amphora"}, {"pt-BR", "\xC3\x82nfora"}}));
    EXPECT_EQ(card->table_picture.texels, pack.table_picture.texels);
}

TEST_F(PackFile, a_card_does_not_depend_on_levels_and_sounds) {
    for (const char* name : {"sounds/en/0.opus", "textures/0.png"}) {
        write(name);
        EXPECT_FALSE(load_pack(file)) << name;
        EXPECT_TRUE(load_pack_card(file)) << name;
    }
    write("table_picture.png");
    const Result<PackCard> card = load_pack_card(file);
    ASSERT_FALSE(card);
    EXPECT_EQ(card.error().message, "sections.fspack: table_picture.png is damaged; copy the pack again");
}

TEST_F(PackFile, card_of_a_pack_without_picture_is_empty) {
    ASSERT_TRUE(write_file(file, samples::bytes_of(samples::pack())));
    const Result<PackCard> card = load_pack_card(file);
    ASSERT_TRUE(card) << card.error().message;
    EXPECT_TRUE(card->table_picture.texels.empty());
    EXPECT_TRUE(card->id.empty());
}

TEST_F(PackFile, a_part_is_read_without_the_others) {
    write("sounds/pt-br/0.opus");
    const auto english = load_section_parts(file, [](const PackDescription& pack) {
        return Result<std::vector<std::string>>(std::vector{pack.sections[1].parts[0]});
    });
    ASSERT_TRUE(english) << english.error().message;
    ASSERT_EQ(english->size(), 1U);
    EXPECT_EQ(as_text(english->at("sounds/en/0.opus")), "OggS english");
    EXPECT_FALSE(load_section_parts(file, only({"sounds/pt-br/0.opus"}))) << "its hash is wrong";
    const auto level = load_section_parts(file, only({"levels/0.bin"}));
    ASSERT_FALSE(level);
    EXPECT_EQ(level.error().message, "sections.fspack: no section has the part 'levels/0.bin'");
    EXPECT_FALSE(load_section_parts("nowhere.fspack", only({})));
}

TEST_F(PackFile, file_and_bytes_give_the_same_result) {
    write();
    const Bytes bytes = samples::bytes_of(samples::full_pack());
    for (std::size_t size = 0; size <= bytes.size(); size += size < 100 ? 7 : 211) {
        ASSERT_TRUE(write_file(file, std::span(bytes).first(size)));
        const Result<VerifiedPack> read = load_pack(file);
        ASSERT_FALSE(read);
        EXPECT_EQ(test::told(read.error()),
                  "sections.fspack: " +
                      samples::refusal_of(Bytes(bytes.begin(), bytes.begin() + std::ptrdiff_t(size))));
        EXPECT_FALSE(load_pack_card(file));
    }
    write();
    const Result<VerifiedPack> read = load_pack(file);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(samples::bytes_of(**read), bytes);
}

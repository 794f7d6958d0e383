// The sections `texts` and `sounds`: written, read for one language alone, and refused.
#include "app/pack/pack_sections.h"
#include "app/pack/pack_texts.h"
#include "tests/base/told.h"
#include "tests/pack/samples.h"

#include <filesystem>
#include <functional>

using namespace frustumscreen;
using namespace frustumscreen::pack;
using Json = nlohmann::ordered_json;

namespace {

class PackTexts : public testing::Test {
protected:
    void write(const Pack& pack) { ASSERT_TRUE(write_file(file, samples::bytes_of(pack))); }
    /// Writes a pack with one byte of a part changed, so that the part does not match its hash.
    void write_with_damage(const std::string& damaged_part) {
        Bytes bytes = samples::bytes_of(samples::pack_with_words());
        samples::Entries entries = samples::take_apart(bytes);
        entries.part(damaged_part)[0] ^= std::byte{1};
        ASSERT_TRUE(write_file(file, samples::put_together(entries)));
    }
    void TearDown() override { std::filesystem::remove(file); }
    [[nodiscard]] Result<std::vector<SetLanguage>> load(std::vector<std::string> languages) const {
        return load_set_texts(file, languages);
    }
    const std::filesystem::path file = "words_of_pack.fspack";
};

std::string fault_with(const std::function<void(Pack&)>& change) {
    Pack pack = samples::pack_with_words();
    change(pack);
    const Result<void> checked = check_set_and_spoken(pack);
    return checked ? std::string() : test::told(checked.error());
}

void expect_fault(const char* words, const std::function<void(Pack&)>& change) {
    const std::string message = fault_with(change);
    EXPECT_TRUE(samples::is_one_line(message)) << words << ": " << message;
    EXPECT_NE(message.find(words), std::string::npos) << words << ": " << message;
}

/// Changes the data of section number `index`: sounds are first, then texts.
std::function<void(Pack&)> data(std::size_t index, const std::function<void(Json&)>& change) {
    return [=](Pack& pack) {
        Json json = Json::parse(pack.sections.at(index).data);
        change(json);
        pack.sections[index].data = json.dump();
    };
}

} // namespace

TEST_F(PackTexts, manifest_matches_the_format_page) {
    const samples::Entries entries = samples::take_apart(samples::bytes_of(samples::pack_with_words()));
    EXPECT_EQ(entries.manifest["sections"]["texts"].dump(),
              R"({"parts":["texts/en/glyphs.bin","texts/en/atlas.webp","texts/pt-br/glyphs.bin",)"
              R"("texts/pt-br/atlas.webp","texts/fr/glyphs.bin"],"data":{"languages":[)"
              R"({"atlas":"texts/en/atlas.webp","glyphs":"texts/en/glyphs.bin","language":"en"},)"
              R"({"atlas":"texts/pt-br/atlas.webp","glyphs":"texts/pt-br/glyphs.bin","language":"pt-BR"},)"
              R"({"atlas":"","glyphs":"texts/fr/glyphs.bin","language":"fr"}]}})");
    EXPECT_EQ(entries.manifest["sections"]["sounds"].dump(),
              R"({"parts":["sounds/en/description.opus"],"data":{"languages":[{"language":"en","sounds":)"
              R"([{"key":"description","part":"sounds/en/description.opus"}]}]}})");
}

TEST_F(PackTexts, round_trip) {
    write(samples::pack_with_words());
    const Result<std::vector<SetLanguage>> read = load({"pt-BR", "fr", "it"});
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->size(), 2U);
    const SetLanguage portuguese = samples::set_language("pt-BR", TextDirection::RightToLeft);
    EXPECT_EQ((*read)[0].language, "pt-BR");
    EXPECT_EQ((*read)[0].runs, portuguese.runs);
    EXPECT_EQ((*read)[0].atlas.texels, portuguese.atlas.texels);
    EXPECT_EQ((*read)[1].language, "fr");
    EXPECT_TRUE((*read)[1].atlas.texels.empty());
    EXPECT_EQ(fault_with([](Pack&) {}), "");
}

TEST_F(PackTexts, each_language_is_read_alone) {
    write_with_damage("texts/en/glyphs.bin");
    EXPECT_TRUE(load({"pt-BR"}));
    const Result<std::vector<SetLanguage>> damaged = load({"en"});
    ASSERT_FALSE(damaged);
    EXPECT_TRUE(damaged.error().message.starts_with("words_of_pack.fspack: ")) << damaged.error().message;
    EXPECT_NE(damaged.error().message.find("texts/en/glyphs.bin does not match its hash"), std::string::npos)
        << damaged.error().message;
}

TEST_F(PackTexts, pack_without_texts_and_sounds_is_valid) {
    write(samples::pack());
    const Result<std::vector<SetLanguage>> none = load({"en"});
    ASSERT_TRUE(none) << none.error().message;
    EXPECT_TRUE(none->empty());
    const Result<Bytes> silent = load_sound(file, "en", "description");
    ASSERT_TRUE(silent) << silent.error().message;
    EXPECT_TRUE(silent->empty());
    EXPECT_TRUE(list_sounds(samples::pack())->empty());
    EXPECT_TRUE(check_set_and_spoken(samples::pack()));
}

TEST_F(PackTexts, each_sound_is_read_alone) {
    write_with_damage("texts/en/glyphs.bin"); // not read here
    const Result<Bytes> sound = load_sound(file, "en", "description");
    ASSERT_TRUE(sound) << sound.error().message;
    EXPECT_EQ(as_text(*sound), "OggS english");
    EXPECT_TRUE(load_sound(file, "en", "title")->empty());
    EXPECT_TRUE(load_sound(file, "fr", "description")->empty());
    EXPECT_EQ(*list_sounds(samples::pack_with_words()), (std::vector<SpokenText>{{"en", "description"}}));
}

TEST_F(PackTexts, sound_that_is_not_ogg_is_refused) {
    Pack pack = samples::pack();
    put_sounds(pack, std::vector<SpokenLanguage>{{"en", {{"description", samples::some_bytes("RIFF")}}}});
    write(pack);
    EXPECT_FALSE(load_sound(file, "en", "description"));
    EXPECT_FALSE(check_set_and_spoken(pack));
}

TEST_F(PackTexts, invalid_section_data_is_refused) {
    constexpr std::size_t sounds = 0;
    constexpr std::size_t texts = 1;
    expect_fault("sections.texts.data.size", data(texts, [](Json& d) { d["size"] = 1; }));
    expect_fault("sections.texts.data.languages[0].atlas is missing",
                 data(texts, [](Json& d) { d["languages"][0].erase("atlas"); }));
    expect_fault("the section texts names the language 'en' twice",
                 data(texts, [](Json& d) { d["languages"][1]["language"] = "en"; }));
    expect_fault("the section texts does not name exactly its own parts",
                 data(texts, [](Json& d) { d["languages"][1]["glyphs"] = "levels/0.bin"; }));
    expect_fault("the section texts does not name exactly its own parts",
                 data(texts, [](Json& d) { d["languages"].erase(0); }));
    expect_fault("the section texts does not name exactly its own parts",
                 data(texts, [](Json& d) { d["languages"][1]["glyphs"] = "texts/en/glyphs.bin"; }));
    expect_fault("texts/en/atlas.webp: there is a picture of glyphs", [&](Pack& pack) {
        data(texts, [](Json& d) {
            d["languages"][2]["atlas"] = d["languages"][0]["atlas"];
            d["languages"][0]["atlas"] = "";
        })(pack);
        pack.section_parts["texts/en/glyphs.bin"] = pack.section_parts["texts/fr/glyphs.bin"];
    });
    expect_fault("texts/en/glyphs.bin",
                 [](Pack& pack) { pack.section_parts["texts/en/glyphs.bin"].resize(30); });
    expect_fault("whose key is not valid",
                 data(sounds, [](Json& d) { d["languages"][0]["sounds"][0]["key"] = "A key"; }));
    expect_fault("the section sounds does not name exactly its own parts",
                 data(sounds, [](Json& d) { d["languages"][0]["sounds"] = Json::array(); }));
}

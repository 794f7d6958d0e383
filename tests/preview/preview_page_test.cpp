// The page beside a pack: Python's own parser, hashes and base64 look at it, with texts that need every escape.
#include "app/programs/preview/html_parts.h"
#include "app/programs/preview/preview_page.h"
#include "tests/folders.h"
#include "tests/programs/program_folder.h"

#include <webp/decode.h>

#include <array>

namespace frustumscreen::programs {
namespace {

constexpr const char* hostile = "</title><script>alert(\"1\")</script><img src=http://x/y onerror=z> & 'so'";

class PreviewPage : public ProgramFolder {
protected:
    void SetUp() override {
        pack.title = hostile;
        pack.id = "jug";
        pack.languages = {"en", "ar"};
        pack::PackCaption english;
        english.language = "en";
        english.title = hostile;
        english.text = std::string("first line\n") + hostile;
        english.maker = english.credit = english.place = english.period = english.description = hostile;
        pack::PackCaption arabic;
        arabic.language = "ar";
        arabic.title = "جرة";
        pack.captions = {english, arabic};
        pack.provenance = {hostile, std::string(64, 'a'), hostile, 12};
        pack.hotspots = {{{}, {0, 0, 1}, {{"en", hostile}}}};
        facts.pack_name = hostile;
        facts.stands = facts.program = hostile;
        facts.levels = {{12, 3456, 0.1234, 0.2, 0.3, 4.5}, {7, 100, 0.01, 0.02, 0.03, 1.0}};
        facts.lost = facts.silent = facts.guessed = {hostile};
        media.turn.columns = 2;
        media.turn.rows = 2;
        media.turn.frames = 4;
        media.turn.size = {16, 8};
        media.turn.sheet = image::Image8(32, 16, {90, 60, 30, 255});
        media.turn.marks = {std::vector<MarkPlace>(4, {0.25, 0.5, true})};
        media.table_picture = image::Image8(4, 4, {1, 2, 3, 255});
        const ProjectedText text{
            hostile, image::encode_webp(image::Image8(5, 3, {255, 255, 255, 255})), {5, 3}};
        Bytes sound(40);
        std::copy_n(as_bytes("OggS").begin(), 4, sound.begin());
        std::copy_n(as_bytes("OpusHead").begin(), 8, sound.begin() + 28);
        media.languages.resize(2);
        media.languages[0].caption = english;
        media.languages[0].title = text;
        media.languages[0].portions = {text, text};
        media.languages[0].labels = {text};
        media.languages[0].sound = sound;
        media.languages[1].caption = arabic;
        BehaviourPictures moves;
        moves.behaviour.behaviour.name = hostile;
        moves.behaviour.behaviour.seconds = 2.0;
        moves.behaviour.behaviour.trigger = world::Trigger::Hotspot;
        moves.behaviour.titles = {{"en", hostile}, {"ar", "أدر الغطاء"}};
        moves.frames = 2;
        moves.step_s = 2.0;
        moves.size = {8, 4};
        moves.sheet = image::Image8(16, 4, {9, 8, 7, 255});
        media.behaviours = {moves};
        media.languages[1].labels = {text};
        TorchPictures torch;
        torch.content.content.name = hostile;
        torch.content.titles = {{"en", hostile}};
        torch.shows = hostile;
        torch.frames = 2;
        torch.size = {8, 4};
        torch.plain = torch.lit = image::Image8(16, 4, {9, 90, 7, 255});
        torch.picture = image::Image8(8, 8, {1, 2, 3, 255});
        media.torches = {torch};
        StatePicture found;
        found.state.name = hostile;
        found.state.titles = {{"en", hostile}};
        found.picture = image::Image8(8, 4, {9, 9, 70, 255});
        media.states = {found};
    }
    [[nodiscard]] int check(const std::string& page, const std::string& options) const {
        put("page.html", page);
        return std::system(fmt::format("'{}/tests/preview/check_page.py' '{}/page.html' {}", source_dir(),
                                       folder.string(), options)
                               .c_str());
    }

    pack::PackDescription pack;
    PreviewFacts facts;
    PreviewMedia media;
};

TEST_F(PreviewPage, ContainsEveryTextAndLoadsNothing) {
    const std::string page = preview_page(pack, facts, media);
    EXPECT_EQ(check(page,
                    "--pictures 12 --sounds 1 --text 'alert(\"1\")</script><img src=http://x/y onerror=z>' "
                    "--text 'first line' --text 'جرة' --text 0.123 --text 'أدر الغطاء' --text 'place 1 is "
                    "turned to the visitor' --text 'could not set this text'"),
              0);
    EXPECT_NE(check(page, "--text 'words that nobody wrote' 2>/dev/null"), 0) << "the check itself";
    EXPECT_NE(check(std::string(page).replace(page.find("<h1"), 0, "<script>1</script>"), "2>/dev/null"), 0);
    EXPECT_NE(check(std::string(page).replace(page.find("<h1"), 0, "<img src=x.png>"), "2>/dev/null"), 0);
}

TEST_F(PreviewPage, DropsReloadingFromThePage) {
    const std::string page = preview_page(pack, facts, media, PageKind::Reloading);
    EXPECT_EQ(check(page, "--reloads"), 0);
    EXPECT_EQ(check(without_reloading(page), ""), 0);
    EXPECT_EQ(without_reloading(preview_page(pack, facts, media)), preview_page(pack, facts, media));
}

TEST_F(PreviewPage, WritesAPageForAPackWithoutTexts) {
    pack::PackDescription bare;
    bare.title = "Jug";
    media.turn.marks.clear();
    media.languages.clear();
    media.behaviours.clear();
    media.torches.clear();
    media.states.clear();
    media.table_picture = image::Image8();
    EXPECT_EQ(check(preview_page(bare, {}, media), "--pictures 1 --sounds 0 --text 'Nothing of the scan'"),
              0);
}

TEST(TorchPictures, BlendTheLayerLikeTheTorch) {
    const image::Image8 texture(1, 2, {188, 0, 255, 100}); // 0.5, 0 and 1 in linear light
    image::Image8 layer(1, 2, {0, 188, 255, 255});
    layer.at(0, 1).w = 0;
    torch::Stage stage;
    const image::Image8 over = with_layer(texture, layer, stage, torch::Blend::Over);
    EXPECT_EQ(over.at(0, 0), glm::u8vec4(0, 188, 255, 100)) << "the layer's colour, the texture's holes";
    EXPECT_EQ(over.at(0, 1), texture.at(0, 1)) << "where the layer is transparent";
    const image::Image8 light = with_layer(texture, layer, stage, torch::Blend::Light);
    EXPECT_EQ(light.at(0, 0), glm::u8vec4(188, 0, 255, 100)) << "0.5 + 0.5 x 0, 0 + 0, clipped at 1";
    stage.opacity = 0.5;
    EXPECT_EQ(with_layer(texture, layer, stage, torch::Blend::Over).at(0, 0).y, 137)
        << "0.25 in linear light";
}

/// RFC 4648, section 10.
TEST(Base64, MatchesTheTestVectorsOfRfc4648) {
    constexpr std::array<std::pair<const char*, const char*>, 7> vectors{{{"", ""},
                                                                          {"f", "Zg=="},
                                                                          {"fo", "Zm8="},
                                                                          {"foo", "Zm9v"},
                                                                          {"foob", "Zm9vYg=="},
                                                                          {"fooba", "Zm9vYmE="},
                                                                          {"foobar", "Zm9vYmFy"}}};
    for (const auto& [plain, encoded] : vectors) {
        EXPECT_EQ(base64(as_bytes(plain)), encoded);
    }
    const std::array<std::byte, 3> high{std::byte{0xfb}, std::byte{0xef}, std::byte{0xff}};
    EXPECT_EQ(base64(high), "++//");
}

TEST(LossyWebp, StaysCloseToThePicture) {
    image::Image8 picture(64, 48);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            picture.at(x, y) = {40 + 2 * x, 60 + 2 * y, 100, 255};
        }
    }
    const Bytes bytes = image::encode_lossy_webp(picture, 82.0F);
    int width = 0;
    int height = 0;
    std::uint8_t* const texels =
        WebPDecodeRGBA(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), &width, &height);
    ASSERT_NE(texels, nullptr);
    EXPECT_EQ(width, 64);
    EXPECT_EQ(height, 48);
    for (const auto& [x, y] : {std::pair(5, 5), {32, 24}, {60, 40}}) {
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(texels[4 * (y * width + x) + channel], picture.at(x, y)[channel], 10)
                << x << ' ' << y;
        }
    }
    WebPFree(texels);
    EXPECT_TRUE(image::encode_lossy_webp(image::Image8(), 82.0F).empty());
}

} // namespace
} // namespace frustumscreen::programs

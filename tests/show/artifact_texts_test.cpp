// Texts that are loaded and released with their artifacts, from packs in a folder. OpenGL reports the bytes; pictures
// are compared with those of an exhibit that had the texts from the start.

#include "app/residency/loaded.h"
#include "tests/show/comings.h"

namespace frustumscreen::synthetic {
namespace {

using std::chrono::milliseconds;

/// The first pack has the shortest texts.
pack::Pack narration_pack(std::size_t number) {
    pack::Pack pack = numbered_pack(number);
    pack.languages = {"en", "de"};
    std::string description = "A first sentence says what there is to see.";
    for (std::size_t k = 0; k < number; ++k) {
        description += " Another sentence says more of it, and what was meant by it.";
    }
    pack.captions = {{"en", pack.title, "A short text"}, {"de", "Werk " + pack.title, "Ein kurzer Text"}};
    for (pack::PackCaption& caption : pack.captions) {
        caption.description = description;
    }
    return pack;
}

class ArtifactShowTextsTest : public ArtifactShowTest {
protected:
    ArtifactShowTextsTest() {
        settings.exhibit.captions = true;
        for (std::size_t k = 0; k < files.files().size(); ++k) {
            static_cast<void>(write_file(files.files()[k], pack::write_pack(narration_pack(k)).value()));
        }
    }
    void start(std::size_t packs, bool waits, bool other_languages = true) {
        devices.language = other_languages;
        ArtifactShowTest::start(packs, waits);
    }
    /// Bytes of the texts' coverage in the GPU's memory, from the exhibit's sizes.
    [[nodiscard]] std::uint64_t coverage_bytes(const std::vector<glm::dvec2>& widths) const {
        const double texels_per_m =
            settings.projector.pinhole.fx / settings.projector.table_from_projector.translation.z;
        std::uint64_t bytes = 0;
        for (const glm::dvec2& size_m : widths) {
            glm::ivec2 size(glm::round(texels_per_m * size_m));
            for (; size != glm::ivec2(1); size = glm::max(size / 2, glm::ivec2(1))) {
                bytes += static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
            }
            bytes += 1;
        }
        return bytes;
    }
    [[nodiscard]] std::uint64_t caption_bytes(std::size_t artifact, std::size_t language) const {
        return coverage_bytes(show->catalogue()[artifact].caption_sizes_m[language]);
    }
    [[nodiscard]] std::uint64_t bytes_of(std::size_t artifact, std::size_t language) const {
        std::uint64_t bytes = caption_bytes(artifact, language);
        for (const std::vector<glm::dvec2>& portion :
             show->catalogue()[artifact].descriptions[language].sizes_m) {
            bytes += coverage_bytes(portion);
        }
        return bytes;
    }
    [[nodiscard]] image::Image8 picture() { return render::read_colour(display->framebuffer(), 320, 200); }
    const std::array<settings::Command, 1> language{settings::Command::NextLanguage};
};

TEST_F(ArtifactShowTextsTest, LoadsOnlyTheFirstCaptionInTheDefaultLanguageAtStart) {
    start(5, false);
    const show::ShowUse use = show->use();
    EXPECT_EQ(use.text_gpu_bytes, caption_bytes(0, 0));
    EXPECT_EQ(use.gpu_bytes, use.planned_gpu_bytes);
    EXPECT_EQ(use.captions, 10U); // that may be shown
    start(1, false, false);
    EXPECT_EQ(show->use().gpu_bytes, use.gpu_bytes); // independent of the other packs
}

TEST_F(ArtifactShowTextsTest, LoadsCaptionsOfNeighboursAndAllTextsOfTheChosenArtifact) {
    start(5, true);
    rest();
    EXPECT_EQ(show->use().text_gpu_bytes,
              bytes_of(0, 0) + caption_bytes(0, 1) + caption_bytes(1, 0) + caption_bytes(4, 0));
    step(next);
    rest();
    EXPECT_EQ(show->use().text_gpu_bytes, bytes_of(0, 0) + caption_bytes(0, 1) + bytes_of(1, 0) +
                                              caption_bytes(1, 1) + caption_bytes(2, 0) +
                                              caption_bytes(4, 0));
    EXPECT_EQ(show->use().gpu_bytes, show->use().planned_gpu_bytes);
}

TEST_F(ArtifactShowTextsTest, ReleasesTheTextsOfAnUnloadedArtifact) {
    settings.exhibit.memory_mb = 0; // only what is shown
    start(5, true);
    rest();
    const show::ShowUse first = show->use();
    EXPECT_EQ(first.text_gpu_bytes, bytes_of(0, 0));
    step(next);
    rest();
    const show::ShowUse second = show->use();
    EXPECT_EQ(second.text_gpu_bytes, bytes_of(1, 0));
    EXPECT_GT(second.text_gpu_bytes, first.text_gpu_bytes);
    EXPECT_EQ(second.gpu_bytes - first.gpu_bytes, second.text_gpu_bytes - first.text_gpu_bytes);
    const std::array<settings::Command, 1> back{settings::Command::PreviousArtifact};
    step(back);
    rest();
    EXPECT_EQ(show->use().gpu_bytes, first.gpu_bytes);
}

TEST_F(ArtifactShowTextsTest, LoadsAnotherLanguageAndDrawsItAsAfterAStart) {
    settings.exhibit.language = "de";
    start(1, true);
    rest();
    const image::Image8 german = picture();
    settings.exhibit.language = "en";
    start(1, false);
    while (show->use().text_gpu_bytes < bytes_of(0, 0) + caption_bytes(0, 1)) { // may loop forever
        std::this_thread::sleep_for(milliseconds(1));
        step();
    }
    rest();
    EXPECT_NE(picture().texels, german.texels);
    EXPECT_EQ(show->use().text_gpu_bytes, bytes_of(0, 0) + caption_bytes(0, 1));
    step(language); // its caption is loaded; the narration is loaded next
    while (show->use().text_gpu_bytes < bytes_of(0, 0) + bytes_of(0, 1)) { // may loop forever
        std::this_thread::sleep_for(milliseconds(1));
        step();
    }
    rest();
    EXPECT_EQ(picture().texels, german.texels);
}

TEST_F(ArtifactShowTextsTest, KeepsTheOldLanguageVisibleUntilItHasFadedOut) {
    settings.exhibit.memory_mb = 0;
    start(3, true);
    rest();
    const image::Image8 english = picture();
    step(language);
    step();
    EXPECT_EQ(show->use().text_gpu_bytes, bytes_of(0, 0) + bytes_of(0, 1));
    const image::Image8 fading = picture();
    long lit = 0;
    long dimmed = 0;
    for (std::size_t k = 0; k < english.texels.size(); ++k) {
        if (english.texels[k].r > 100 && fading.texels[k] != english.texels[k]) {
            ++dimmed;
            lit += fading.texels[k].r > 50 ? 1 : 0;
        }
    }
    EXPECT_GT(dimmed, 20);
    EXPECT_GT(lit, dimmed / 2);
    rest();
    EXPECT_EQ(show->use().text_gpu_bytes, bytes_of(0, 1));
}

TEST_F(ArtifactShowTextsTest, KeepsAnArtifactWhosePackDisappearsBeforeItsTextsLoad) {
    start(1, true);
    rest();
    const exhibit::Presentation before = step();
    ASSERT_TRUE(before.caption);
    std::filesystem::remove(files.files()[0]);
    step(language);
    rest();
    EXPECT_EQ(show->artifacts()[0], exhibit::ArtifactState::Ready);
    EXPECT_TRUE(show->state(step()).left_out->empty());
    EXPECT_TRUE(shown_blue());
    EXPECT_EQ(show->use().text_gpu_bytes, bytes_of(0, 0) + caption_bytes(0, 1));
}

TEST_F(ArtifactShowTextsTest, RejectsTextsOfAnotherPack) {
    start(1, true);
    pack::Pack other = narration_pack(0);
    other.captions[1].text = "Ein anderer, viel längerer Text";
    const residency::KnownArtifact known{files.files()[0], pack::outline_of(narration_pack(0)), {}, {}};
    const std::vector<std::size_t> captions{0, 1};
    const residency::TextStyle style{0.010, 1000.0};
    const residency::ArtifactTexts texts =
        residency::lay_out_texts({known.file, known.outline.description, captions}, 1.0, style, false)
            .value();
    const auto never = [] { return false; };
    EXPECT_TRUE(residency::draw_texts({known.file, known.outline.description, captions}, texts,
                                      residency::TextPart::Caption, 1, style, never));
    const Result<residency::TextPictures> refused = residency::draw_texts(
        {known.file, other, captions}, texts, residency::TextPart::Caption, 1, style, never);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().id, "show.texts_changed") << refused.error().message;
}

TEST_F(ArtifactShowTextsTest, CountsHotspotOccludersAndTablePicturesInTheMemory) {
    start(1, true);
    const std::uint64_t without = show->state(step()).loaded_bytes;
    pack::Pack pointing = narration_pack(0);
    pointing.hotspots = {{{0.0, 0.0, 0.5}, {0.0, 0.0, 1.0}, {{"en", "Here"}, {"de", "Hier"}}}};
    static_cast<void>(write_file(files.files()[0], pack::write_pack(pointing).value()));
    start(1, true);
    const std::uint64_t corners = 9 * sizeof(float) * (pointing.levels[0].indices.size() / 3);
    EXPECT_GE(show->state(step()).loaded_bytes, without + corners);

    for (const bool on_table : {false, true}) {
        for (std::size_t k = 0; k < 3; ++k) {
            pack::Pack pack = narration_pack(k);
            pack.table_picture = image::Image8(512, 512, {9, 200, 99, 255}); // 1.4 MB of the GPU's memory
            static_cast<void>(write_file(files.files()[k], pack::write_pack(pack).value()));
        }
        settings.exhibit.table_pictures = on_table;
        settings.exhibit.memory_mb = 4;
        start(3, true);
        rest();
        EXPECT_EQ(show->state(step()).loaded, on_table ? 1U : 3U);
    }
}

} // namespace
} // namespace frustumscreen::synthetic

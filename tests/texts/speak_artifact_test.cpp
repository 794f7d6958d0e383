// The audio description: recordings take precedence over the voice, and some texts stay silent.
#include "assets_baked/texts/speak_artifact.h"
#include "tests/programs/program_folder.h"
#include "tests/texts/wav_bytes.h"

using namespace frustumscreen;
using namespace frustumscreen::texts;
using namespace frustumscreen::testing;

namespace {

class SpeakArtifact : public programs::ProgramFolder {
protected:
    /// A tone of this length, which identifies a recording.
    std::filesystem::path tone(const std::string& file, double seconds) const {
        std::filesystem::create_directories((folder / file).parent_path());
        EXPECT_TRUE(write_file(folder / file, wav16(sine(0.2, seconds))));
        return folder / file;
    }
    [[nodiscard]] static pack::PackCaption caption(const std::string& language,
                                                   const std::string& description) {
        pack::PackCaption made{language, "Jug", ""};
        made.description = description;
        return made;
    }
    /// Length that a player plays; the bake trims nothing from a tone.
    [[nodiscard]] static double seconds_of(const Bytes& opus) {
        const Result<Recording> recording = read_recording(opus, RecordingSource::File);
        EXPECT_TRUE(recording);
        return recording ? static_cast<double>(recording->samples.size()) / recording->rate_hz : 0.0;
    }
};

} // namespace

TEST_F(SpeakArtifact, prefers_named_recording_then_folder_then_voice) {
    SpeechSources sources;
    sources.recordings = {{"en", tone("mine.wav", 1.0)}};
    tone("recordings/en/description.wav", 2.0);
    tone("recordings/de/description.wav", 3.0);
    sources.folder = folder / "recordings";
    sources.voice = Voice("cat " + tone("voice.wav", 4.0).string());
    const Result<SpokenArtifact> spoken = speak_artifact(
        std::vector{caption("en", "A jug."), caption("de", "Ein Krug."), caption("fr", "Une cruche.")},
        sources);
    ASSERT_TRUE(spoken) << spoken.error().message;
    ASSERT_EQ(spoken->languages.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
        const double expected = std::array{1.0, 3.0, 4.0}.at(k);
        EXPECT_NEAR(seconds_of(spoken->languages[k].sounds.at("description")), expected, 0.3) << k;
    }
    EXPECT_TRUE(spoken->silent.empty());
    ASSERT_EQ(spoken->notes.size(), 1U);
    EXPECT_NE(spoken->notes[0].find("en/description.wav: this recording is not used"), std::string::npos);
    EXPECT_TRUE(spoken->notes[0].ends_with("mine.wav is used instead")) << spoken->notes[0];
}

TEST_F(SpeakArtifact, skips_a_wordless_description_and_rejects_a_silent_recording) {
    ASSERT_TRUE(write_file(folder / "silence.wav", wav16(std::vector<double>(9600, 0.0))));
    SpeechSources sources;
    sources.voice = Voice("cat " + (folder / "silence.wav").string());
    const std::vector captions{caption("en", "***")};
    const Result<SpokenArtifact> spoken = speak_artifact(captions, sources);
    ASSERT_TRUE(spoken) << spoken.error().message;
    EXPECT_EQ(spoken->silent,
              (std::vector<std::string>{"the description in 'en' is silent, but it is shown: cat "
                                        "finds nothing to speak in '***'"}));
    sources.recordings = {{"en", folder / "silence.wav"}};
    const Result<SpokenArtifact> refused = speak_artifact(captions, sources);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(
        refused.error().message.ends_with("silence.wav: the recording is silent; record it again, louder"));
}

TEST_F(SpeakArtifact, reports_silent_descriptions_and_unused_recordings) {
    SpeechSources sources;
    sources.folder = folder / "recordings";
    tone("recordings/de/description.wav", 1.0);
    const Result<SpokenArtifact> spoken =
        speak_artifact(std::vector{caption("en", "A jug."), caption("de", ""), caption("fr", ""),
                                   caption("it", "Una brocca.")},
                       sources);
    ASSERT_TRUE(spoken) << spoken.error().message;
    EXPECT_TRUE(spoken->languages.empty());
    EXPECT_EQ(spoken->silent,
              (std::vector<std::string>{"the description in 'en', 'it' is silent, but it is shown: "
                                        "there is no recording and no voice"}));
    ASSERT_EQ(spoken->notes.size(), 1U);
    EXPECT_NE(spoken->notes.front().find("de/description.wav: there is no text of this recording"),
              std::string::npos)
        << spoken->notes.front();
}

TEST_F(SpeakArtifact, notes_a_recording_whose_length_does_not_match_its_text) {
    SpeechSources sources;
    sources.folder = folder / "recordings";
    tone("recordings/en/description.wav", 1.0);
    tone("recordings/de/description.wav", 12.0);
    tone("recordings/fr/description.wav", 12.0);
    const Result<SpokenArtifact> spoken =
        speak_artifact(std::vector{caption("en", std::string(1200, 'x')), caption("de", "Ein Krug."),
                                   caption("fr", std::string(90, 'x'))},
                       sources);
    ASSERT_TRUE(spoken) << spoken.error().message;
    EXPECT_EQ(spoken->languages.size(), 3U) << "they are spoken all the same";
    ASSERT_EQ(spoken->notes.size(), 2U);
    EXPECT_TRUE(spoken->notes[0].ends_with(
        "en/description.wav: it lasts 1 s, and to speak the description in 'en' takes "
        "about 80 s; see whether both are of the same text"))
        << spoken->notes[0];
    EXPECT_TRUE(spoken->notes[1].ends_with(
        "de/description.wav: it lasts 12 s, and to speak the description in 'de' takes "
        "about 1 s; see whether both are of the same text"))
        << spoken->notes[1];
}

TEST_F(SpeakArtifact, notes_an_unused_recording_with_the_nearest_name) {
    SpeechSources sources;
    sources.folder = folder / "recordings";
    sources.left_out = {"it"};
    for (const char* file :
         {"de/descripton.wav", "en/description.wav", "en/description.flac", "en/description.mp3",
          "fr/description.opus", "it/description.wav", "description.wav", "en/notes.txt"}) {
        tone(std::string("recordings/") + file, 1.0);
    }
    const Result<SpokenArtifact> spoken = speak_artifact(
        std::vector{caption("en", "A jug as any other."), caption("de", "Ein Krug.")}, sources);
    ASSERT_TRUE(spoken) << spoken.error().message;
    std::vector<std::string> told;
    for (const std::string& note : spoken->notes) {
        told.push_back(note.substr(sources.folder.string().size() + 1));
    }
    const std::string nobody = ": this recording is not used: ";
    const std::string unknown = nobody + "no text has this name; the nearest name of a text is ";
    const std::string second = nobody + sources.folder.string() + "/en/description.wav is used instead";
    EXPECT_EQ(told, (std::vector<std::string>{"de/descripton.wav" + unknown + "de/description.wav",
                                              "description.wav" + unknown + "de/description.wav",
                                              "en/description.flac" + second, "en/description.mp3" + second,
                                              "fr/description.opus" + unknown + "de/description.opus"}));
}

TEST_F(SpeakArtifact, matches_recording_names_case_insensitively) {
    SpeechSources sources;
    sources.folder = folder / "Recordings";
    sources.left_out = {"it"};
    tone("Recordings/EN/Description.WAV", 1.0);
    tone("Recordings/de-at/description.wav", 2.0);
    tone("Recordings/IT/description.wav", 1.0);
    tone("Recordings/EN/DESCRIPTION.FLAC", 1.0);
    const Result<SpokenArtifact> spoken =
        speak_artifact(std::vector{caption("en", "A jug."), caption("de-AT", "Ein Krug.")}, sources);
    ASSERT_TRUE(spoken) << spoken.error().message;
    ASSERT_EQ(spoken->languages.size(), 2U);
    EXPECT_NEAR(seconds_of(spoken->languages[0].sounds.at("description")), 1.0, 0.3);
    EXPECT_NEAR(seconds_of(spoken->languages[1].sounds.at("description")), 2.0, 0.3);
    ASSERT_EQ(spoken->notes.size(), 1U) << spoken->notes[0];
    EXPECT_TRUE(spoken->notes[0].ends_with("EN/Description.WAV is used instead")) << spoken->notes[0];
}

TEST_F(SpeakArtifact, fails_on_an_unreadable_recording_or_a_failing_voice) {
    SpeechSources sources;
    put("noise.wav", "this is no recording");
    sources.recordings = {{"en", folder / "noise.wav"}};
    const std::vector captions{caption("en", "A jug.")};
    const Result<SpokenArtifact> bad = speak_artifact(captions, sources);
    ASSERT_FALSE(bad);
    EXPECT_NE(bad.error().message.find("noise.wav: "), std::string::npos) << bad.error().message;
    sources.recordings.clear();
    sources.voice = Voice("false");
    const Result<SpokenArtifact> mute = speak_artifact(captions, sources);
    ASSERT_FALSE(mute);
    EXPECT_TRUE(mute.error().message.starts_with("the description in 'en': ")) << mute.error().message;
}

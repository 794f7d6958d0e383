// The tables [[states]] of artifact.toml, and the messages about mistakes in them.
#include "assets_baked/folder/artifact_file.h"
#include "tests/base/told.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::folder {
namespace {

Result<ArtifactFile> with_states(const std::string& lines) {
    return parse_artifact_file("scan = \"chest.glb\"\n" + lines, "chest/artifact.toml");
}

TEST(ArtifactStates, parse_every_key) {
    const Result<ArtifactFile> file = with_states(R"(
[[states]]
name = "found"
layer = "found.png"
lit = false
titles = { en = "As found", DE = "Fundzustand" }
[[states]]
name = "open"
behaviour = "Lid"
hide = ["knob", "left hinge"]
titles = { en = "Open" }
[[states]]
name = "today"
titles = { en = "Today" }
)");
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->states.size(), 3U);
    const ArtifactState& found = file->states[0];
    EXPECT_EQ(found.name, "found");
    ASSERT_TRUE(found.layer);
    EXPECT_EQ(found.layer->file, "chest/found.png");
    EXPECT_FALSE(found.layer->lit);
    EXPECT_EQ(found.titles, (std::vector<pack::PackLabel>{{"de", "Fundzustand"}, {"en", "As found"}}));
    EXPECT_EQ(file->states[1].behaviour, "Lid");
    EXPECT_EQ(file->states[1].hide, (std::vector<std::string>{"knob", "left hinge"}));
    EXPECT_FALSE(file->states[1].layer);
    EXPECT_TRUE(file->states[2].behaviour.empty());
}

TEST(ArtifactStates, report_mistakes) {
    const std::string good = "name = \"a\"\ntitles = { en = \"A\" }\n";
    ASSERT_TRUE(with_states("[[states]]\n" + good));
    for (const auto& [lines, words] : std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"titles = { en = \"A\" }\n", {"[state_file.no_name]", "artifact.toml"}},
             {"name = \"a\"\n", {"[state_file.no_title]", "titles"}},
             {good + "[[states]]\n" + good, {"[state_file.name_twice]", "\"a\""}},
             {good + "lit = false\n", {"[state_file.lit]"}},
             {good + "layer = \"\"\n", {"[torch_file.no_layer]"}},
             {good + "layer = \"../b.png\"\n", {"[folder.file_name]"}},
             {good + "hides = [\"b\"]\n", {"hides", "hide"}},
             {good + "hide = \"b\"\n", {"hide"}},
             {"name = \"a\"\ntitles = { en = \"\" }\n", {"titles"}},
         }) {
        const Result<ArtifactFile> file = with_states("[[states]]\n" + lines);
        ASSERT_FALSE(file) << lines;
        for (const std::string& word : words) {
            EXPECT_NE(test::told(file.error()).find(word), std::string::npos)
                << lines << word << ": " << test::told(file.error());
        }
    }
    std::string many;
    for (int k = 0; k < 6; ++k) {
        many += "[[states]]\nname = \"" + std::to_string(k) + "\"\ntitles = { en = \"A\" }\n";
    }
    const Result<ArtifactFile> too_many = with_states(many);
    ASSERT_FALSE(too_many);
    EXPECT_NE(too_many.error().message.find('5'), std::string::npos) << too_many.error().message;
    const Result<ArtifactFile> single = with_states("[states]\n" + good);
    ASSERT_FALSE(single);
    EXPECT_NE(single.error().message.find("[[states]]"), std::string::npos) << single.error().message;
}

} // namespace
} // namespace frustumscreen::folder

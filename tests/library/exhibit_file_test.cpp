// exhibit.toml: its contents, and the message for each mistake.
#include "app/library/exhibit_file.h"
#include "tests/base/told.h"

#include <gtest/gtest.h>

namespace frustumscreen::library {
namespace {

std::string refusal_of(std::string_view text) {
    const Result<ExhibitFile> file = parse_exhibit_file(text);
    return file ? "" : test::told(file.error());
}

TEST(ExhibitFile, ParsesEveryKey) {
    const Result<ExhibitFile> file = parse_exhibit_file(R"(
order = ["vase", "cup.2"]
only = true
remove = ["old"]
[attract]
de = "  Treten Sie näher  "
[[key]]
name = "2031"
public_key = "RWQf6LRCGA9i53mlYecO4IzT51TGPpvWucNSCh1CBM0QTaLn73Y7GFO3"
until = "2031-12-31"
)");
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->order, (std::vector<std::string>{"vase", "cup.2"}));
    EXPECT_TRUE(file->only);
    EXPECT_EQ(file->remove, std::vector<std::string>{"old"});
    EXPECT_EQ(file->attract, (std::vector<AttractText>{{"de", "Treten Sie näher"}}));
    ASSERT_EQ(file->keys.size(), 1U);
    EXPECT_EQ(file->keys[0],
              (CarriedKey{"2031", "RWQf6LRCGA9i53mlYecO4IzT51TGPpvWucNSCh1CBM0QTaLn73Y7GFO3", "2031-12-31"}));
}

TEST(ExhibitFile, MayBeEmpty) {
    const Result<ExhibitFile> file = parse_exhibit_file("# nothing yet\n");
    ASSERT_TRUE(file);
    EXPECT_FALSE(file->attract);
}

TEST(ExhibitFile, ReportsErrorsWithLineAndNearestKey) {
    EXPECT_TRUE(test::tells(refusal_of("\nordre = [\"vase\"]\n"),
                            {"exhibit.toml:2: ordre ", "key is order ", "[settings.unknown_key]"}));
    EXPECT_EQ(refusal_of("[[key]]\nname = \"x\"\npublic_ky = \"y\"\n").substr(0, 15), "exhibit.toml:1:");
    for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
             {"order = [\"Vase\"]", "exhibit.toml:1: order names \"Vase\""},
             {"order = [\"a\", \"a\"]", "names \"a\" twice"},
             {"order = \"a\"", "exhibit.toml:1: order is"},
             {"only = true", "[exhibit_file.only]"},
             {"order = [\"a\"]\nremove = [\"a\"]",
              "exhibit.toml:2: remove names \"a\", which order names too"},
             {"[attract]\nenglish = \"x\"", "exhibit.toml:1: attract has \"english\""},
             {"[attract]\nen = \"a\\nb\"", "attract in en"},
             {"[attract]\nen = \"\"", "is empty"},
             {"[attract]\nen = \"a\"\nEN = \"b\"", "en twice"},
             {"[[key]]\nname = \"x\"", "public_key is missing"},
             {"[[key]]\nname = \"x\"\npublic_key = \"RWQ\"", "public_key is missing or not a public key"},
             {"[[key]]\nname = \"x\"\npublic_key = "
              "\"RWQf6LRCGA9i53mlYecO4IzT51TGPpvWucNSCh1CBM0QTaLn73Y7GFO3\"\nuntil "
              "= \"2031-02-30\"",
              "exhibit.toml:4: key[0].until is not a day"},
             {"order = [", "[toml.syntax]"},
             {"order = [\"\xff\"]", "is not UTF-8"},
             {std::string(70000, '#'), "allowed are at most 65536"},
             {std::string(6000, '.'), "dots"},
         }) {
        const std::string refusal = refusal_of(text);
        EXPECT_NE(refusal.find(words), std::string::npos) << refusal << "\nfor " << text.substr(0, 80);
        EXPECT_EQ(refusal.find('\n'), std::string::npos);
    }
}

} // namespace
} // namespace frustumscreen::library

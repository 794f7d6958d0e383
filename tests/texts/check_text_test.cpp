// The characters that a text may contain.
#include "assets_baked/texts/check_text.h"
#include "tests/base/told.h"

#include <gtest/gtest.h>

using namespace frustumscreen;
using namespace frustumscreen::texts;

namespace {

std::string refusal(std::string_view text) {
    const Result<void> checked = check_shaped_text(text);
    return checked ? std::string() : test::told(checked.error());
}

} // namespace

TEST(CheckText, accepts_text_of_every_script) {
    EXPECT_EQ(refusal("Ἀθήνησιν, حرّك, ब्लॉक, โต๊ะ, 回 and \xf0\xa0\x9c\x8e\nsecond line"), "");
    EXPECT_EQ(refusal(""), "");
    EXPECT_EQ(refusal("\xe2\x80\x8f\xe2\x81\xa7isolated\xe2\x81\xa9 soft\xc2\xadhyphen"), "");
}

TEST(CheckText, names_the_place_of_invalid_utf8) {
    EXPECT_TRUE(test::tells(refusal("ab\nc\xff"), {"line 2, letter 2: byte 0xff", "[text.not_utf8]"}));
    EXPECT_TRUE(test::tells(refusal("\xed\xa0\x80"), {"line 1, letter 1: byte 0xed", "[text.not_utf8]"}));
    EXPECT_TRUE(test::tells(refusal("\xc0\xaf"), {"line 1, letter 1: byte 0xc0", "[text.not_utf8]"}));
}

TEST(CheckText, control_characters_are_refused) {
    for (const char* text : {"a\tb", "a\x7f", "a\xc2\x85", "a\xe2\x80\xa8", "a\r\n", "a\x1b[2J"}) {
        EXPECT_NE(refusal(text).find("is a control character"), std::string::npos) << text;
    }
    EXPECT_TRUE(
        test::tells(refusal(std::string_view("a\0b", 3)), {"line 1, letter 2: U+0000", "[text.letter]"}));
}

TEST(CheckText, rejects_bidirectional_overrides) {
    for (const char* text :
         {"\xe2\x80\xaa", "\xe2\x80\xab", "\xe2\x80\xac", "\xe2\x80\xad", "\xe2\x80\xae"}) {
        EXPECT_NE(refusal(text).find("overrides the order"), std::string::npos);
    }
    EXPECT_EQ(refusal("x\xe2\x80\xaey").substr(0, 31), "line 1, letter 2: U+202E overri");
}

TEST(CheckText, rejects_four_megabytes_and_ten_thousand_lines) {
    EXPECT_TRUE(test::tells(refusal(std::string(4U << 20, 'a')), {"4194304", "100000", "[text.too_long]"}));
    EXPECT_TRUE(test::tells(refusal(std::string(10000, '\n')), {"10001", "200", "[text.too_many_lines]"}));
}

TEST(CheckText, names_letters_by_code_point) {
    EXPECT_EQ(named_letter(U'A'), "'A' (U+0041)");
    EXPECT_EQ(named_letter(code_point_of("é")), "'é' (U+00E9)");
    EXPECT_EQ(named_letter(code_point_of("回")), "'回' (U+56DE)");
    EXPECT_EQ(named_letter(code_point_of("\xf0\x9f\x98\x80")), "'\xf0\x9f\x98\x80' (U+1F600)");
    EXPECT_EQ(named_letter(0x202E), "U+202E");
}

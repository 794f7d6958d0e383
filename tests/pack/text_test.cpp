// Texts that a pack may have, and texts that would harm those beside them.
#include "app/pack/pack_text.h"
#include "tests/pack/samples.h"

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

constexpr const char* right_to_left_override = "\xE2\x80\xAE"; // U+202E
constexpr const char* isolate = "\xE2\x81\xA7";                // U+2067
constexpr const char* end_of_isolate = "\xE2\x81\xA9";         // U+2069

std::string fault(const std::string& text, TextShape shape = TextShape::Line) {
    return fault_of_text(text, shape).value_or("");
}

} // namespace

TEST(Text, accepts_any_script) {
    for (const char* text : {"", "Neck-amphora", "Αμφορέας", "מִזְמוֹר", "أمفورا (540)", "अम्फोरा", "แอมโฟรา",
                             "双耳瓶", "👩‍🎨",
                             "\xE2\x80\x8E"
                             "left-to-right mark"}) {
        EXPECT_EQ(fault(text), "") << text;
    }
}

TEST(Text, reports_the_position_of_invalid_utf8) {
    EXPECT_NE(fault("ab\xFF").find("not UTF-8 from byte 2"), std::string::npos);
    EXPECT_NE(fault("\xED\xA0\x80").find("not UTF-8 from byte 0"), std::string::npos)
        << "an unpaired surrogate";
    EXPECT_NE(fault("\xC3").find("not UTF-8"), std::string::npos);
    EXPECT_NE(fault("\xF4\x90\x80\x80").find("not UTF-8"), std::string::npos) << "beyond U+10FFFF";
}

TEST(Text, names_control_characters) {
    EXPECT_NE(fault("a\x1b[2J").find("U+001B"), std::string::npos);
    EXPECT_NE(fault("a\xC2\x85").find("U+0085"), std::string::npos);
    EXPECT_NE(fault("two\nlines").find("U+000A"), std::string::npos);
    EXPECT_EQ(fault("two\nlines", TextShape::Lines), "");
    EXPECT_NE(fault("\r\n", TextShape::Lines).find("U+000D"), std::string::npos);
}

TEST(Text, rejects_direction_overrides_and_unbalanced_isolates) {
    EXPECT_NE(fault(std::string("a") + right_to_left_override + "b").find("U+202E"), std::string::npos);
    EXPECT_NE(fault("\xE2\x80\xAA").find("U+202A"), std::string::npos);
    EXPECT_EQ(fault(std::string("year ") + isolate + "540" + end_of_isolate + " BC"), "");
    EXPECT_NE(fault(std::string("a") + isolate + "b").find("without its end"), std::string::npos);
    EXPECT_NE(fault(end_of_isolate).find("did not begin"), std::string::npos);
    EXPECT_NE(fault(std::string("a") + isolate + "\nb" + end_of_isolate, TextShape::Lines).find("same line"),
              std::string::npos);
}

TEST(Text, length_and_line_count_are_limited) {
    EXPECT_EQ(fault(std::string(1000, 'x')), "");
    EXPECT_NE(fault(std::string(1001, 'x')).find("1001 bytes"), std::string::npos);
    EXPECT_EQ(fault(std::string(100000, 'x'), TextShape::Lines), "");
    EXPECT_NE(fault(std::string(4 << 20, 'x'), TextShape::Lines).find("write less"), std::string::npos);
    EXPECT_EQ(fault(std::string(999, '\n'), TextShape::Lines), "");
    EXPECT_NE(fault(std::string(10000, '\n'), TextShape::Lines).find("1000 lines"), std::string::npos);
}

TEST(Text, accepts_only_short_plain_ids) {
    for (const char* id : {"a", "0", "museum-1234.a_b", "b7c1e3f0"}) {
        EXPECT_TRUE(is_artifact_id(id)) << id;
    }
    for (const std::string& id : {std::string(), std::string("-a"), std::string("A"), std::string("a b"),
                                  std::string("a/b"), std::string("ä"), std::string(65, 'a')}) {
        EXPECT_FALSE(is_artifact_id(id)) << id;
    }
}

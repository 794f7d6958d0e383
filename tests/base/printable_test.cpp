#include "firmware_host/base/printable.h"

#include <gtest/gtest.h>

namespace frustumscreen {
namespace {

TEST(Printable, KeepsTextOfAnyLanguage) {
    const std::string text = "\xC3\x84mter, \xE8\x8A\xB1\xE7\x93\xB6 \xF0\x9F\x8F\xBA";
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, ReplacesControlCharactersAndInvalidUtf8) {
    EXPECT_EQ(printable("clear \x1b[2J"), "clear ?[2J");
    EXPECT_EQ(printable("a\nb\tc\x7f"), "a?b?c?");
    EXPECT_EQ(printable("pack\u202Egpj.exe"), "pack?gpj.exe"); // would be displayed as packexe.jpg
    EXPECT_EQ(printable("\u2028\u202A\u2066\u2069\u202F"), "??\u2066\u2069\u202F");
    EXPECT_EQ(printable("\xC2\x9B"), "?");            // CSI in 8 bits
    EXPECT_EQ(printable("\xC2\xA0"), "\xC2\xA0");     // the first printable one after the control characters
    EXPECT_EQ(printable("\xC0\xAF"), "??");           // an overlong slash
    EXPECT_EQ(printable("\xED\xA0\x80"), "???");      // a surrogate
    EXPECT_EQ(printable("\xF4\x90\x80\x80"), "????"); // above U+10FFFF
    EXPECT_EQ(printable("\xE8\x8A"), "??");           // cut off
    EXPECT_EQ(printable(std::string_view("\0", 1)), "?");
}

TEST(Printable, TruncatesBetweenCharacters) {
    EXPECT_EQ(printable("12345", 5), "12345");
    EXPECT_EQ(printable("123456", 5), "12345...");
    EXPECT_EQ(printable("1234\xC3\x84", 5), "1234...");
    EXPECT_EQ(printable("123\xC3\x84", 5), "123\xC3\x84");
    EXPECT_EQ(printable("", 5), "");
}

} // namespace
} // namespace frustumscreen

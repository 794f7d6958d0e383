#include "firmware_host/base/format_sentence.h"

#include <gtest/gtest.h>

#include <string>

namespace frustumscreen {
namespace {

/// Two bytes per character in UTF-8.
const std::string amphora = "Αμφορέας";

std::string repeated(std::string_view text, int times) {
    std::string all;
    for (int k = 0; k < times; ++k) {
        all += text;
    }
    return all;
}

TEST(Sentence, HoldsTextUpToItsLastByte) {
    const std::string fits = repeated(amphora, 15);
    ASSERT_EQ(fits.size(), Sentence::longest);
    EXPECT_EQ(Sentence(fits).view(), fits);
    EXPECT_EQ(format_sentence("{}", fits).view(), fits);
    EXPECT_EQ(Sentence(repeated("a", 300)).view(), repeated("a", 240));
    EXPECT_EQ(Sentence("").view(), "");
}

/// Characters of one to four bytes, shifted byte by byte across the limit: only whole characters remain, as
/// many as fit.
TEST(Sentence, TruncatesBetweenCharacters) {
    for (const std::string_view character : {"a", "έ", "画", "𝄞"}) {
        for (int before = 0; before < 8; ++before) {
            const std::string text = repeated("x", before) + repeated(character, 300);
            const std::size_t whole =
                (Sentence::longest - static_cast<std::size_t>(before)) / character.size();
            const std::string expected = repeated("x", before) + repeated(character, static_cast<int>(whole));
            EXPECT_EQ(Sentence(text).view(), expected);
            EXPECT_EQ(format_sentence("{}", text).view(), expected);
            EXPECT_EQ(format_sentence("{}{}", repeated("x", before), repeated(character, 300)).view(),
                      expected);
        }
    }
}

TEST(Sentence, TruncatesInvalidUtf8) {
    for (const char byte : {'\x80', '\xFF', '\xC3', '\0'}) {
        EXPECT_LE(Sentence(std::string(1000, byte)).view().size(), Sentence::longest);
    }
}

} // namespace
} // namespace frustumscreen

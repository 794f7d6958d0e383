#include "app/settings/settings_page.h"
#include "tests/folders.h"
#include "tests/settings/settings_text.h"

#include <regex>

namespace frustumscreen {
namespace {

std::string committed_page() {
    std::ifstream file(source_dir() + "/docs/settings.md", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(SettingsPage, IsTheOneInTheDocuments) {
    EXPECT_EQ(settings_page(), committed_page())
        << "write it again: frustumscreen config --describe > docs/settings.md";
}

/// The shipped file shows a technician every key, in a comment if not by its default.
TEST(SettingsPage, HasNoKeyThatTheShippedFileDoesNotName) {
    const std::string page = settings_page();
    const std::string shipped = shipped_text();
    const std::regex row("\\n\\| `(?:[a-z]+\\[\\]\\.)?([a-z_]+)`");
    int keys = 0;
    for (std::sregex_iterator found(page.begin(), page.end(), row), end; found != end; ++found, ++keys) {
        const std::string key = (*found)[1];
        EXPECT_TRUE(std::regex_search(shipped, std::regex("\\b" + key + "\\b"))) << key;
    }
    EXPECT_GT(keys, 45);
}

/// What the page says is allowed is what the reader allows.
TEST(SettingsPage, HasTheRangesAndDefaultsThatHold) {
    const std::string page = settings_page();
    EXPECT_NE(page.find("| `base_m` | `0.3` | 0.02 to 2 metres |"), std::string::npos);
    EXPECT_NE(refusal("[prop]\nbase_m = 2.5").find("allowed are 0.02 to 2 metres"), std::string::npos);
    EXPECT_EQ(parsed("").prop.base_m, 0.3);
    EXPECT_NE(page.find("| `script[].button` | `1` | whole numbers 0 to 4 |"), std::string::npos);
    EXPECT_NE(refusal("[panel]\nscript = [{ button = 5 }]").find("whole numbers 0 to 4"), std::string::npos);
}

} // namespace
} // namespace frustumscreen

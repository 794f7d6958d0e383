#include "app/settings/settings_page.h"
#include "tests/base/text_of.h"
#include "tests/folders.h"
#include "tests/settings/settings_text.h"

#include <fmt/format.h>

#include <regex>
#include <sstream>

namespace frustumscreen::settings {
namespace {

std::string committed_page() {
    return frustumscreen::text_of(source_dir() + "/docs/settings.md");
}

TEST(SettingsPage, MatchesTheCommittedPage) {
    EXPECT_EQ(settings_page(), committed_page())
        << "write it again: frustumscreen config --describe > docs/settings.md";
}

/// The shipped file shows a technician every key, in a comment if not with its default.
TEST(SettingsPage, EveryKeyIsInTheShippedFile) {
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

/// The reader allows exactly the ranges of the page.
TEST(SettingsPage, RangesMatchTheReader) {
    std::istringstream lines(settings_page());
    const std::regex table_form(R"(## \[([\w.]+)\])");
    const std::regex row_form(
        R"(\| `(\w+)` \| `[^`]*` \| (whole numbers )?(-?[0-9.]+) to (-?[0-9.]+)( .*)?\| .*)");
    std::string table;
    int ranges = 0;
    for (std::string line; std::getline(lines, line);) {
        std::smatch match;
        if (std::regex_match(line, match, table_form)) {
            table = match[1];
        } else if (std::regex_match(line, match, row_form)) {
            ++ranges;
            const double step = match[2].matched ? 1.0 : 1e-3;
            const std::string allowed =
                (match[2].matched ? "the whole numbers " : "") + match[3].str() + " to " + match[4].str();
            const auto refused = [&](double value) { // for this reason; other rules may refuse it too
                const std::string text =
                    match[2].matched ? fmt::format("{:.0f}", value) : fmt::format("{:.6f}", value);
                const std::string message =
                    refusal(fmt::format("[{}]\n{} = {}\n", table, match[1].str(), text));
                return message.find("allowed are " + allowed) != std::string::npos;
            };
            const double low = std::stod(match[3]);
            const double high = std::stod(match[4]);
            EXPECT_TRUE(refused(low - step)) << line;
            EXPECT_FALSE(refused(low)) << line;
            EXPECT_FALSE(refused(high)) << line;
            EXPECT_TRUE(refused(high + step)) << line;
        }
    }
    EXPECT_GT(ranges, 45);
    EXPECT_NE(refusal("[panel]\nscript = [{ button = 7 }]").find("whole numbers 0 to 6"), std::string::npos);
}

/// A missing key has the page's default.
TEST(SettingsPage, ListsAKeyWithItsDefaultAndRange) {
    const std::string page = settings_page();
    EXPECT_NE(page.find("| `base_m` | `0.3` | 0.02 to 2 metres |"), std::string::npos);
    EXPECT_EQ(parsed("").prop.base_m, 0.3);
    EXPECT_NE(page.find("| `script[].button` | `1` | whole numbers 0 to 6 |"), std::string::npos);
}

} // namespace
} // namespace frustumscreen::settings

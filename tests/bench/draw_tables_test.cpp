// The bench's side of its plots, with fake scripts (tests/bench/plots tests the real one).

#include "app/bench/plots/draw_tables.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace frustumscreen::bench {
namespace {

namespace fs = std::filesystem;

class DrawTables : public WithTemporaryFolder {
protected:
    [[nodiscard]] fs::path script(const std::string& lines) const {
        const fs::path path = folder / "script";
        put("script", "#!/bin/sh\n" + lines);
        fs::permissions(path, fs::perms::owner_all);
        return path;
    }
};

TEST_F(DrawTables, PassesArgumentsUnchanged) {
    const fs::path said = folder / "said";
    const fs::path echo = script("printf '%s|' \"$@\" >'" + said.string() + "'\n");
    ASSERT_TRUE(draw_tables(echo, {"a b.csv", "$HOME", ""}));
    EXPECT_EQ(text("said"), "a b.csv|$HOME||");
}

TEST_F(DrawTables, ReportsTheLastLineOfAFailingScript) {
    const Result<void> drawn = draw_tables(script("echo one >&2; echo 'the other' >&2; exit 1\n"), {});
    ASSERT_FALSE(drawn);
    EXPECT_EQ(drawn.error().message, "the other");
}

TEST_F(DrawTables, NamesAScriptThatFailsSilentlyOrCrashes) {
    for (const char* lines : {"exit 3\n", "kill -9 $$\n"}) {
        const Result<void> drawn = draw_tables(script(lines), {});
        ASSERT_FALSE(drawn) << lines;
        EXPECT_NE(drawn.error().message.find((folder / "script").string()), std::string::npos);
    }
}

TEST_F(DrawTables, AWarningIsNoError) {
    EXPECT_TRUE(draw_tables(script("echo a warning >&2\n"), {}));
}

TEST_F(DrawTables, ReportsAMissingScript) {
    const Result<void> drawn = draw_tables(folder / "none", {});
    ASSERT_FALSE(drawn);
    EXPECT_EQ(drawn.error().id, "plots.no_program") << drawn.error().message;
    EXPECT_EQ(drawn.error().message.find('\n'), std::string::npos);
}

} // namespace
} // namespace frustumscreen::bench

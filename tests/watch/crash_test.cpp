#include "app/watch/crash.h"
#include "firmware_host/base/crash_file.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>

namespace frustumscreen::watch {
namespace {

constexpr std::string_view whole = "frustumscreen-crash-1\n"
                                   "unix_s 1700000000\n"
                                   "monotonic_ms 57250\n"
                                   "boot b1\n"
                                   "signal SIGSEGV\n"
                                   "thread llvmpipe-0\n"
                                   "program 0.1.0\n"
                                   "system Debian GNU/Linux 12, Linux 6.1\n"
                                   "driver llvmpipe (LLVM 15.0.6)\n"
                                   "frame swrast_dri.so+0x1f3a0\n"
                                   "frame libc.so.6+0x89134\n"
                                   "end\n";

TEST(Crash, ParsesACompleteFile) {
    const std::optional<Crash> crash = parse_crash(whole);
    ASSERT_TRUE(crash);
    EXPECT_EQ(crash->unix_s, 1700000000);
    EXPECT_DOUBLE_EQ(crash->monotonic_s, 57.25);
    EXPECT_EQ(crash->boot, "b1");
    EXPECT_EQ(crash->frames, (std::vector<std::string>{"swrast_dri.so+0x1f3a0", "libc.so.6+0x89134"}));
    EXPECT_TRUE(crash->whole);
    EXPECT_EQ(sentence_of(*crash), "SIGSEGV in swrast_dri.so+0x1f3a0, thread llvmpipe-0");
}

TEST(Crash, NamesTheCallerOfCompiledCode) {
    const std::optional<Crash> crash =
        parse_crash("frustumscreen-crash-1\nsignal SIGSEGV\nthread llvmpipe-1\n"
                    "frame compiled+0x7f00\nguess swrast_dri.so+0x12\nend\n");
    ASSERT_TRUE(crash);
    EXPECT_EQ(sentence_of(*crash), "SIGSEGV in code that the graphics driver compiled, called from "
                                   "swrast_dri.so+0x12, thread llvmpipe-1");
}

/// After a power cut the file is cut off anywhere: the remaining part is reported, or nothing.
TEST(Crash, ParsesATruncatedFileAsFarAsItGoes) {
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const std::optional<Crash> crash = parse_crash(whole.substr(0, length));
        EXPECT_EQ(crash.has_value(), length > whole.find("signal SIGSEGV") + 7) << length;
        EXPECT_FALSE(crash && crash->whole && length < whole.size() - 1) << length;
    }
}

TEST(Crash, RejectsOtherBytes) {
    EXPECT_FALSE(parse_crash(""));
    EXPECT_FALSE(parse_crash("signal SIGSEGV\n"));
    EXPECT_FALSE(parse_crash(std::string(4096, '\0')));
    const std::optional<Crash> odd =
        parse_crash("frustumscreen-crash-1\nsignal \x1b[2J\nunix_s -5\nmonotonic_ms x\n");
    ASSERT_TRUE(odd);
    EXPECT_EQ(odd->signal.find('\x1b'), std::string::npos) << "nothing that a terminal acts on";
    EXPECT_EQ(odd->unix_s, 0);
}

class CrashFolder : public WithTemporaryFolder {};

TEST_F(CrashFolder, ListsTheLatestFirst) {
    for (const auto& [number, at] : {std::pair(1, 30), std::pair(2, 50), std::pair(3, 40)}) {
        put(crash_file_name(number),
            "frustumscreen-crash-1\nunix_s " + std::to_string(at) + "\nsignal SIGBUS\nend\n");
    }
    const std::vector<Crash> crashes = read_crashes(folder);
    ASSERT_EQ(crashes.size(), 3U);
    EXPECT_EQ(crashes[0].unix_s, 50);
    EXPECT_EQ(crashes[1].unix_s, 40);
    EXPECT_EQ(crashes[2].unix_s, 30);
    EXPECT_TRUE(read_crashes("/no/such/folder").empty());
}

} // namespace
} // namespace frustumscreen::watch

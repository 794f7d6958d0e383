// The journal and the faults as they go to the makers.
#include "app/report/shared_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace frustumscreen::report {
namespace {

TEST(SharedText, RemovesOnlySerialNumbersAndLabelsFromTheJournal) {
    // As the kernel and systemd write them, by journalctl of Debian 12.
    const std::string journal =
        "2031-05-04T10:00:00+0000 kernel: usb 1-2: New USB device strings: Mfr=1, Product=2, SerialNumber=3\n"
        "2031-05-04T10:00:00+0000 kernel: usb 1-2: Product: Ultra\n"
        "2031-05-04T10:00:00+0000 kernel: usb 1-2: SerialNumber: 4C531001440704122334\n"
        "2031-05-04T10:00:01+0000 systemd[1]: dev-disk-by\\x2dlabel-ANNA.device: Job timed out.\n"
        "2031-05-04T10:00:01+0000 systemd[1]: Condition check resulted in dev-sda.device - Ultra ANNA being "
        "skipped.\n"
        "2031-05-04T10:00:02+0000 frustumscreen[300]: stick: a stick is there; its contents are being "
        "checked\n";
    const std::string shared = shared_journal(journal, 1000);
    EXPECT_EQ(shared.find("4C531001440704122334"), std::string::npos);
    EXPECT_EQ(shared.find("ANNA"), std::string::npos);
    EXPECT_NE(shared.find("SerialNumber=3\n"), std::string::npos);
    EXPECT_NE(shared.find("Ultra\n"), std::string::npos);
    EXPECT_TRUE(shared.ends_with("its contents are being checked\n"));
}

TEST(SharedText, KeepsTheNewestWholeLinesOfALongJournal) {
    std::string journal;
    for (int k = 0; k < 1000; ++k) {
        journal += fmt::format("line {}\n", k);
    }
    EXPECT_EQ(shared_journal(journal, 18), "line 998\nline 999\n");
    EXPECT_EQ(shared_journal(journal, 17), "line 999\n");
    EXPECT_EQ(shared_journal(journal, 8), "");
    EXPECT_EQ(shared_journal(journal, journal.size()), journal);
    EXPECT_EQ(shared_journal("", 8), "");
    EXPECT_EQ(shared_journal("\n\nno end", 100), "\n\nno end\n");
}

TEST(SharedText, SortsFaultsByTheirNumbers) {
    EXPECT_EQ(faults_in_order("4097 d   \n4098 e   \n    \n9 b   \n10 c   \n"),
              "9 b\n10 c\n4097 d\n4098 e\n");
    EXPECT_EQ(faults_in_order(""), "");
}

} // namespace
} // namespace frustumscreen::report

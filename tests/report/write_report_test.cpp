// A report on a stick that is full, write-protected or pulled out at each operation: what has a name is whole, and one
// sentence says what happened. The stick is a disk in memory that loses what was not synced.
#include "app/report/write_report.h"
#include "tests/library/volatile_disk.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <vector>

namespace frustumscreen::report {
namespace {

using testing_disk::FaultPlan;
using testing_disk::VolatileDisk;

const std::vector<ReportFile>& report() {
    static const std::vector<ReportFile> files{
        {"version.txt", "1.2"}, {"status.txt", ""}, {"journal.txt", std::string(300'000, 'j') + "\n"}};
    return files;
}

std::optional<std::string> text_of(const VolatileDisk& disk, const std::string& name) {
    const auto content = disk.content(name);
    return content ? std::optional(std::string(as_text(**content))) : std::nullopt;
}

/// How many files have their names; each of them is whole.
int whole_files(const VolatileDisk& disk) {
    int count = 0;
    for (const ReportFile& file : report()) {
        if (const std::optional<std::string> text = text_of(disk, file.name)) {
            EXPECT_TRUE(*text == file.text) << file.name << " is cut: " << text->size();
            ++count;
        }
    }
    return count;
}

int operations_of_a_report() {
    VolatileDisk disk;
    EXPECT_TRUE(write_report(disk, report()));
    return disk.operations;
}

void expect_one_line(const library::ImportFailure& failure) {
    EXPECT_FALSE(failure.reason.empty());
    EXPECT_EQ(failure.reason.find('\n'), std::string::npos);
}

TEST(WriteReport, SurvivesAPowerCutAfterwards) {
    VolatileDisk disk;
    ASSERT_TRUE(write_report(disk, report()));
    const int states = disk.cut_power(100, 1, [](VolatileDisk& after) {
        EXPECT_EQ(whole_files(after), 3);
        EXPECT_FALSE(text_of(after, "frustumscreen.part"));
    });
    EXPECT_GE(states, 1);
}

TEST(WriteReport, LeavesOnlyWholeFilesWhenPulledOut) {
    const int operations = operations_of_a_report();
    ASSERT_GT(operations, 3 * 4);
    for (int k = 0; k < operations; ++k) {
        for (const int error : {ENODEV, EIO}) {
            for (const bool done : {false, true}) {
                VolatileDisk disk;
                disk.plan.fail_from = k;
                disk.plan.error = error;
                disk.plan.done_all_the_same = done;
                const tl::expected<void, library::ImportFailure> written = write_report(disk, report());
                ASSERT_FALSE(written) << k;
                EXPECT_EQ(written.error().refusal, library::ImportRefusal::Unreadable);
                expect_one_line(written.error());
                disk.cut_power(64, static_cast<unsigned>(k), [](VolatileDisk& after) { whole_files(after); });
            }
        }
    }
}

TEST(WriteReport, LeavesOnlyWholeFilesWhenKilled) {
    const int operations = operations_of_a_report();
    for (int k = 0; k < operations; ++k) {
        VolatileDisk disk;
        disk.plan.stop_before = k;
        EXPECT_THROW(static_cast<void>(write_report(disk, report())), testing_disk::Stopped);
        disk.cut_power(64, static_cast<unsigned>(k), [](VolatileDisk& after) { whole_files(after); });
    }
}

TEST(WriteReport, RemovesItsFilesFromAFullStick) {
    const int operations = operations_of_a_report();
    for (int k = 2; k < operations; ++k) {
        VolatileDisk disk;
        disk.plan.fail_from = k;
        disk.plan.fail_to = k + 1;
        disk.plan.error = ENOSPC;
        const tl::expected<void, library::ImportFailure> written = write_report(disk, report());
        ASSERT_FALSE(written) << k;
        EXPECT_EQ(written.error().refusal, library::ImportRefusal::NoRoom);
        EXPECT_EQ(whole_files(disk), 0);
        EXPECT_FALSE(text_of(disk, "frustumscreen.part"));
    }
}

TEST(WriteReport, WritesNothingWithoutFreeSpace) {
    VolatileDisk disk;
    disk.free = 300'000;
    const tl::expected<void, library::ImportFailure> written = write_report(disk, report());
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().refusal, library::ImportRefusal::NoRoom);
    EXPECT_NE(written.error().reason.find(" 2 MB"), std::string::npos) << written.error().reason;
    EXPECT_TRUE(disk.list("", [](const FolderEntry& entry) {
        ADD_FAILURE() << entry.name;
        return true;
    }));
}

TEST(WriteReport, ReportsAReadOnlyStick) {
    VolatileDisk disk;
    disk.plan.fail_from = 2; // it can be read
    disk.plan.error = EROFS;
    const tl::expected<void, library::ImportFailure> written = write_report(disk, report());
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().refusal, library::ImportRefusal::Unwritable);
    expect_one_line(written.error());
}

TEST(WriteReport, LeavesAFolderWithFilesUnchanged) {
    VolatileDisk disk;
    disk.put("status.txt", "mine");
    const tl::expected<void, library::ImportFailure> written = write_report(disk, report());
    ASSERT_FALSE(written);
    EXPECT_EQ(text_of(disk, "status.txt"), "mine");
    EXPECT_FALSE(text_of(disk, "version.txt"));
}

/// Packs on the kiosk's disk, the second one longer than the bytes between two syncs.
struct Packs {
    Packs() {
        for (int k = 0; k < 2; ++k) {
            const std::string source = fmt::format("packs/{}", k);
            Bytes bytes(k == 0 ? 10 : (8U << 20U) + 5);
            bytes.back() = std::byte{7};
            disk.put(source, bytes);
            large.files.push_back({fmt::format("{}.fspack", k), source, bytes.size()});
        }
        large.from = &disk;
        large.copied = [this](std::uint64_t bytes) { told += bytes; };
    }
    /// How many have their names; each of them is whole.
    [[nodiscard]] int whole(const VolatileDisk& stick) const {
        int count = 0;
        for (const CopiedFile& file : large.files) {
            if (const auto content = stick.content(file.name)) {
                EXPECT_TRUE(**content == **disk.content(file.source)) << file.name;
                ++count;
            }
        }
        return count;
    }
    VolatileDisk disk;
    CopiedFiles large;
    std::uint64_t told = 0;
};

TEST(WriteReport, CopiesLargeFilesAndReportsProgress) {
    Packs packs;
    VolatileDisk disk;
    ASSERT_TRUE(write_report(disk, report(), packs.large));
    EXPECT_EQ(packs.told, 10U + (8U << 20U) + 5U);
    disk.cut_power(16, 1, [&](VolatileDisk& after) {
        EXPECT_EQ(packs.whole(after), 2);
        EXPECT_EQ(whole_files(after), 3);
    });
}

TEST(WriteReport, LeavesOnlyWholeLargeFilesWhenPulledOut) {
    Packs packs;
    VolatileDisk whole;
    ASSERT_TRUE(write_report(whole, report(), packs.large));
    for (int k = operations_of_a_report() - 1; k < whole.operations; ++k) {
        VolatileDisk disk;
        disk.plan.fail_from = k;
        disk.plan.error = k % 2 == 0 ? ENODEV : ENOSPC;
        ASSERT_FALSE(write_report(disk, report(), packs.large)) << k;
        disk.cut_power(8, static_cast<unsigned>(k),
                       [&](VolatileDisk& after) { static_cast<void>(packs.whole(after)); });
    }
}

TEST(WriteReport, ReportsAFailingDiskOfTheKiosk) {
    Packs packs;
    packs.disk.plan.fail_from = 1;
    packs.disk.plan.error = EIO;
    VolatileDisk disk;
    const tl::expected<void, library::ImportFailure> written = write_report(disk, report(), packs.large);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().refusal, library::ImportRefusal::Unwritable);
    expect_one_line(written.error());
    EXPECT_EQ(packs.whole(disk) + whole_files(disk), 0) << "what was written is taken back";
}

TEST(WriteReport, ChecksFreeSpaceForLargeFilesFirst) {
    Packs packs;
    VolatileDisk disk;
    disk.free = 5'000'000;
    const tl::expected<void, library::ImportFailure> written = write_report(disk, report(), packs.large);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().refusal, library::ImportRefusal::NoRoom);
    EXPECT_EQ(whole_files(disk), 0);
}

} // namespace
} // namespace frustumscreen::report

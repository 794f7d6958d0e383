// Data that survives a reboot: the ladder's memory and the fault records.
#include "app/programs/watchdog/fault_book.h"
#include "app/programs/watchdog/memory_file.h"
#include "app/programs/watchdog/orders.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

namespace frustumscreen::programs {
namespace {

namespace fs = std::filesystem;
using std::chrono::hours;
using std::chrono::minutes;
using std::chrono::seconds;

class KeptFiles : public WithTemporaryFolder {
protected:
    MonotonicTime start_{seconds(50)};
};

TEST_F(KeptFiles, MemoryIsKeptAcrossBoots) {
    watch::LadderMemory memory;
    memory.awake = hours(5);
    memory.mode = watch::Mode::BuiltIn;
    {
        MemoryFile file(folder / "memory", 1);
        EXPECT_FALSE(file.is_of_this_boot());
        EXPECT_TRUE(file.can_write_now(start_));
        EXPECT_TRUE(file.keep(start_, minutes(3), memory, false));
    }
    const MemoryFile same(folder / "memory", 1);
    EXPECT_TRUE(same.is_of_this_boot());
    EXPECT_EQ(same.remembered(minutes(4)).awake, hours(5) + minutes(1));
    const MemoryFile other(folder / "memory", 2);
    EXPECT_FALSE(other.is_of_this_boot());
    EXPECT_EQ(other.remembered(minutes(4)).awake, hours(5) + minutes(4));
    EXPECT_EQ(other.remembered(minutes(4)).mode, watch::Mode::BuiltIn);
}

TEST_F(KeptFiles, MemoryIsWrittenAtMostOnceAMinute) {
    MemoryFile file(folder / "memory", 1);
    watch::LadderMemory memory;
    int writes = 0;
    for (int second = 0; second < 3600; ++second) {
        memory.awake += seconds(1);
        memory.climb = static_cast<std::uint8_t>(second % 7); // it changes all the time
        writes += file.keep(start_ + seconds(second), seconds(second), memory, false) ? 1 : 0;
    }
    EXPECT_EQ(writes, 60);
    writes = 0;
    for (int second = 3600; second < 7200; ++second) { // the time alone changes
        memory.awake += seconds(1);
        writes += file.keep(start_ + seconds(second), seconds(second), memory, false) ? 1 : 0;
    }
    EXPECT_LE(writes, 7);
    EXPECT_EQ(fs::file_size(folder / "memory"), watch::slot_count * watch::slot_bytes);
}

TEST_F(KeptFiles, ReportsAMemoryThatCannotBeWritten) {
    MemoryFile nowhere(folder / "missing" / "memory", 1);
    EXPECT_FALSE(nowhere.can_write_now(start_));
    EXPECT_FALSE(nowhere.keep(start_, seconds(1), {}, true));
    EXPECT_EQ(nowhere.remembered(minutes(4)).awake, minutes(4));
    MemoryFile full("/dev/full", 1);
    EXPECT_FALSE(full.keep(start_, seconds(1), {}, true));
    EXPECT_FALSE(full.can_write_now(start_ + hours(1)));
}

TEST_F(KeptFiles, ReplacesAMalformedMemory) {
    std::ofstream(folder / "memory") << std::string(10'000, 'x');
    MemoryFile file(folder / "memory", 1);
    EXPECT_EQ(file.remembered(minutes(4)).awake, minutes(4));
    EXPECT_TRUE(file.keep(start_, seconds(1), {}, false));
    EXPECT_TRUE(MemoryFile(folder / "memory", 1).is_of_this_boot());
}

Fault fault(const std::string& detail) {
    return {"2026-01-01T10:00:00Z",      seconds(12), watch::Cause::NoPicture,
            watch::Step::RestartExhibit, detail,      {}};
}

TEST_F(KeptFiles, FaultsAreARingOfLimitedSize) {
    MonotonicTime now = start_;
    for (int round = 0; round < 100; ++round) {
        FaultBook book(folder / "faults"); // the program starts again, and goes on behind the latest line
        for (int k = 0; k < 60; ++k) {
            book.enter(fault("number " + std::to_string(60 * round + k)));
        }
        book.keep(now += minutes(1), false);
        EXPECT_EQ(book.latest().size(), FaultBook::max_latest);
    }
    EXPECT_EQ(fs::file_size(folder / "faults"), FaultBook::max_lines * FaultBook::line_bytes);
    std::istringstream lines(text("faults"));
    std::set<int> numbers;
    for (std::string line; std::getline(lines, line);) {
        ASSERT_EQ(line.size() + 1, FaultBook::line_bytes);
        numbers.insert(std::stoi(line));
        EXPECT_NE(line.find("no_picture -> restart_exhibit; number " + std::to_string(std::stoi(line) - 1)),
                  std::string::npos);
    }
    EXPECT_EQ(numbers.size(), FaultBook::max_lines);
    EXPECT_EQ(*numbers.rbegin(), 6000);
    EXPECT_EQ(*numbers.begin(), 6000 - static_cast<int>(FaultBook::max_lines) + 1);
}

TEST_F(KeptFiles, FaultsAreWrittenAtMostOnceAMinute) {
    FaultBook book(folder / "faults");
    book.enter(fault("a"));
    book.keep(start_, false);
    const std::string first = text("faults");
    EXPECT_NE(first.find("; a"), std::string::npos);
    book.enter(fault("b\nc"));
    book.keep(start_ + seconds(59), false);
    EXPECT_EQ(text("faults"), first);
    book.keep(start_ + seconds(60), false);
    EXPECT_NE(text("faults").find("; b c"), std::string::npos) << "one line a fault";
    book.enter(fault("d"));
    book.keep(start_ + seconds(61), true);
    EXPECT_NE(text("faults").find("; d"), std::string::npos) << "at once, before a reboot";
}

TEST_F(KeptFiles, RecordsWhetherTheStepOfAFaultHelped) {
    FaultBook book(folder / "faults");
    book.enter(fault("a"));
    EXPECT_FALSE(book.latest()[0].helped.has_value());
    book.enter(fault("b"));
    EXPECT_EQ(book.latest()[0].helped, false);
    book.note_good();
    Fault down = fault("");
    down.cause.reset();
    book.enter(down);
    EXPECT_EQ(book.latest()[1].helped, true);
    EXPECT_FALSE(book.latest()[2].helped.has_value());
}

TEST_F(KeptFiles, WritesOrdersToFiles) {
    const Orders orders(folder);
    ASSERT_TRUE(orders.begin(watch::Mode::Normal));
    EXPECT_EQ(text("mode"), "normal\n");
    ASSERT_TRUE(orders.give(watch::Step::BuiltIn, watch::Mode::BuiltIn, "a reason"));
    EXPECT_EQ(text("mode"), "built_in\n");
    EXPECT_EQ(text("reason"), "a reason\n");
    EXPECT_TRUE(fs::exists(folder / "steps/restart-exhibit"));
    ASSERT_TRUE(orders.give(watch::Step::Reboot, watch::Mode::Normal, "another"));
    EXPECT_TRUE(fs::exists(folder / "steps/reboot"));
    ASSERT_TRUE(orders.begin(watch::Mode::Normal));
    EXPECT_FALSE(fs::exists(folder / "steps/reboot")) << "an old order counts no more";
    EXPECT_FALSE(Orders(folder / "missing").give(watch::Step::Reboot, watch::Mode::Normal, ""));
}

} // namespace
} // namespace frustumscreen::programs

// A power cut, a stop, a fault or a pulled stick at every single operation of an import leaves the old set or the
// new one, whole.
#include "tests/library/museum.h"

#include <cerrno>
#include <cstdio>

namespace frustumscreen::library {
namespace {

using namespace testing_disk;

constexpr int max_cuts = 512; ///< tried at one operation

/// An installed set of two packs that was good, and its predecessor, to go back to. The stick has a newer pack, a
/// new one and a set file.
class PowerCut : public ::testing::Test {
protected:
    void SetUp() override {
        VolatileDisk first;
        first.put("a.fspack", museum.pack("a", 1));
        first.put("b.fspack", museum.pack("b", 1));
        VolatileDisk second;
        second.put("a.fspack", museum.pack("a", 2));
        ASSERT_TRUE(before.make_folder("shown"));
        ASSERT_EQ(import_quietly(first, before, request).stage, ImportStage::Done);
        judge(before, TrialState::Good);
        ASSERT_EQ(import_quietly(second, before, request).stage, ImportStage::Done);
        judge(before, TrialState::Good);
        before.sync_all();
        old_text = text_of(before);

        stick.put("a.fspack", museum.pack("a", 3, 5000));
        stick.put("more/c.fspack", museum.pack("c", 1));
        museum.put_exhibit(stick, "order = [\"c\", \"a\"]\nattract = { en = \"Come near\" }\n", 1);

        const auto after = before.copy();
        ASSERT_EQ(import_quietly(stick, *after, request).stage, ImportStage::Done);
        new_text = text_of(*after);
        ASSERT_EQ(ids_of(installed(*after)), (std::vector<std::string>{"c 1", "a 3", "b 1"}));
        operations = after->operations;
        ASSERT_GT(operations, 20);
    }

    static std::string text_of(VolatileDisk& disk) {
        const std::optional<Content> content = disk.content("set.txt");
        return content ? std::string(as_text(**content)) : std::string();
    }
    /// Checks that the old set or the new one is there, whole.
    void expect_old_or_new(VolatileDisk& disk, const std::string& where) {
        const std::string text = text_of(disk);
        EXPECT_TRUE(text == old_text || text == new_text) << where << ": " << text.substr(0, 200);
        EXPECT_EQ(inspector.fault_of(disk), "") << where;
        ++(text == new_text ? new_sets : old_sets);
    }
    /// Each operation was cut, some before the switch to the new set and some after it.
    void expect_cuts_on_both_sides(int after_operations) const {
        std::printf("%d operations, %d sampled; %d cuts left the old set, %d the new one; %d imports\n",
                    after_operations, sampled, old_sets, new_sets, imports);
        EXPECT_GT(old_sets + new_sets, after_operations);
        EXPECT_GT(old_sets, 0);
        EXPECT_GT(new_sets, 0);
    }
    void expect_new_after_import(VolatileDisk& disk, const std::string& where) {
        const auto again = disk.copy();
        const auto same_stick = stick.copy();
        EXPECT_EQ(import_quietly(*same_stick, *again, request).stage, ImportStage::Done) << where;
        EXPECT_EQ(text_of(*again), new_text) << where;
        EXPECT_EQ(inspector.fault_of(*again), "") << where;
        ++imports;
    }
    /// Visits all states that a cut may leave, or `max_cuts` of them.
    void sample(const VolatileDisk& disk, int operation, const std::function<void(VolatileDisk&)>& visit) {
        sampled += disk.cut_power(max_cuts, static_cast<unsigned>(operation), visit) == max_cuts ? 1 : 0;
    }
    /// The disk after an import that was stopped before the operation; the process's own state is lost.
    std::unique_ptr<VolatileDisk> stopped(const VolatileDisk& disk, int operation) {
        auto stopped_disk = disk.copy();
        stopped_disk->plan.stop_before = operation;
        const auto same_stick = stick.copy();
        try {
            static_cast<void>(import_quietly(*same_stick, *stopped_disk, request));
        } catch (const Stopped&) {
        }
        stopped_disk->plan = {};
        return stopped_disk;
    }

    Museum museum;
    ImportRequest request = request_of(museum);
    VolatileDisk before, stick;
    std::string old_text, new_text;
    int operations = 0;
    int old_sets = 0, new_sets = 0; ///< left by a cut
    int sampled = 0;                ///< operations with at least `max_cuts` possible states before them
    int imports = 0;
    Inspector inspector;
};

TEST_F(PowerCut, AtEveryOperationLeavesTheOldSetOrTheNewOne) {
    for (int operation = 0; operation <= operations; ++operation) {
        const auto disk = stopped(before, operation);
        std::set<std::string> seen;
        sample(*disk, operation, [&](VolatileDisk& left) {
            const std::string where = fmt::format("cut before operation {}", operation);
            expect_old_or_new(left, where);
            // The result of an import depends on little more than the set.
            if (seen.insert(text_of(left)).second) {
                expect_new_after_import(left, where);
            }
        });
    }
    expect_cuts_on_both_sides(operations);
    EXPECT_GT(imports, operations);
}

/// The names of all packs are synced at once, so that many of them may be there without the others.
TEST_F(PowerCut, LeavesTheOldOrNewSetOfManyPacks) {
    for (const std::string id : {"d", "e", "f", "g"}) {
        stick.put("more/" + id + ".fspack", museum.pack(id, 1, 3000));
    }
    const auto after = before.copy();
    ASSERT_EQ(import_quietly(stick, *after, request).stage, ImportStage::Done);
    new_text = text_of(*after);
    for (int operation = 0; operation <= after->operations; ++operation) {
        const auto disk = stopped(before, operation);
        sample(*disk, operation, [&](VolatileDisk& left) {
            expect_old_or_new(left, fmt::format("cut before operation {}", operation));
        });
        expect_new_after_import(*disk, fmt::format("stopped before {}", operation));
    }
    expect_cuts_on_both_sides(after->operations);
}

TEST_F(PowerCut, LeavesTheOldOrNewSetAfterAStoppedImport) {
    for (int first = 0; first <= operations; ++first) {
        const auto disk = stopped(before, first);
        for (int second = 0; second <= operations; second += 1 + (first + second) % 3) {
            const auto again = stopped(*disk, second);
            again->cut_power(24, static_cast<unsigned>(100 * first + second), [&](VolatileDisk& left) {
                expect_old_or_new(left, fmt::format("stopped before {}, cut before {}", first, second));
            });
        }
        expect_new_after_import(*disk, fmt::format("stopped before {}", first));
    }
    expect_cuts_on_both_sides(operations);
}

TEST_F(PowerCut, InAnEmptyFolderLeavesNothingOrTheSet) {
    const auto after = std::make_unique<VolatileDisk>();
    ASSERT_EQ(import_quietly(stick, *after, request).stage, ImportStage::Done);
    old_text.clear();
    new_text = text_of(*after);
    for (int operation = 0; operation <= after->operations; ++operation) {
        const auto disk = stopped(VolatileDisk(), operation);
        bool first = true;
        sample(*disk, operation, [&](VolatileDisk& left) {
            expect_old_or_new(left, fmt::format("cut before operation {}", operation));
            if (std::exchange(first, false)) {
                expect_new_after_import(left, fmt::format("cut before operation {}", operation));
            }
        });
    }
    expect_cuts_on_both_sides(after->operations);
}

/// A rename replaces the damaged file.
TEST_F(PowerCut, DuringARepairLeavesTheOldOrTheRepairedSet) {
    VolatileDisk same;
    same.put("a.fspack", museum.pack("a", 2));
    Bytes damaged = **before.content(installed(before).packs.at(0).file);
    damaged.back() ^= std::byte{1};
    before.put(installed(before).packs.at(0).file, damaged);
    const auto after = before.copy();
    ASSERT_EQ(import_quietly(same, *after, request).stage, ImportStage::Done);
    ASSERT_EQ(inspector.fault_of(*after), "");
    const std::string mended = text_of(*after);
    for (int operation = 0; operation <= after->operations; ++operation) {
        auto disk = before.copy();
        disk->plan.stop_before = operation;
        try {
            static_cast<void>(import_quietly(same, *disk, request));
        } catch (const Stopped&) {
        }
        sample(*disk, operation, [&](VolatileDisk& left) {
            const std::string text = text_of(left);
            EXPECT_TRUE(text == old_text || (text == mended && inspector.fault_of(left).empty()))
                << operation;
            EXPECT_EQ(import_quietly(same, left, request).stage, ImportStage::Done);
            EXPECT_EQ(inspector.fault_of(left), "") << operation;
        });
    }
}

TEST_F(PowerCut, DiskFaultsLeaveTheOldOrNewSet) {
    for (const int error : {ENOSPC, EIO, EROFS}) {
        for (const bool done : {false, true}) {
            for (int operation = 0; operation <= operations; ++operation) {
                const std::string where = fmt::format("error {} at operation {}", error, operation);
                const auto disk = before.copy();
                disk->plan = {FaultPlan::never, operation, operation + 1, error, done};
                const auto same_stick = stick.copy();
                const ImportReport report = import_quietly(*same_stick, *disk, request);
                disk->plan = {};
                if (report.stage == ImportStage::Failed) {
                    const bool is_new = text_of(*disk) == new_text;
                    EXPECT_EQ(report.set_number == 3, is_new) << where;
                    for (const ImportedPack& pack : report.packs) {
                        EXPECT_EQ(pack.outcome, is_new ? ImportOutcome::Taken : ImportOutcome::Refused)
                            << where;
                    }
                    EXPECT_EQ(report.refusal,
                              error == ENOSPC && !is_new ? ImportRefusal::NoRoom : ImportRefusal::Unwritable)
                        << where << report.reason;
                    EXPECT_TRUE(samples::is_one_line(report.reason)) << report.reason;
                } else { // files that could not be removed stay
                    EXPECT_EQ(text_of(*disk), new_text) << where;
                }
                disk->cut_power(64, static_cast<unsigned>(operation),
                                [&](VolatileDisk& left) { expect_old_or_new(left, where); });
                if (error == EIO) {
                    expect_new_after_import(*disk, where);
                }
            }
        }
    }
}

TEST_F(PowerCut, APulledStickLeavesTheOldSet) {
    const int all = stick.operations;
    for (const int error : {EIO, ENODEV, ENXIO, ENODATA}) {
        for (int operation = 0; operation < all; ++operation) {
            const std::string where = fmt::format("error {} at operation {}", error, operation);
            const auto disk = before.copy();
            const auto pulled = stick.copy();
            pulled->plan = {FaultPlan::never, operation, FaultPlan::never, error, false};
            const ImportReport report = import_quietly(*pulled, *disk, request);
            EXPECT_EQ(report.stage, ImportStage::Failed) << where;
            EXPECT_EQ(report.refusal, ImportRefusal::Unreadable) << where;
            EXPECT_TRUE(samples::is_one_line(report.reason)) << report.reason;
            EXPECT_EQ(text_of(*disk), old_text) << where;
            EXPECT_EQ(inspector.fault_of(*disk), "") << where;
            for (const ImportedPack& pack : report.packs) {
                EXPECT_NE(pack.outcome, ImportOutcome::Taken) << where;
                EXPECT_NE(pack.outcome, ImportOutcome::Pending) << where;
            }
            if (error == EIO) {
                expect_new_after_import(*disk, where);
            }
        }
    }
}

/// Any of these contents may be returned by any read.
TEST_F(PowerCut, AChangingStickInstallsOnlyVerifiedPacks) {
    const Bytes right = **stick.content("a.fspack");
    Bytes altered = right;
    altered[altered.size() / 2] ^= std::byte{1};
    const Bytes stranger =
        Museum::signed_by(pack::SecretKey::make(), Museum::unsigned_pack("a", "a 4", 5000), 4);
    // As long as the right one, and older than the installed one.
    const Bytes older = Museum::signed_by(museum.key, Museum::unsigned_pack("a", "a 3", 5000), 1);
    ASSERT_EQ(older.size(), right.size());
    const std::vector<Bytes> others{altered,
                                    older,
                                    Museum::unsigned_pack("a", "a 2", 5000),
                                    stranger,
                                    museum.pack("a", 1),
                                    museum.pack("z", 9, 5000),
                                    Bytes(right.size()),
                                    Bytes()};
    for (const Bytes& other : others) {
        for (int operation = 0; operation < stick.operations; ++operation) {
            const auto disk = before.copy();
            const auto changing = stick.copy();
            changing->before_operation = [&](int number) {
                if (number == operation) {
                    changing->put("a.fspack", other);
                }
            };
            static_cast<void>(import_quietly(*changing, *disk, request));
            EXPECT_EQ(inspector.fault_of(*disk), "");
            for (const InstalledPack& pack : installed(*disk).packs) {
                const Content content = *disk->content(pack.file);
                const auto opened = pack::open_signed_pack(
                    std::span(*content), {request.keys, std::nullopt, pack::UnsignedPacks::Refuse});
                ASSERT_TRUE(opened) << opened.error().error.message;
                EXPECT_EQ(opened->serial(), pack.serial);
                EXPECT_TRUE(pack.id != "a" || pack.serial >= 2) << pack.serial;
                EXPECT_TRUE(pack::verify_pack(*content));
            }
        }
    }
}

} // namespace
} // namespace frustumscreen::library

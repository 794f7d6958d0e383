// The outcome of a stick: taken, already there, refused, removed; and the packs that are kept for the exhibit
// meanwhile.
#include "tests/library/stick_fixture.h"

#include <cerrno>

namespace frustumscreen::library {
namespace {

using namespace testing_disk;

class ImportStick : public StickTest {};

TEST_F(ImportStick, TakesPacksFromTheRootAndOneFolderDown) {
    stick.put("b.FSPACK", museum.pack("b", 1));
    stick.put("folder/a.fspack", museum.pack("a", 7));
    stick.put("folder/._a.fspack", "a twin");
    stick.put(".hidden/x.fspack", museum.pack("x", 1));
    stick.put("$RECYCLE.BIN/y.fspack", museum.pack("y", 1));
    stick.put("System Volume Information/z.fspack", museum.pack("z", 1));
    stick.put(".Trash-1000/u.fspack", museum.pack("u", 1));
    stick.put("lost+found/v.fspack", museum.pack("v", 1));
    stick.put("holiday.jpg", "a picture");
    std::vector<ImportStage> stages;
    ImportEnvironment outside = quiet_environment();
    outside.tell = [&](const ImportReport& report) {
        EXPECT_LE(report.done_bytes, report.total_bytes);
        if (stages.empty() || stages.back() != report.stage) {
            stages.push_back(report.stage);
        }
    };
    const ImportReport report = import_stick(stick, kiosk, request, outside);
    EXPECT_EQ(stages, (std::vector{ImportStage::Found, ImportStage::Copying, ImportStage::MayTakeOut,
                                   ImportStage::Done}));
    ASSERT_EQ(report.packs.size(), 2U);
    EXPECT_EQ(line_of(report, "folder/a.fspack").title, "a 7");
    EXPECT_EQ(line_of(report, "b.FSPACK").outcome, ImportOutcome::Taken);
    EXPECT_EQ(ids(kiosk), (std::vector<std::string>{"b 1", "a 7"}));
    EXPECT_EQ(report.set_number, 1U);
    EXPECT_EQ(report.done_bytes, report.total_bytes);
    EXPECT_EQ(pack_files(), 2U);
}

TEST_F(ImportStick, TheSameStickTwiceChangesNothing) {
    stick.put("a.fspack", museum.pack("a", 1));
    stick.put("plain.fspack", Museum::unsigned_pack("", "no id"));
    museum.put_exhibit(stick, "order = [\"a\"]\n", 3);
    request.unsigned_packs = pack::UnsignedPacks::Allow;
    EXPECT_EQ(line_of(import(), "plain.fspack").outcome, ImportOutcome::Taken);
    const std::string text(as_text(**kiosk.content("set.txt")));
    const ImportReport again = import();
    EXPECT_EQ(again.stage, ImportStage::Done);
    for (const ImportedPack& line : again.packs) {
        EXPECT_EQ(line.outcome, ImportOutcome::AlreadyThere) << line.file;
    }
    EXPECT_EQ(again.total_bytes, 0U);
    EXPECT_EQ(as_text(**kiosk.content("set.txt")), text);
}

TEST_F(ImportStick, APackWhoseInstalledFileIsDamagedIsCopiedAgain) {
    stick.put("a.fspack", museum.pack("a", 1, 3000));
    stick.put("again.fspack", museum.pack("a", 1, 3000));
    import();
    const std::string file = installed(kiosk).packs.at(0).file;
    const Bytes whole = **kiosk.content(file);
    Bytes altered = whole;
    altered[whole.size() / 2] ^= std::byte{1};
    const std::vector<std::optional<Bytes>> damages{std::nullopt, Bytes(), altered,
                                                    Bytes(whole.begin(), whole.end() - 1)};
    for (std::size_t k = 0; k < damages.size(); ++k) {
        if (damages[k]) {
            kiosk.put(file, *damages[k]);
        } else {
            kiosk.take_away(file);
        }
        const ImportReport report = import();
        EXPECT_EQ(report.stage, ImportStage::Done);
        EXPECT_EQ(line_of(report, "a.fspack").outcome, ImportOutcome::Taken) << k;
        EXPECT_NE(line_of(report, "a.fspack").reason.find("damaged or gone"), std::string::npos) << k;
        EXPECT_EQ(line_of(report, "again.fspack").outcome, ImportOutcome::AlreadyThere) << k;
        EXPECT_EQ(report.set_number, k + 2) << "else the exhibit would not open it again";
        ASSERT_TRUE(kiosk.content(file)) << k;
        EXPECT_EQ(**kiosk.content(file), whole);
    }
    EXPECT_EQ(line_of(import(), "a.fspack").outcome, ImportOutcome::AlreadyThere);
    // If the stick's copy is damaged too, the set stays as it is, and the report has no repair.
    kiosk.take_away(file);
    stick.take_away("again.fspack");
    stick.put("a.fspack", with_another_part(whole));
    const ImportReport report = import_quietly(stick, kiosk, request);
    EXPECT_EQ(line_of(report, "a.fspack").refusal, ImportRefusal::Altered);
    EXPECT_EQ(report.set_number, damages.size() + 1);
}

TEST_F(ImportStick, AcceptsAnEmptyStick) {
    EXPECT_EQ(import().stage, ImportStage::Done);
    EXPECT_FALSE(kiosk.content("set.txt"));
}

TEST_F(ImportStick, RefusesUnsignedAndUntrustedPacks) {
    const Bytes plain = Museum::unsigned_pack("a", "a");
    stick.put("a.fspack", plain);
    expect_refused("a.fspack", ImportRefusal::Unsigned, "not signed");
    stick.put("a.fspack", Museum::signed_by(pack::SecretKey::make(), plain, 1));
    expect_refused("a.fspack", ImportRefusal::WrongKey, "not one of those known");
    request.keys[0].until = std::chrono::sys_days(std::chrono::year(2030) / 12 / 31);
    request.today = std::chrono::sys_days(std::chrono::year(2100) / 1 / 1);
    stick.put("a.fspack", museum.pack("a", 1));
    expect_refused("a.fspack", ImportRefusal::WrongKey, "2100-01-01");
    request.today = std::chrono::sys_days(std::chrono::year(1970) / 1 / 1);
    EXPECT_EQ(line_of(import(), "a.fspack").outcome, ImportOutcome::Taken);
}

TEST_F(ImportStick, RefusesAlteredAndInvalidPacks) {
    Bytes bytes = museum.pack("a", 1, 3000);
    stick.put("short.fspack", Bytes(bytes.begin(), bytes.end() - 1));
    stick.put("empty.fspack", Bytes());
    stick.put("text.fspack", "not a ZIP");
    // Their manifest and signature are valid, so the check of the copy must find the damage.
    stick.put("other_part.fspack", with_another_part(bytes));
    bytes[bytes.size() - 2000] ^= std::byte{1};
    stick.put("altered.fspack", bytes);
    const ImportReport report = import();
    EXPECT_EQ(report.stage, ImportStage::Done);
    for (const std::string file : {"short.fspack", "empty.fspack", "text.fspack"}) {
        EXPECT_EQ(line_of(report, file).refusal, ImportRefusal::NotAPack) << file;
    }
    for (const std::string file : {"altered.fspack", "other_part.fspack"}) {
        const ImportedPack& line = line_of(report, file);
        EXPECT_EQ(line.refusal, ImportRefusal::Altered) << file;
        EXPECT_NE(line.reason.find("padding.bin"), std::string::npos) << line.reason;
    }
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{});
    EXPECT_EQ(pack_files(), 0U);
    stick.take_away("altered.fspack");
    stick.put("whole.fspack", museum.pack("a", 1, 3000));
    EXPECT_EQ(line_of(import(), "whole.fspack").outcome, ImportOutcome::Taken) << "of two with one id";
}

TEST_F(ImportStick, NeverTakesALowerSerialThanOnceTaken) {
    stick.put("a.fspack", museum.pack("a", 5));
    import();
    stick.put("a.fspack", museum.pack("a", 4));
    expect_refused("a.fspack", ImportRefusal::Older, "serial 5");
    stick.put("a.fspack", museum.pack("a", 5, 100)); // other contents
    expect_refused("a.fspack", ImportRefusal::Older, "the same serial 5");
    // A pack that was removed cannot come back with an older serial either.
    stick.put("a.fspack", museum.pack("b", 1));
    museum.put_exhibit(stick, "remove = [\"a\"]\n", 1);
    const ImportReport removed = import();
    EXPECT_EQ(line_of(removed, "a").outcome, ImportOutcome::Removed);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"b 1"});
    stick.take_away("exhibit.toml");
    stick.put("a.fspack", museum.pack("a", 4));
    expect_refused("a.fspack", ImportRefusal::Older, "serial 5");
    request.unsigned_packs = pack::UnsignedPacks::Allow;
    stick.put("a.fspack", Museum::unsigned_pack("a", "a"));
    expect_refused("a.fspack", ImportRefusal::Older, "unsigned");
    stick.put("a.fspack", museum.pack("a", 6));
    EXPECT_EQ(line_of(import(), "a.fspack").outcome, ImportOutcome::Taken);
}

TEST_F(ImportStick, TakesTheNewerOfTwoWithOneId) {
    stick.put("1.fspack", museum.pack("a", 1));
    stick.put("2.fspack", museum.pack("a", 3));
    stick.put("3.fspack", museum.pack("a", 2));
    stick.put("4.fspack", museum.pack("a", 3));
    const ImportReport report = import();
    EXPECT_EQ(line_of(report, "1.fspack").refusal, ImportRefusal::Older);
    EXPECT_EQ(line_of(report, "2.fspack").outcome, ImportOutcome::Taken);
    EXPECT_EQ(line_of(report, "3.fspack").refusal, ImportRefusal::Older);
    EXPECT_EQ(line_of(report, "4.fspack").outcome, ImportOutcome::AlreadyThere);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 3"});
}

TEST_F(ImportStick, RefusesAnotherPackWithTheSameSerial) {
    stick.put("1.fspack", museum.pack("a", 3));
    stick.put("2.fspack", museum.pack("a", 3, 100));
    const ImportReport report = import();
    EXPECT_EQ(line_of(report, "1.fspack").outcome, ImportOutcome::Taken);
    EXPECT_EQ(line_of(report, "2.fspack").refusal, ImportRefusal::Older);
    EXPECT_NE(line_of(report, "2.fspack").reason.find("other contents"), std::string::npos);
}

TEST_F(ImportStick, ANewerPackReplacesTheOlderInPlace) {
    for (const std::string id : {"a", "b", "c"}) {
        stick.put(id + ".fspack", museum.pack(id, 1));
    }
    import();
    stick.put("b.fspack", museum.pack("b", 2));
    import();
    EXPECT_EQ(ids(kiosk), (std::vector<std::string>{"a 1", "b 2", "c 1"}));
}

TEST_F(ImportStick, KeepsTheLastGoodSetWhileANewOneIsOnTrial) {
    const auto put = [&](std::uint64_t serial) {
        stick.put("a.fspack", museum.pack("a", serial));
        import();
    };
    put(1);
    judge(kiosk, TrialState::Good);
    put(2);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 2"});
    EXPECT_EQ(pack_files(), 2U);
    judge(kiosk, TrialState::Bad);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 1"}) << "comes back";
    put(2); // put in again by hand
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 2"});
    judge(kiosk, TrialState::Trying, max_starts - 1);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 2"});
    judge(kiosk, TrialState::Trying, max_starts);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 1"}) << "the exhibit does not come up with it";
    put(3);
    judge(kiosk, TrialState::Trying, 1);
    put(4); // while 3 is on trial
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 4"});
    EXPECT_EQ(pack_files(), 3U) << "1 is the last good one, 3 may still be shown";
    judge(kiosk, TrialState::Bad);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 1"});
    put(5);
    judge(kiosk, TrialState::Good);
    put(6);
    EXPECT_EQ(pack_files(), 2U);
}

TEST_F(ImportStick, NeedsRoomForAllOfItAndAMargin) {
    stick.put("a.fspack", museum.pack("a", 1));
    stick.put("b.fspack", museum.pack("b", 1));
    const std::uint64_t needed = (*stick.content("a.fspack"))->size() + (*stick.content("b.fspack"))->size();
    kiosk.free = needed + request.limits.margin_bytes - 1;
    const ImportReport report = import();
    EXPECT_EQ(report.stage, ImportStage::Failed);
    EXPECT_EQ(report.refusal, ImportRefusal::NoRoom);
    EXPECT_EQ(line_of(report, "a.fspack").refusal, ImportRefusal::NoRoom);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{});
    ++kiosk.free;
    EXPECT_EQ(import().stage, ImportStage::Done);
}

TEST_F(ImportStick, AnUnreadableFileOrFolderAffectsOnlyItself) {
    stick.put("a.fspack", museum.pack("a", 1));
    stick.put("closed.fspack", museum.pack("b", 1));
    // Operations: the listing of the root, opening a, the reads of a, opening the other.
    VolatileDisk counted;
    counted.put("a.fspack", museum.pack("a", 1));
    import_quietly(counted, *std::make_unique<VolatileDisk>(), request);
    ASSERT_GE(counted.operations, 4);
    for (int operation = 2; operation < counted.operations; ++operation) {
        const auto closed = stick.copy();
        closed->plan = {FaultPlan::never, operation, operation + 1, EACCES, false};
        VolatileDisk other;
        const ImportReport report = import_quietly(*closed, other, request);
        EXPECT_EQ(report.stage, ImportStage::Done) << operation << report.reason;
        EXPECT_EQ(installed(other).packs.size(), 1U) << operation;
    }
}

TEST_F(ImportStick, ADamagedSetFileIsReportedAndKept) {
    stick.put("a.fspack", museum.pack("a", 1));
    import();
    std::string text(as_text(**kiosk.content("set.txt")));
    text[text.size() / 2] ^= 1;
    kiosk.put("set.txt", text);
    const ImportReport report = import_quietly(stick, kiosk, request);
    EXPECT_EQ(report.refusal, ImportRefusal::Unwritable);
    EXPECT_EQ(pack_files(), 1U) << "nothing is cleared away";
    EXPECT_EQ(as_text(**kiosk.content("set.txt")), text);
}

TEST_F(ImportStick, ReportsASetFileWithAWrongName) {
    for (const std::string name : {"exhibit.toml.txt", "Exhibit.toml", "exhibit.toml.minisig",
                                   "EXHIBIT (1).TOML.minisig", "sets/exhibit.toml"}) {
        VolatileDisk other;
        other.put("a.fspack", museum.pack("a", 1));
        other.put(name, "only = true\n");
        VolatileDisk disk;
        const ImportReport report = import_quietly(other, disk, request);
        EXPECT_EQ(report.stage, ImportStage::Done);
        EXPECT_EQ(line_of(report, "a.fspack").outcome, ImportOutcome::Taken);
        const ImportedPack& line = line_of(report, name);
        EXPECT_EQ(line.outcome, ImportOutcome::Refused);
        EXPECT_NE(line.reason.find("is called exhibit.toml"), std::string::npos) << line.reason;
        EXPECT_TRUE(samples::is_one_line(line.reason));
        museum.put_exhibit(other, "order = [\"a\"]\n", 1);
        EXPECT_EQ(import_quietly(other, disk, request).packs.size(), 2U)
            << "where there is one, others are no matter";
    }
}

} // namespace
} // namespace frustumscreen::library

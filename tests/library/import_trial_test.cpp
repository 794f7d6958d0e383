// The importer's use of the exhibit's verdict: which set is kept, which set to go back to, and which packs may be
// removed.
#include "tests/library/museum.h"

namespace frustumscreen::library {
namespace {

using namespace testing_disk;

class ImportTrial : public ::testing::Test {
protected:
    ImportReport import(const ImportEnvironment& outside = quiet_environment()) {
        ImportReport report = import_stick(stick, kiosk, request, outside);
        EXPECT_EQ(inspector.fault_of(kiosk), "");
        return report;
    }
    void put(std::uint64_t serial) {
        stick.put("a.fspack", museum.pack("a", serial));
        EXPECT_EQ(import().stage, ImportStage::Done);
    }
    SetFile set_file() { return read_set_file(kiosk).value_or(SetFile()); }
    std::vector<std::string> ids() { return ids_of(installed(kiosk)); }
    bool has_file(const InstalledSet& set) { return kiosk.content(set.packs.at(0).file).has_value(); }

    Museum museum;
    ImportRequest request = request_of(museum);
    VolatileDisk stick, kiosk;
    Inspector inspector;
};

TEST_F(ImportTrial, ASetJudgedBadDuringACopyDoesNotReturn) {
    put(1);
    judge(kiosk, TrialState::Good);
    put(2);
    stick.take_away("a.fspack");
    stick.put("b.fspack", museum.pack("b", 1));
    ImportEnvironment outside = quiet_environment();
    outside.tell = [&](const ImportReport& report) {
        if (report.stage == ImportStage::Copying) {
            judge(kiosk, TrialState::Bad);
        }
    };
    const ImportReport report = import(outside);
    EXPECT_EQ(report.stage, ImportStage::Done);
    EXPECT_EQ(line_of(report, "b.fspack").outcome, ImportOutcome::Taken);
    EXPECT_EQ(ids(), (std::vector<std::string>{"a 1", "b 1"}));
    EXPECT_EQ(ids_of(set_file().choice.last_good.value_or(InstalledSet())), std::vector<std::string>{"a 1"});
}

TEST_F(ImportTrial, ASetJudgedGoodDuringACopyIsTheLastGoodOne) {
    put(1);
    judge(kiosk, TrialState::Good);
    put(2);
    stick.put("a.fspack", museum.pack("a", 3));
    ImportEnvironment outside = quiet_environment();
    outside.tell = [&](const ImportReport& report) {
        if (report.stage == ImportStage::Copying) {
            judge(kiosk, TrialState::Good);
        }
    };
    EXPECT_EQ(import(outside).stage, ImportStage::Done);
    EXPECT_EQ(ids_of(set_file().choice.last_good.value_or(InstalledSet())), std::vector<std::string>{"a 2"});
}

TEST_F(ImportTrial, TheLastGoodSetBeforeTheFirstIsEmpty) {
    put(1);
    const SetFile first = set_file();
    ASSERT_TRUE(first.choice.last_good);
    EXPECT_EQ(*first.choice.last_good, InstalledSet());
    judge(kiosk, TrialState::Bad);
    EXPECT_EQ(installed(kiosk), InstalledSet());
    put(2);
    EXPECT_EQ(installed(kiosk).number, 2U);
    EXPECT_EQ(set_file().choice.last_good, InstalledSet());
    judge(kiosk, TrialState::Good);
    put(3);
    EXPECT_EQ(set_file().choice.last_good->number, 2U);
}

TEST_F(ImportTrial, NumbersContinueAfterTheSetWasRemoved) {
    put(1);
    put(2);
    judge(kiosk, TrialState::Bad);
    kiosk.take_away("set.txt");
    put(3);
    EXPECT_EQ(set_file().choice.set.number, 3U);
    EXPECT_EQ(ids(), std::vector<std::string>{"a 3"}) << "the old verdict is not about it";
}

TEST_F(ImportTrial, KeepsTheFilesOfAShownSetOnItsLastTrial) {
    put(1);
    judge(kiosk, TrialState::Good);
    put(2);
    const InstalledSet shown = installed(kiosk);
    judge(kiosk, TrialState::Trying, max_starts);
    put(3);
    EXPECT_TRUE(has_file(shown));
    judge(kiosk, TrialState::Bad);
    put(4);
    EXPECT_FALSE(has_file(shown));
    EXPECT_EQ(set_file().choice.last_good->number, 1U);
}

TEST_F(ImportTrial, DeletesOlderSetsForRoomOnceTheSetIsGood) {
    put(1);
    const InstalledSet oldest = installed(kiosk);
    judge(kiosk, TrialState::Good);
    put(2);
    stick.put("a.fspack", museum.pack("a", 3));
    const std::uint64_t needed = (*stick.content("a.fspack"))->size() + request.limits.margin_bytes;
    kiosk.before_operation = [&](int) { kiosk.free = needed - (has_file(oldest) ? 1 : 0); };
    EXPECT_EQ(import().refusal, ImportRefusal::NoRoom) << "it is on trial";
    EXPECT_TRUE(has_file(oldest));
    judge(kiosk, TrialState::Good);
    EXPECT_EQ(import().stage, ImportStage::Done);
    EXPECT_FALSE(has_file(oldest));
    EXPECT_EQ(ids(), std::vector<std::string>{"a 3"});
    EXPECT_EQ(ids_of(set_file().choice.last_good.value_or(InstalledSet())), std::vector<std::string>{"a 2"});
}

} // namespace
} // namespace frustumscreen::library

// A set file on a stick: taken whole or not at all.
#include "tests/library/stick_fixture.h"

#include <cerrno>

namespace frustumscreen::library {
namespace {

using namespace testing_disk;

class ImportSet : public StickTest {};

TEST_F(ImportSet, ASetFileIsTakenWholeOrNotAtAll) {
    stick.put("a.fspack", museum.pack("a", 1));
    stick.put("b.fspack", Museum::unsigned_pack("b", "b"));
    museum.put_exhibit(stick, "order = [\"a\"]\n", 1);
    const ImportReport torn = import();
    EXPECT_EQ(torn.stage, ImportStage::Failed);
    EXPECT_EQ(torn.refusal, ImportRefusal::Unsigned);
    EXPECT_EQ(line_of(torn, "a.fspack").outcome, ImportOutcome::Refused);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{});
    stick.put("b.fspack", museum.pack("b", 1));
    EXPECT_EQ(import().stage, ImportStage::Done);
    EXPECT_EQ(ids(kiosk), (std::vector<std::string>{"a 1", "b 1"}));
    museum.put_exhibit(stick, "order = [\"a\", \"missing\"]\n", 2);
    EXPECT_NE(import().reason.find("\"missing\""), std::string::npos);
    museum.put_exhibit(stick, "order = [\"a\"]\nonly = true\n", 2);
    EXPECT_NE(import().reason.find("\"b\""), std::string::npos);
    stick.take_away("b.fspack");
    const ImportReport only = import();
    EXPECT_EQ(line_of(only, "b").outcome, ImportOutcome::Removed);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 1"});
    museum.put_exhibit(stick, "order = [\"a\"]\n", 1);
    EXPECT_EQ(import().refusal, ImportRefusal::Older);
    stick.put("exhibit.toml", "order = [\"b\"]\n");
    EXPECT_EQ(import().refusal, ImportRefusal::Altered);
    stick.take_away("exhibit.toml.minisig");
    EXPECT_EQ(import().refusal, ImportRefusal::Unsigned);
}

TEST_F(ImportSet, ASetFileSetsOrderAndAttractTexts) {
    for (const std::string id : {"a", "b", "c"}) {
        stick.put(id + ".fspack", museum.pack(id, 1));
    }
    museum.put_exhibit(stick, "order = [\"c\", \"a\"]\n[attract]\nen = \"Come near\"\nde-ch = \"Grüezi\"\n",
                       1);
    import();
    EXPECT_EQ(ids(kiosk), (std::vector<std::string>{"c 1", "a 1", "b 1"}));
    const std::vector<AttractText> texts{{"de-CH", "Grüezi"}, {"en", "Come near"}};
    EXPECT_EQ(installed(kiosk).attract, texts);
    museum.put_exhibit(stick, "order = [\"b\"]\n", 2);
    import();
    EXPECT_EQ(installed(kiosk).attract, texts) << "left out, they stay";
}

TEST_F(ImportSet, NamesTheFileOnce) {
    museum.put_exhibit(stick, "order = []\nonyl = true\n", 1);
    const ImportReport report = import();
    EXPECT_TRUE(report.reason.starts_with("exhibit.toml:2: ")) << report.reason;
    EXPECT_TRUE(line_of(report, "exhibit.toml").reason.starts_with("line 2: "));
    stick.take_away("exhibit.toml.minisig");
    EXPECT_TRUE(line_of(import(), "exhibit.toml").reason.starts_with("it is not signed"));
}

TEST_F(ImportSet, AnUnreadableFolderFailsTheWholeSet) {
    stick.put("a.fspack", museum.pack("a", 1));
    stick.put("closed/b.fspack", museum.pack("b", 1));
    museum.put_exhibit(stick, "order = [\"a\"]\n", 1);
    const auto closed = stick.copy();
    closed->plan = {FaultPlan::never, 1, 2, EACCES,
                    false}; // the listing of the folder, after that of the root
    const ImportReport report = import_quietly(*closed, kiosk, request);
    EXPECT_EQ(report.stage, ImportStage::Failed);
    EXPECT_EQ(report.refusal, ImportRefusal::Unreadable);
    EXPECT_NE(report.reason.find("closed"), std::string::npos) << report.reason;
    EXPECT_EQ(line_of(report, "a.fspack").outcome, ImportOutcome::Refused);
    EXPECT_EQ(import().stage, ImportStage::Done);
}

TEST_F(ImportSet, OnlyANewerInstalledPackExcusesARefusedOne) {
    stick.put("a.fspack", museum.pack("a", 5));
    import();
    stick.put("b.fspack", museum.pack("b", 1));
    museum.put_exhibit(stick, "order = [\"a\", \"b\"]\n", 1);
    stick.put("a.fspack", museum.pack("a", 5, 100));
    const ImportReport torn = import();
    EXPECT_EQ(torn.stage, ImportStage::Failed);
    EXPECT_EQ(torn.refusal, ImportRefusal::Older);
    EXPECT_NE(torn.reason.find("the same serial 5"), std::string::npos) << torn.reason;
    EXPECT_NE(torn.reason.find("sign it again with a higher serial"), std::string::npos) << torn.reason;
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 5"});
    stick.put("a.fspack", museum.pack("a", 4));
    EXPECT_EQ(import().stage, ImportStage::Done);
    EXPECT_EQ(ids(kiosk), (std::vector<std::string>{"a 5", "b 1"}));
}

TEST_F(ImportSet, RefusesAnotherSetFileWithTheSameSerial) {
    stick.put("a.fspack", museum.pack("a", 1));
    museum.put_exhibit(stick, "order = [\"a\"]\n", 7);
    EXPECT_EQ(import().stage, ImportStage::Done);
    museum.put_exhibit(stick, "order = []\n", 7);
    const ImportReport report = import();
    EXPECT_EQ(report.refusal, ImportRefusal::Older);
    EXPECT_NE(report.reason.find("the same serial 7"), std::string::npos) << report.reason;
    museum.put_exhibit(stick, "order = []\n", 8);
    EXPECT_EQ(import().stage, ImportStage::Done);
}

TEST_F(ImportSet, AFailedSetReportsEveryPackAsRefused) {
    const Bytes a = museum.pack("a", 1);
    stick.put("1.fspack", a);
    stick.put("2.fspack", a);
    stick.put("z.fspack",
              with_another_part(museum.pack("z", 1, 3000))); // detected only after the others were copied
    museum.put_exhibit(stick, "order = [\"a\"]\n", 1);
    const ImportReport report = import();
    EXPECT_EQ(report.stage, ImportStage::Failed);
    EXPECT_EQ(report.refusal, ImportRefusal::Altered);
    for (const ImportedPack& line : report.packs) {
        EXPECT_EQ(line.outcome, ImportOutcome::Refused) << line.file << ": " << line.reason;
    }
}

} // namespace
} // namespace frustumscreen::library

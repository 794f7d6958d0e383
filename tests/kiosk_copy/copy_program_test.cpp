// From one kiosk by a stick to another, with the programs that do it, on real folders: frustumscreen-pack signs,
// frustumscreen report writes, frustumscreen-import takes. Python's zipfile reads what is written.
#include "tests/kiosk_copy/copy_programs.h"

namespace frustumscreen::kiosk_copy {
namespace {

using namespace testing_copy;

TEST_F(CopyProgram, CopiesEverythingToANewKiosk) {
    ask(everything);
    ASSERT_EQ(report_of_a(), 0) << text("err.txt");
    EXPECT_EQ(names_in(place), (std::set<std::string>{"settings.toml", "calibration.toml", "counts.csv",
                                                      "kiosk.fsk", "001-cup.fspack", "002-vase.fspack"}));
    EXPECT_EQ(text(place + "/settings.toml"), text("a/kiosk.toml"));
    EXPECT_NE(text(place + "/counts.csv").find("Amphora"), std::string::npos);
    std::vector<library::ImportedPack> told = import_into("a"); // as the kiosk itself does next
    ASSERT_EQ(told.size(), 3U);
    EXPECT_EQ(told[0].file, "frustumscreen-1a2b3c-2031-05-04-120000");
    EXPECT_EQ(told[0].outcome, library::ImportOutcome::Written);
    EXPECT_EQ(told[1].outcome, library::ImportOutcome::AlreadyThere);

    sign_the_copy();
    told = import_into("b");
    ASSERT_EQ(told.size(), 3U) << text("err.txt");
    EXPECT_EQ(told[0].file, "kiosk.fsk");
    for (const library::ImportedPack& line : told) {
        EXPECT_EQ(line.outcome, library::ImportOutcome::Taken) << line.file << ": " << line.reason;
    }
    EXPECT_EQ(text("b/kiosk.toml"), text("a/kiosk.toml"));
    EXPECT_EQ(text("b/counts/2024-10-04.json"), text("a/counts/2024-10-04.json"));
    EXPECT_EQ(names_in("b/calibration"), names_in("a/calibration"));
    EXPECT_EQ(names_in("b/library/packs"), names_in("a/library/packs"));
    EXPECT_TRUE(std::filesystem::exists(folder / "report/settings-taken"));
    for (const library::ImportedPack& line : import_into("b")) {
        EXPECT_EQ(line.outcome, library::ImportOutcome::AlreadyThere) << line.file << ": " << line.reason;
    }
}

TEST_F(CopyProgram, ArchiveIsCompatibleWithPythonZipfile) {
    ask("what = [\"settings\", \"counts\"]\nuntil = \"2999-12-31\"\n");
    ASSERT_EQ(report_of_a(), 0) << text("err.txt");
    put("read.py",
        "import sys, zipfile\n"
        "z = zipfile.ZipFile(sys.argv[1])\n"
        "assert z.testzip() is None\n"
        "assert z.namelist() == ['format.txt', 'kiosk.toml', 'counts/2024-10-04.json'], z.namelist()\n"
        "assert z.read('kiosk.toml') == open('a/kiosk.toml', 'rb').read()\n"
        "w = zipfile.ZipFile('stick/kiosk.fsk', 'w', zipfile.ZIP_DEFLATED)\n"
        "for name in z.namelist(): w.writestr(name, z.read(name))\n"
        "w.close()\n");
    ASSERT_EQ(
        std::system(fmt::format("cd '{}' && python3 read.py {}/kiosk.fsk", folder.string(), place).c_str()),
        0);
    ASSERT_EQ(run("frustumscreen-pack sign stick/kiosk.fsk --key museum.key"), 0) << text("err.txt");
    EXPECT_EQ(import_into("b").at(0).outcome, library::ImportOutcome::Taken);
    EXPECT_EQ(text("b/kiosk.toml"), text("a/kiosk.toml"));
}

TEST_F(CopyProgram, RejectsAnUnsignedRequest) {
    put("stick/frustumscreen-request.toml", everything);
    EXPECT_EQ(report_of_a(), 1);
    EXPECT_FALSE(std::filesystem::exists(folder / place));
    const std::vector<library::ImportedPack> told = import_into("a");
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].file, "frustumscreen-request.toml");
    EXPECT_EQ(told[0].outcome, library::ImportOutcome::NotWritten);
    EXPECT_EQ(told[0].refusal, library::ImportRefusal::Unsigned);
    EXPECT_NE(told[0].reason.find("frustumscreen-pack sign"), std::string::npos) << told[0].reason;
    // A report, which anybody gets, is written all the same; it has nothing of a copy.
    put("stick/frustumscreen-report.toml", "");
    EXPECT_EQ(report_of_a(), 1);
    EXPECT_EQ(names_in(place).count("kiosk.fsk") + names_in(place).count("settings.toml"), 0U);
    EXPECT_EQ(names_in(place).count("status.txt"), 1U);
}

TEST_F(CopyProgram, WritesReportAndCopyIntoOneFolder) {
    ask(everything);
    put("stick/frustumscreen-report.toml", "");
    EXPECT_EQ(report_of_a(), 0) << text("err.txt");
    const std::set<std::string> names = names_in(place);
    for (const char* name : {"status.txt", "journal.txt", "counts.csv", "kiosk.fsk", "001-cup.fspack"}) {
        EXPECT_EQ(names.count(name), 1U) << name;
    }
    EXPECT_EQ(import_into("a").at(0).outcome, library::ImportOutcome::Written);
}

TEST_F(CopyProgram, DamagedSettingsAllowAReportButNoCopy) {
    put("a/kiosk.toml", "[table\n");
    put("stick/frustumscreen-report.toml", "");
    EXPECT_EQ(report_of_a(), 0) << text("err.txt");
    EXPECT_EQ(names_in(place).count("status.txt"), 1U);
    ask(everything);
    std::filesystem::remove_all(folder / place);
    EXPECT_EQ(report_of_a(), 1) << "whom to believe is not known";
    EXPECT_EQ(names_in(place).count("kiosk.fsk"), 0U);
}

TEST_F(CopyProgram, ReportsAnInterruptedCopy) {
    ask(everything);
    const std::vector<library::ImportedPack> told = import_into("a");
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].file, "frustumscreen-request.toml");
    EXPECT_NE(told[0].reason.find("stopped before"), std::string::npos) << told[0].reason;
}

TEST_F(CopyProgram, FactoryResetWaitsForTheStaff) {
    ask("reset = true\nuntil = \"2999-12-31\"\n");
    EXPECT_EQ(report_of_a(), 0) << "nothing is to be written";
    EXPECT_FALSE(std::filesystem::exists(folder / place));
    const std::vector<library::ImportedPack> told = import_into("a");
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].file, "frustumscreen-request.toml");
    EXPECT_EQ(told[0].outcome, library::ImportOutcome::Pending);
    EXPECT_TRUE(std::filesystem::exists(folder / "report/reset-asked"));
    EXPECT_TRUE(std::filesystem::exists(folder / "a/calibration/calibration-0001.toml"))
        << "nothing is done yet";
}

TEST_F(CopyProgram, FactoryResetNeedsAValidSignedRequest) {
    put("stick/frustumscreen-request.toml", "reset = true\nuntil = \"2999-12-31\"\n");
    EXPECT_EQ(report_of_a(), 1);
    EXPECT_EQ(import_into("a").at(0).outcome, library::ImportOutcome::NotWritten);
    EXPECT_FALSE(std::filesystem::exists(folder / "report/reset-asked"));
    ask("reset = true\nuntil = \"2020-12-31\"\n");
    EXPECT_EQ(report_of_a(), 1);
    EXPECT_EQ(import_into("a").at(0).refusal, library::ImportRefusal::Older);
    EXPECT_FALSE(std::filesystem::exists(folder / "report/reset-asked"));
}

TEST_F(CopyProgram, SuggestsTheCorrectFileNames) {
    put("stick/Frustumscreen-Request.toml.txt", everything);
    put("stick/kiosk (1).fsk", "");
    put("stick/kiosk.fsk.minisig", "");
    put("stick/frustumscreen-kiosk-old/kiosk.fsk", "");
    const std::vector<library::ImportedPack> told = import_into("b");
    ASSERT_EQ(told.size(), 2U);
    EXPECT_NE(told[0].reason.find("frustumscreen-request.toml"), std::string::npos) << told[0].reason;
    EXPECT_NE(told[1].reason.find("kiosk.fsk"), std::string::npos) << told[1].reason;
}

TEST_F(CopyProgram, DoesNotSignInvalidFiles) {
    put("frustumscreen-request.toml", "what = [\"all\"]\n");
    EXPECT_EQ(run("frustumscreen-pack sign frustumscreen-request.toml --key museum.key"), 1);
    put("kiosk.fsk", "no archive");
    EXPECT_EQ(run("frustumscreen-pack sign kiosk.fsk --key museum.key"), 1);
    EXPECT_FALSE(std::filesystem::exists(folder / "kiosk.fsk.minisig"));
}

} // namespace
} // namespace frustumscreen::kiosk_copy

// From one kiosk by a stick to another, with the programs that do it, on real folders: frustumscreen-pack signs,
// frustumscreen report writes, frustumscreen-import takes. Python's zipfile reads what is written.
#include "app/counts/counts_folder.h"
#include "app/library/import_report.h"
#include "app/settings/kept_calibrations.h"
#include "firmware_host/base/disk_tree.h"
#include "tests/kiosk_copy/copies.h"
#include "tests/library/museum.h"
#include "tests/programs/program_folder.h"

#include <set>

namespace frustumscreen::kiosk_copy {
namespace {

using namespace testing_copy;

const std::string everything =
    "what = [\"settings\", \"calibration\", \"counts\", \"packs\"]\nuntil = \"2999-12-31\"\n";
const std::string place = "stick/frustumscreen-1a2b3c-2031-05-04-120000";

class CopyProgram : public programs::ProgramFolder {
protected:
    void SetUp() override {
        for (const char* name :
             {"stick", "report", "a/counts", "a/calibration", "b/counts", "b/calibration"}) {
            std::filesystem::create_directories(folder / name);
        }
        put("museum.key", pack::write_secret_key(museum.key, std::nullopt).value());
        put("a/kiosk.toml", settings_of(museum.key));
        put("b/kiosk.toml", shipped);
        ASSERT_TRUE(counts::keep_day(folder / "a/counts", day(first_day, 3)));
        ASSERT_TRUE(settings::keep_calibration(*open_tree(folder / "a/calibration").value(), calibration(9)));
        for (const std::string id : {"vase", "cup"}) {
            put("packs/" + id + ".fspack", std::string(as_text(museum.pack(id, 7))));
        }
        ASSERT_EQ(run("frustumscreen-import --from packs --into a/library --config a/kiosk.toml"), 0)
            << text("err.txt");
    }
    void ask(const std::string& request) const {
        put("stick/frustumscreen-request.toml", request);
        ASSERT_EQ(run("frustumscreen-pack sign stick/frustumscreen-request.toml --key museum.key"), 0)
            << text("err.txt");
    }
    [[nodiscard]] int report_of_a() const {
        return run(
            "frustumscreen report --into " + place +
            " --stick stick --config a/kiosk.toml --counts a/counts --calibration a/calibration --library "
            "a/library --faults none --id stick1 --outcome report/outcome.json --import-report "
            "report/report.json");
    }
    [[nodiscard]] std::vector<library::ImportedPack> import_into(const std::string& kiosk) const {
        static_cast<void>(run(fmt::format(
            "frustumscreen-import --from stick --into {0}/library --config {0}/kiosk.toml --settings {0} "
            "--calibration {0}/calibration --counts {0}/counts --report report/report.json --stick-report "
            "report/outcome.json",
            kiosk)));
        const Result<library::ImportReport> report = library::parse_import_report(text("report/report.json"));
        EXPECT_TRUE(report) << text("err.txt");
        return report ? report->packs : std::vector<library::ImportedPack>();
    }
    [[nodiscard]] std::set<std::string> names_in(const std::string& name) const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder / name)) {
            names.insert(entry.path().filename());
        }
        return names;
    }
    /// A person's commands at a computer.
    void sign_the_copy() const {
        std::filesystem::remove(folder / "stick/frustumscreen-request.toml");
        std::filesystem::rename(folder / place / "kiosk.fsk", folder / "stick/kiosk.fsk");
        ASSERT_EQ(run("frustumscreen-pack sign stick/kiosk.fsk --key museum.key"), 0) << text("err.txt");
    }
    testing_disk::Museum museum;
    const std::string shipped = "[table]\nwidth_m = 0.9\n";
};

TEST_F(CopyProgram, ANewDiskIsAsTheOldOneWas) {
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

TEST_F(CopyProgram, AnotherProgramReadsTheFileAndWritesOne) {
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

TEST_F(CopyProgram, WithoutASignatureNothingIsGivenAway) {
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

TEST_F(CopyProgram, AReportAndACopyAreInOneFolder) {
    ask(everything);
    put("stick/frustumscreen-report.toml", "");
    EXPECT_EQ(report_of_a(), 0) << text("err.txt");
    const std::set<std::string> names = names_in(place);
    for (const char* name : {"status.txt", "journal.txt", "counts.csv", "kiosk.fsk", "001-cup.fspack"}) {
        EXPECT_EQ(names.count(name), 1U) << name;
    }
    EXPECT_EQ(import_into("a").at(0).outcome, library::ImportOutcome::Written);
}

TEST_F(CopyProgram, DamagedSettingsAreNoObstacleToAReport) {
    put("a/kiosk.toml", "[table\n");
    put("stick/frustumscreen-report.toml", "");
    EXPECT_EQ(report_of_a(), 0) << text("err.txt");
    EXPECT_EQ(names_in(place).count("status.txt"), 1U);
    ask(everything);
    std::filesystem::remove_all(folder / place);
    EXPECT_EQ(report_of_a(), 1) << "whom to believe is not known";
    EXPECT_EQ(names_in(place).count("kiosk.fsk"), 0U);
}

TEST_F(CopyProgram, AKioskThatWasInterruptedSaysSo) {
    ask(everything);
    const std::vector<library::ImportedPack> told = import_into("a");
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].file, "frustumscreen-request.toml");
    EXPECT_NE(told[0].reason.find("stopped before"), std::string::npos) << told[0].reason;
}

TEST_F(CopyProgram, TheStateOfDeliveryWaitsForTheStaff) {
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

TEST_F(CopyProgram, TheStateOfDeliveryNeedsASignature) {
    put("stick/frustumscreen-request.toml", "reset = true\nuntil = \"2999-12-31\"\n");
    EXPECT_EQ(report_of_a(), 1);
    EXPECT_EQ(import_into("a").at(0).outcome, library::ImportOutcome::NotWritten);
    EXPECT_FALSE(std::filesystem::exists(folder / "report/reset-asked"));
    ask("reset = true\nuntil = \"2020-12-31\"\n");
    EXPECT_EQ(report_of_a(), 1);
    EXPECT_EQ(import_into("a").at(0).refusal, library::ImportRefusal::Older);
    EXPECT_FALSE(std::filesystem::exists(folder / "report/reset-asked"));
}

TEST_F(CopyProgram, NearlyRightNamesAreTold) {
    put("stick/Frustumscreen-Request.toml.txt", everything);
    put("stick/kiosk (1).fsk", "");
    put("stick/kiosk.fsk.minisig", "");
    put("stick/frustumscreen-kiosk-old/kiosk.fsk", "");
    const std::vector<library::ImportedPack> told = import_into("b");
    ASSERT_EQ(told.size(), 2U);
    EXPECT_NE(told[0].reason.find("frustumscreen-request.toml"), std::string::npos) << told[0].reason;
    EXPECT_NE(told[1].reason.find("kiosk.fsk"), std::string::npos) << told[1].reason;
}

TEST_F(CopyProgram, WhatTheKioskWouldRefuseIsNotSigned) {
    put("frustumscreen-request.toml", "what = [\"all\"]\n");
    EXPECT_EQ(run("frustumscreen-pack sign frustumscreen-request.toml --key museum.key"), 1);
    put("kiosk.fsk", "no archive");
    EXPECT_EQ(run("frustumscreen-pack sign kiosk.fsk --key museum.key"), 1);
    EXPECT_FALSE(std::filesystem::exists(folder / "kiosk.fsk.minisig"));
}

} // namespace
} // namespace frustumscreen::kiosk_copy

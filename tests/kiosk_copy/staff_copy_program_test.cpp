// A copy by the staff's buttons alone, with the programs that do it, on real folders: what the image's units call before and
// after the button.
#include "tests/kiosk_copy/copy_programs.h"

namespace frustumscreen::kiosk_copy {
namespace {

using namespace testing_copy;

const std::string first = " --id stick7";
const std::string confirmed = first + " --confirmed";

class StaffCopy : public CopyProgram {
protected:
    [[nodiscard]] std::string import_id() const {
        const Result<library::ImportReport> report = library::parse_import_report(text("report/report.json"));
        return report ? report->import_id : std::string();
    }
};

TEST_F(StaffCopy, WritesNothingBeforeConfirmation) {
    put("stick/frustumscreen-request.toml", "");
    EXPECT_EQ(report_of_a(), 0) << text("err.txt");
    EXPECT_FALSE(std::filesystem::exists(folder / place));
    const std::vector<library::ImportedPack> told = import_into("a", first);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0], library::copy_offer());
    EXPECT_EQ(text("report/copy-asked"), "stick7") << "for the script that the button starts";
    EXPECT_FALSE(std::filesystem::exists(folder / "report/reset-asked"));
    // A report, which anybody gets, has nothing of a copy.
    put("stick/frustumscreen-report.toml", "");
    EXPECT_EQ(report_of_a(), 0) << text("err.txt");
    EXPECT_EQ(names_in(place).count("status.txt"), 1U);
    for (const char* name : {"kiosk.fsk", "settings.toml", "calibration.toml", "001-cup.fspack"}) {
        EXPECT_EQ(names_in(place).count(name), 0U) << name;
    }
}

TEST_F(StaffCopy, ConfirmedCopyEqualsASignedOne) {
    put("stick/frustumscreen-request.toml", "");
    ASSERT_EQ(import_into("a", first).size(), 1U);
    ASSERT_EQ(report_of_a(" --confirmed"), 0) << text("err.txt");
    EXPECT_EQ(import_id(), "stick1.staff") << "another import, so that the table tells it";
    const std::vector<library::ImportedPack> told = import_into("a", confirmed);
    EXPECT_EQ(import_id(), "stick7.staff");
    ASSERT_EQ(told.size(), 3U) << "it is not offered once more";
    EXPECT_EQ(told[0].file, std::filesystem::path(place).filename());
    EXPECT_EQ(told[0].outcome, library::ImportOutcome::Written);
    const std::set<std::string> names = names_in(place);
    EXPECT_EQ(names, (std::set<std::string>{"settings.toml", "calibration.toml", "counts.csv", "kiosk.fsk",
                                            "001-cup.fspack", "002-vase.fspack"}));
    std::filesystem::rename(folder / place, folder / "by_buttons");
    ask(everything);
    ASSERT_EQ(report_of_a(), 0) << text("err.txt");
    EXPECT_EQ(names_in(place), names);
    for (const std::string name : {"calibration.toml", "counts.csv", "001-cup.fspack", "002-vase.fspack"}) {
        EXPECT_EQ(text("by_buttons/" + name), text(place + "/" + name)) << name;
    }
}

/// Comments may name people, and the signature does not allow them to leave the kiosk.
TEST_F(StaffCopy, SettingsKeepValuesButNoComments) {
    put("a/kiosk.toml", settings_of(museum.key, "[projector.mount] # Anna's ladder\nx_m = 0.1\ny_m = 0.7\n"
                                                "height_m = 1.4285714285714286\n"));
    put("stick/frustumscreen-request.toml", "");
    ASSERT_EQ(report_of_a(" --confirmed"), 0) << text("err.txt");
    EXPECT_NE(text("a/kiosk.toml").find("Anna"), std::string::npos);
    EXPECT_EQ(text(place + "/settings.toml").find("Anna"), std::string::npos);
    put("read.py", "import tomllib, zipfile, sys\n"
                   "out = zipfile.ZipFile(sys.argv[1] + '/kiosk.fsk').read('kiosk.toml')\n"
                   "assert b'Anna' not in out\n"
                   "assert out == open(sys.argv[1] + '/settings.toml', 'rb').read()\n"
                   "assert tomllib.loads(out.decode()) == tomllib.load(open('a/kiosk.toml', 'rb'))\n");
    EXPECT_EQ(shell("python3 read.py " + place), 0);
}

TEST_F(StaffCopy, KioskWithAKeyAcceptsTheCopyOnlySigned) {
    put("stick/frustumscreen-request.toml", "");
    ASSERT_EQ(report_of_a(" --confirmed"), 0) << text("err.txt");
    std::filesystem::remove(folder / "stick/frustumscreen-request.toml");
    std::filesystem::rename(folder / place / "kiosk.fsk", folder / "stick/kiosk.fsk");
    std::vector<library::ImportedPack> told = import_into("a");
    EXPECT_EQ(told.at(0).file, "kiosk.fsk");
    EXPECT_EQ(told.at(0).refusal, library::ImportRefusal::Unsigned) << "its settings name a key";
    ASSERT_EQ(run("frustumscreen-pack sign stick/kiosk.fsk --key museum.key"), 0) << text("err.txt");
    told = import_into("b");
    EXPECT_EQ(told.at(0).outcome, library::ImportOutcome::Taken) << told.at(0).reason;
    EXPECT_EQ(names_in("b/library/packs"), names_in("a/library/packs"));
}

/// The buttons confirm an empty request, and no other one.
TEST_F(StaffCopy, ConfirmsOnlyAnEmptyRequest) {
    for (const std::string& request : {everything, std::string("\n"), std::string("reset = true\n")}) {
        put("stick/frustumscreen-request.toml", request);
        EXPECT_EQ(report_of_a(" --confirmed"), 1) << request;
        EXPECT_FALSE(std::filesystem::exists(folder / place)) << request;
        const std::vector<library::ImportedPack> told = import_into("a", confirmed);
        ASSERT_EQ(told.size(), 1U);
        EXPECT_EQ(told[0].refusal, library::ImportRefusal::Unsigned) << request;
        EXPECT_FALSE(std::filesystem::exists(folder / "report/copy-asked")) << request;
        EXPECT_FALSE(std::filesystem::exists(folder / "report/reset-asked")) << request;
    }
}

TEST_F(StaffCopy, WorksWithoutAKeyButNotWithDamagedSettings) {
    put("a/kiosk.toml", shipped);
    put("stick/frustumscreen-request.toml", "");
    ASSERT_EQ(report_of_a(" --confirmed"), 0) << text("err.txt");
    EXPECT_EQ(names_in(place).count("kiosk.fsk"), 1U);
    std::filesystem::remove_all(folder / place);
    put("a/kiosk.toml", "[table\n");
    EXPECT_EQ(report_of_a(" --confirmed"), 1);
    EXPECT_EQ(import_into("a", confirmed).at(0).outcome, library::ImportOutcome::NotWritten);
    EXPECT_FALSE(std::filesystem::exists(folder / place));
}

TEST_F(StaffCopy, IsNotOfferedForAnUnwritableStick) {
    put("stick/frustumscreen-request.toml", "");
    library::ImportReport protected_stick;
    protected_stick.stage = library::ImportStage::Done;
    protected_stick.packs = {{.file = "frustumscreen-request.toml",
                              .title = "",
                              .outcome = library::ImportOutcome::NotWritten,
                              .refusal = library::ImportRefusal::Unwritable,
                              .reason = "the stick is write-protected"}};
    put("report/outcome.json", library::write_import_report(protected_stick));
    const std::vector<library::ImportedPack> told = import_into("a", first);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].reason, "the stick is write-protected");
    EXPECT_FALSE(std::filesystem::exists(folder / "report/copy-asked"));
    ASSERT_EQ(import_into("a", confirmed).size(), 1U);
    EXPECT_NE(import_into("a", confirmed)[0].reason.find("stopped before"), std::string::npos)
        << "the writer left no word";
}

TEST_F(StaffCopy, IsNotOfferedIfTheKioskWritesNoSticks) {
    put("stick/frustumscreen-request.toml", "");
    EXPECT_EQ(run("frustumscreen-import --from stick --into a/library --config a/kiosk.toml --report "
                  "report/report.json"),
              0);
    EXPECT_FALSE(std::filesystem::exists(folder / "report/copy-asked"));
    const Result<library::ImportReport> report = library::parse_import_report(text("report/report.json"));
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->packs.empty());
}

} // namespace
} // namespace frustumscreen::kiosk_copy

// `frustumscreen report` and what frustumscreen-import tells of it, on real folders.
#include "app/library/import_report.h"
#include "firmware_host/base/json.h"
#include "tests/programs/program_folder.h"

#include <sys/stat.h>

#include <cstdlib>
#include <map>

namespace frustumscreen::report {
namespace {

const std::string settings =
    "# Anna Schmidt, 030 1234567\n[exhibit]\nlanguage = \"de\"\n[[exhibit.keys]]\nname = "
    "\"Anna's\"\npublic_key = \"RWQf6LRCGA9i53mlYecO4IzT51TGPpvWucNSCh1CBM0QTaLn73Y7GFO3\"\n"
    "[table]\nwidth_m = 0.7\n";

class ReportProgram : public programs::ProgramFolder {
protected:
    void SetUp() override {
        for (const char* name : {"bin", "stick", "report"}) {
            std::filesystem::create_directories(folder / name);
        }
        put("kiosk.toml", settings);
        put("faults", "2 second   \n1 first    \n");
        put("status.json", R"({"import": {"import_id": "stick1", "stick": "ANNAS STICK"}})");
        put_journalctl(
            "#!/bin/sh\necho \"$@\" >journalctl_arguments\necho '10:00 kernel: usb 1-2: SerialNumber: 4C53'\n"
            "echo '10:01 frustumscreen: the amphora is shown'\n");
        path_ = std::getenv("PATH");
        ASSERT_EQ(::setenv("PATH", (folder / "bin").string().append(":").append(path_).c_str(), 1), 0);
    }
    void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }
    void put_journalctl(std::string_view script) const {
        put("bin/journalctl", script);
        ASSERT_EQ(::chmod((folder / "bin/journalctl").c_str(), 0755), 0);
    }
    [[nodiscard]] static std::string command(const std::string& into, const std::string& more = "") {
        return "frustumscreen report --into " + into +
               " --config kiosk.toml --faults faults --counts counts --status-file status.json "
               "--watchdog-file "
               "watchdog.json --journal journal " +
               more;
    }
    [[nodiscard]] std::map<std::string, std::string> files_in(const std::string& name) const {
        std::map<std::string, std::string> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder / name)) {
            files[entry.path().filename()] = text(name + "/" + entry.path().filename().string());
        }
        return files;
    }
    /// The importer's report on the stick.
    [[nodiscard]] std::vector<library::ImportedPack> told() const {
        static_cast<void>(run("frustumscreen-import --from stick --into library --unsigned allow --report "
                              "report/report.json --stick-report report/outcome.json"));
        EXPECT_FALSE(std::filesystem::exists(folder / "report/outcome.json"));
        const Result<library::ImportReport> report = library::parse_import_report(text("report/report.json"));
        EXPECT_TRUE(report) << text("err.txt");
        return report ? report->packs : std::vector<library::ImportedPack>();
    }
    std::string path_;
};

TEST_F(ReportProgram, WritesEveryFileWithoutPersonalData) {
    ASSERT_EQ(run(command("out/report")), 0) << text("err.txt");
    const std::map<std::string, std::string> files = files_in("out/report");
    std::vector<std::string> names;
    for (const auto& [name, content] : files) {
        names.push_back(name);
        for (const char* secret : {"Anna", "ANNA", "4C53", "030", "RWQf"}) {
            EXPECT_EQ(content.find(secret), std::string::npos) << name << " has " << secret;
        }
    }
    EXPECT_EQ(names, (std::vector<std::string>{"faults.txt", "journal.txt", "settings.txt", "status.json",
                                               "status.txt", "version.txt"}));
    EXPECT_EQ(files.at("faults.txt"), "1 first\n2 second\n");
    EXPECT_EQ(files.at("journal.txt"), "10:01 frustumscreen: the amphora is shown\n");
    EXPECT_NE(text("journalctl_arguments").find("--directory=journal"), std::string::npos);
    EXPECT_NE(files.at("settings.txt").find("width_m = 0.7"), std::string::npos);
    EXPECT_NE(files.at("settings.txt").find("language"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(files.at("status.json")).at("runs"), false);
    EXPECT_EQ(run("frustumscreen status --status-file none --watchdog-file none"), 1);
    EXPECT_EQ(files.at("status.txt").substr(0, 12), text("out.txt").substr(0, 12));
    EXPECT_NE(files.at("version.txt").find("FrustumScreen "), std::string::npos);
}

TEST_F(ReportProgram, ReportsAMissingPartAndWritesTheOthers) {
    put("kiosk.toml", "[table\n");
    put_journalctl("#!/bin/sh\necho 'no journal' >&2\nexit 1\n");
    std::filesystem::remove(folder / "faults");
    ASSERT_EQ(run(command("out/report")), 0) << text("err.txt");
    const std::map<std::string, std::string> files = files_in("out/report");
    EXPECT_EQ(files.size(), 6U);
    EXPECT_NE(files.at("settings.txt").find("kiosk.toml:1"), std::string::npos) << files.at("settings.txt");
    EXPECT_NE(files.at("journal.txt").find("no journal"), std::string::npos) << files.at("journal.txt");
    EXPECT_NE(files.at("faults.txt").find("faults"), std::string::npos);
}

TEST_F(ReportProgram, LetsTheImporterReportTheFolder) {
    put("stick/frustumscreen-report.toml", "");
    const std::string place = "stick/frustumscreen-report-2031-05-04-120000";
    ASSERT_EQ(
        run(command(place, "--id stick1 --outcome report/outcome.json --import-report report/report.json")),
        0)
        << text("err.txt");
    const Result<library::ImportReport> meanwhile = library::parse_import_report(text("report/report.json"));
    ASSERT_TRUE(meanwhile);
    EXPECT_EQ(meanwhile->stage, library::ImportStage::Found);
    EXPECT_EQ(meanwhile->import_id, "stick1");
    const std::vector<library::ImportedPack> lines = told();
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].file, "frustumscreen-report-2031-05-04-120000");
    EXPECT_EQ(lines[0].outcome, library::ImportOutcome::Written);
    EXPECT_NE(text("out.txt").find("written"), std::string::npos) << text("out.txt");
}

TEST_F(ReportProgram, ReportsAFullStickAndAReadOnlyOne) {
    put("stick/frustumscreen-report.toml", "");
    for (const auto& [options, refusal] : {std::pair("rw,size=600k", library::ImportRefusal::NoRoom),
                                           std::pair("ro", library::ImportRefusal::Unwritable)}) {
        std::filesystem::create_directories(folder / "place");
        static_cast<void>(
            std::system(fmt::format("cd '{}' && unshare --mount --map-root-user sh -c 'mount -t tmpfs -o {} "
                                    "none place && {}/{}' >out.txt 2>err.txt",
                                    folder.string(), options, bin_dir(),
                                    command("place", "--outcome report/outcome.json"))
                            .c_str()));
        const std::vector<library::ImportedPack> lines = told();
        ASSERT_EQ(lines.size(), 1U) << text("err.txt");
        EXPECT_EQ(lines[0].file, "frustumscreen-report.toml");
        EXPECT_EQ(lines[0].outcome, library::ImportOutcome::NotWritten);
        EXPECT_EQ(lines[0].refusal, refusal) << lines[0].reason;
        EXPECT_NE(text("err.txt").find("not written"), std::string::npos) << text("err.txt");
    }
}

TEST_F(ReportProgram, RejectsInvalidRequestFiles) {
    const std::string name = "stick/frustumscreen-report.toml";
    put(name, "");
    EXPECT_EQ(told().at(0).outcome, library::ImportOutcome::NotWritten) << "the writer has left nothing";
    put(name, "days = 7\nlanguage = \"de\"\n");
    std::vector<library::ImportedPack> lines = told();
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[1].outcome, library::ImportOutcome::Refused);
    EXPECT_NE(lines[1].reason.find("days"), std::string::npos) << lines[1].reason;
    EXPECT_NE(lines[1].reason.find("language"), std::string::npos) << lines[1].reason;
    put(name, std::string(4097, '#'));
    lines = told();
    ASSERT_EQ(lines.size(), 1U) << "it is too large to ask for anything";
    EXPECT_NE(lines[0].reason.find("4096"), std::string::npos);
    std::filesystem::remove(folder / name);
    std::filesystem::create_directory(folder / name);
    EXPECT_NE(told().at(0).reason.find("not a regular file"), std::string::npos);
    std::filesystem::remove(folder / name);
    EXPECT_TRUE(told().empty());
}

TEST_F(ReportProgram, ReportsMisspeltNamesOfTheRequestFile) {
    for (const std::string name : {"frustumscreen-report.toml.txt", "Frustumscreen-Report.toml"}) {
        put("stick/" + name, "");
        const std::vector<library::ImportedPack> lines = told();
        ASSERT_EQ(lines.size(), 1U) << name;
        EXPECT_EQ(lines[0].file, name);
        EXPECT_NE(lines[0].reason.find("is called frustumscreen-report.toml"), std::string::npos)
            << lines[0].reason;
        std::filesystem::remove(folder / "stick" / name);
    }
    // The folder of an earlier report asks for nothing.
    std::filesystem::create_directory(folder / "stick/frustumscreen-report-2031-05-04-120000");
    put("stick/frustumscreen-report-2031-05-04-120000/status.txt", "");
    EXPECT_TRUE(told().empty());
    // Where no report is ever written nothing is told.
    put("stick/frustumscreen-report.toml.txt", "");
    EXPECT_EQ(
        run("frustumscreen-import --from stick --into library --unsigned allow --report report/report.json"),
        0);
    EXPECT_TRUE(library::parse_import_report(text("report/report.json"))->packs.empty());
}

} // namespace
} // namespace frustumscreen::report

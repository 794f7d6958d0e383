/// A kiosk `a` with packs, visits and a calibration, one `b` as shipped, a stick, and the programs that go between them.
#pragma once

#include "app/counts/counts_folder.h"
#include "app/library/import_report.h"
#include "app/library/report_request.h"
#include "app/settings/kept_calibrations.h"
#include "firmware_host/base/disk_tree.h"
#include "tests/kiosk_copy/copies.h"
#include "tests/library/museum.h"
#include "tests/programs/program_folder.h"

#include <set>
#include <string>
#include <vector>

namespace frustumscreen::kiosk_copy {

inline const std::string everything =
    "what = [\"settings\", \"calibration\", \"counts\", \"packs\"]\nuntil = \"2999-12-31\"\n";
inline const std::string place = "stick/frustumscreen-1a2b3c-2031-05-04-120000";

class CopyProgram : public programs::ProgramFolder {
protected:
    void SetUp() override {
        for (const char* name :
             {"stick", "report", "a/counts", "a/calibration", "b/counts", "b/calibration"}) {
            std::filesystem::create_directories(folder / name);
        }
        put("museum.key", pack::write_secret_key(museum.key, std::nullopt).value());
        put("a/kiosk.toml", testing_copy::settings_of(museum.key));
        put("b/kiosk.toml", shipped);
        ASSERT_TRUE(counts::keep_day(folder / "a/counts", testing_copy::day(testing_copy::first_day, 3)));
        ASSERT_TRUE(settings::keep_calibration(*open_tree(folder / "a/calibration").value(),
                                               testing_copy::calibration(9)));
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
    [[nodiscard]] int report_of_a(const std::string& more = "") const {
        return run(
            "frustumscreen report --into " + place + more +
            " --stick stick --config a/kiosk.toml --counts a/counts --calibration a/calibration --library "
            "a/library --faults none --id stick1 --outcome report/outcome.json --import-report "
            "report/report.json");
    }
    [[nodiscard]] std::vector<library::ImportedPack> import_into(const std::string& kiosk,
                                                                 const std::string& more = "") const {
        static_cast<void>(run(fmt::format(
            "frustumscreen-import --from stick --into {0}/library --config {0}/kiosk.toml --settings {0} "
            "--calibration {0}/calibration --counts {0}/counts --report report/report.json --stick-report "
            "report/outcome.json{1}",
            kiosk, more)));
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

} // namespace frustumscreen::kiosk_copy

// Kept calibrations: none is lost, whatever fails, and a bad one never leaves the table dark.
#include "app/settings/kept_calibrations.h"
#include "app/settings/missing_files.h"
#include "firmware_host/base/disk_tree.h"
#include "firmware_host/base/file.h"
#include "tests/base/temporary_folder.h"
#include "tests/base/told.h"
#include "tests/library/volatile_disk.h"
#include "tests/settings/settings_text.h"

#include <cerrno>
#include <limits>
#include <set>

namespace frustumscreen::settings {
namespace {

using testing_disk::Stopped;
using testing_disk::VolatileDisk;

/// A projector in another place than the shipped one; `places` identifies the calibration.
Calibration calibration(int places) {
    Calibration c;
    c.made = "2026-11-25 10:12 UTC";
    c.places = places;
    c.mean_mm = 0.31;
    c.worst_mm = 0.9;
    c.mean_px = 0.7;
    c.pinhole = {1920, 1200, 3601.25, 3598.5, 955.125, 610.0625};
    c.table_from_projector = {glm::dquat(0.01, 1.0, 0.002, -0.003), {0.1, -0.2, 1.0 / 0.7}};
    c.table_from_projector.rotation = glm::normalize(c.table_from_projector.rotation);
    c.registration.table_from_tracker = {glm::normalize(glm::dquat(0.5, 0.5, 0.5, -0.5)),
                                         {-0.5, 0.25, -0.125}};
    c.registration.sensor_from_prop = {{1, 0, 0, 0}, {0.001, -0.002, -0.1}};
    c.registration.eye_in_sensor_m = {0.01, 0.02, 0.03};
    return c;
}

double distance(const geometry::RigidTransform& a, const geometry::RigidTransform& b) {
    return glm::distance(a.translation, b.translation) +
           glm::length(glm::dvec4(a.rotation.w - b.rotation.w, a.rotation.x - b.rotation.x,
                                  a.rotation.y - b.rotation.y, a.rotation.z - b.rotation.z));
}

std::string refusal_of(const std::string& text) {
    const Result<Calibration> read = parse_calibration(text, "c.toml");
    return read ? "" : test::told(read.error());
}

TEST(Calibration, RoundTrip) {
    const Calibration written = calibration(9);
    const Result<Calibration> read = parse_calibration(calibration_text(written), "c.toml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->made, written.made);
    EXPECT_EQ(read->method, CalibrationMethod::Touch);
    EXPECT_EQ(read->places, 9);
    EXPECT_EQ(read->mean_mm, written.mean_mm);
    EXPECT_EQ(read->worst_mm, written.worst_mm);
    EXPECT_EQ(read->mean_px, written.mean_px);
    EXPECT_EQ(read->pinhole.fx, written.pinhole.fx);
    EXPECT_EQ(read->pinhole.cy, written.pinhole.cy);
    constexpr double rounding =
        8.0 * std::numeric_limits<double>::epsilon(); // of the conversion to a matrix and back
    EXPECT_LT(distance(read->table_from_projector, written.table_from_projector), rounding);
    EXPECT_LT(distance(read->registration.table_from_tracker, written.registration.table_from_tracker),
              rounding);
    EXPECT_EQ(read->registration.sensor_from_prop.translation,
              written.registration.sensor_from_prop.translation);
    EXPECT_EQ(read->registration.eye_in_sensor_m, written.registration.eye_in_sensor_m);
}

/// A measured value has no default: without any one line, the message names the missing key.
TEST(Calibration, RefusesAFileWithAMissingLine) {
    const std::string text = calibration_text(calibration(9));
    int lines = 0;
    for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1) {
        const std::string line = text.substr(begin, text.find('\n', begin) - begin);
        const std::size_t equals = line.find(" = ");
        if (equals == std::string::npos) {
            continue;
        }
        const std::string without = text.substr(0, begin) + text.substr(begin + line.size() + 1);
        EXPECT_NE(refusal_of(without).find(line.substr(0, equals) + " is left out"), std::string::npos)
            << line << ": " << refusal_of(without);
        ++lines;
    }
    EXPECT_GE(lines, 17);
    EXPECT_NE(refusal_of(text + "more = 1\n"), "");
    EXPECT_NE(refusal_of(text.substr(0, text.size() / 2)), "");
    EXPECT_NE(refusal_of(std::string(65537, '#')), "");
}

class Kept : public ::testing::Test {
protected:
    /// `places` of the newest whole calibration; 0: there is none.
    static int newest(FileTree& tree) {
        const Result<std::vector<KeptCalibration>> kept = list_calibrations(tree);
        EXPECT_TRUE(kept);
        for (const KeptCalibration& each : *kept) {
            if (const Result<Calibration> read = read_calibration(tree, each)) {
                return read->places;
            }
        }
        return 0;
    }
    std::vector<int> numbers() {
        std::vector<int> all;
        const Result<std::vector<KeptCalibration>> kept = list_calibrations(disk);
        for (const KeptCalibration& each : *kept) {
            all.push_back(each.number);
        }
        return all;
    }
    VolatileDisk disk;
};

TEST_F(Kept, KeepsTheLastThreeAndReadsTheNewest) {
    disk.put("calibration-x.toml", "what nobody wrote");
    for (int k = 1; k <= 5; ++k) {
        ASSERT_TRUE(keep_calibration(disk, calibration(k)));
        EXPECT_EQ(newest(disk), k);
    }
    EXPECT_EQ(numbers(), (std::vector<int>{5, 4, 3}));
    EXPECT_TRUE(disk.content("calibration-x.toml"));
}

TEST_F(Kept, UndoRemovesTheNewestAndItsNumberIsNotReused) {
    EXPECT_EQ(undo_calibration(disk).error().id, "kept.nothing_to_undo");
    for (int k = 1; k <= 4; ++k) {
        ASSERT_TRUE(keep_calibration(disk, calibration(k)));
    }
    EXPECT_EQ(undo_calibration(disk)->number, 4);
    EXPECT_EQ(newest(disk), 3);
    EXPECT_TRUE(
        disk.content("calibration-0004.undone")); // the file remains, so a wrong undo can be reverted by hand
    EXPECT_EQ(keep_calibration(disk, calibration(5))->number, 5);
    EXPECT_EQ(numbers(), (std::vector<int>{5, 3, 2}));
    EXPECT_FALSE(disk.content("calibration-0004.undone"));
}

/// A power cut at each operation: an acknowledged calibration is never lost.
TEST_F(Kept, APowerCutLeavesTheOldOneOrTheNewOne) {
    for (int k = 1; k <= 4; ++k) {
        ASSERT_TRUE(keep_calibration(disk, calibration(k)));
    }
    disk.sync_all();
    std::set<int> keeping, undoing;
    const auto cut = [&](int operation, const auto& act, std::set<int>& seen) {
        const auto stopped = disk.copy();
        stopped->plan.stop_before = stopped->operations + operation;
        bool over = true;
        try {
            act(*stopped);
        } catch (const Stopped&) {
            over = false;
        }
        stopped->plan = {};
        stopped->cut_power(64, static_cast<unsigned>(operation), [&](VolatileDisk& left) {
            const int now = newest(left);
            seen.insert(now);
            const Result<std::vector<KeptCalibration>> kept = list_calibrations(left);
            EXPECT_GE(kept->size(), 2U) << operation;
        });
        return over;
    };
    const auto keep = [](VolatileDisk& tree) { static_cast<void>(keep_calibration(tree, calibration(5))); };
    const auto undo = [](VolatileDisk& tree) { static_cast<void>(undo_calibration(tree)); };
    int operations = 0;
    while (!cut(operations, keep, keeping)) {
        ++operations;
    }
    EXPECT_GT(operations, 5);
    for (int k = 0; !cut(k, undo, undoing); ++k) {
    }
    EXPECT_EQ(keeping, (std::set<int>{4, 5}));
    EXPECT_EQ(undoing, (std::set<int>{3, 4}));
}

/// The disk is full from any operation on: a calibration reported as kept is there; otherwise the previous state
/// is.
TEST_F(Kept, AFullDiskKeepsThePreviousStateAndIsReported) {
    ASSERT_TRUE(keep_calibration(disk, calibration(1)));
    int refused = 0;
    for (int k = 0; k < 20; ++k) {
        const auto full = disk.copy();
        full->plan = {.fail_from = full->operations + k, .fail_to = full->operations + 100, .error = ENOSPC};
        const Result<KeptCalibration> kept = keep_calibration(*full, calibration(2));
        full->plan = {};
        EXPECT_TRUE(newest(*full) == 2 || (!kept && newest(*full) == 1)) << k;
        if (!kept) {
            EXPECT_NE(kept.error().message.find("No space left on device"), std::string::npos)
                << kept.error().message;
            ++refused;
        }
    }
    EXPECT_GT(refused, 5);
}

class Calibrated : public WithTemporaryFolder {
protected:
    void SetUp() override {
        std::filesystem::create_directory(folder / "kept");
        put("kiosk.toml", "[calibration]\nfolder = \"kept\"\n[projector]\nposition_m = [0.0, 0.0, 2.0]\n"
                          "[tracker]\nright_in_sensor = [0, 1, 0]\n");
    }
    void keep(const Calibration& calibration) {
        const Result<std::unique_ptr<WritableTree>> tree = open_tree(folder / "kept");
        ASSERT_TRUE(tree && keep_calibration(**tree, calibration));
    }
    Settings loaded() {
        const Result<CheckedSettings> settings = load_settings(folder / "kiosk.toml");
        EXPECT_TRUE(settings) << settings.error().message;
        return settings ? **settings : Settings();
    }
};

TEST_F(Calibrated, TheNewestReplacesTheDescribedValues) {
    EXPECT_FALSE(loaded().calibration.used);
    EXPECT_EQ(loaded().projector.table_from_projector.translation.z, 2.0);
    keep(calibration(1));
    keep(calibration(2));
    const Settings settings = loaded();
    ASSERT_TRUE(settings.calibration.used);
    EXPECT_EQ(settings.calibration.used->places, 2);
    EXPECT_EQ(settings.calibration.used_name, "calibration-0002.toml");
    EXPECT_EQ(settings.projector.pinhole.fx, 3601.25);
    EXPECT_EQ(settings.projector.table_from_projector.translation.x, 0.1);
    EXPECT_EQ(settings.tracker.registration.table_from_tracker.translation.x, -0.5);
    EXPECT_EQ(settings.tracker.registration.eye_in_sensor_m.z, 0.03);
    EXPECT_EQ(settings.tracker.registration.right_in_sensor, glm::dvec3(0.0, 1.0, 0.0))
        << "no calibration has it";
    EXPECT_EQ(settings.projector.refresh_hz, 60.0);
    EXPECT_TRUE(missing_files(settings).empty());
}

TEST_F(Calibrated, FallsBackFromADamagedOrUnfitCalibration) {
    keep(calibration(1));
    put("kept/calibration-0002.toml", "version = 1\nmade = ");
    Calibration beside = calibration(3);
    beside.table_from_projector.translation.x = 9.0; // the picture misses the table
    put("kept/calibration-0003.toml", calibration_text(beside));
    const Settings settings = loaded();
    ASSERT_TRUE(settings.calibration.used);
    EXPECT_EQ(settings.calibration.used->places, 1);
    const std::vector<std::string> lines = missing_files(settings);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_NE(lines[0].find("calibration-0003.toml: this calibration is not used"), std::string::npos)
        << lines[0];
    EXPECT_NE(lines[0].find("beside the table"), std::string::npos) << lines[0];
    EXPECT_NE(lines[1].find("calibration-0002.toml: this calibration is not used"), std::string::npos)
        << lines[1];
}

/// A calibration corrects a projector that the settings describe wrongly; without it, the settings are refused.
TEST_F(Calibrated, OverridesAWronglyDescribedProjector) {
    put("kiosk.toml", "[calibration]\nfolder = \"kept\"\n[projector]\nposition_m = [8.0, 0.0, 2.0]\n");
    EXPECT_FALSE(load_settings(folder / "kiosk.toml"));
    keep(calibration(1));
    EXPECT_TRUE(loaded().calibration.used);
}

} // namespace
} // namespace frustumscreen::settings

// A copy that a kiosk takes from a stick: what it replaces, what it leaves, and that each thing is the old or the new one
// whenever the power is cut.
#include "app/counts/counts_folder.h"
#include "app/kiosk_copy/take_kiosk_copy.h"
#include "app/library/report_request.h"
#include "app/library/stick_settings.h"
#include "app/settings/kept_calibrations.h"
#include "tests/base/temporary_folder.h"
#include "tests/kiosk_copy/copies.h"
#include "tests/library/volatile_disk.h"

#include <cerrno>

namespace frustumscreen::kiosk_copy {
namespace {

using namespace testing_copy;
using testing_disk::VolatileDisk;

constexpr std::chrono::sys_days today = first_day + std::chrono::days(10);
const std::string shipped = "[table]\nwidth_m = 0.9\n";

class TakeKioskCopy : public WithTemporaryFolder {
protected:
    void SetUp() override {
        std::filesystem::create_directory(folder / "counts");
        settings.put("kiosk.toml", shipped);
    }
    void put_on_stick(const KioskCopy& copy, std::uint64_t serial, const pack::SecretKey& by) {
        const Bytes bytes = write_kiosk_copy(copy).value();
        stick.put(std::string(library::kiosk_copy_name), bytes);
        stick.put("kiosk.fsk.minisig", by.sign(bytes, fmt::format("serial:{}", serial)));
    }
    library::ImportedPack take() {
        const std::optional<library::ImportedPack> line =
            take_kiosk_copy(stick, {settings, calibrations, folder / "counts"}, today);
        EXPECT_TRUE(line && line->file == library::kiosk_copy_name);
        return line.value_or(library::ImportedPack());
    }
    static std::string text_of(const VolatileDisk& disk, const std::string& name) {
        const auto content = disk.content(name);
        return content ? std::string(as_text(**content)) : std::string();
    }
    int places() {
        const auto kept = settings::list_calibrations(calibrations).value();
        return kept.empty() ? 0 : settings::read_calibration(calibrations, kept.front())->places;
    }
    std::uint64_t visits(std::chrono::sys_days which) {
        return counts::open_day(folder / "counts", which)->counts.all().visits;
    }

    pack::SecretKey key = pack::SecretKey::make(), other = pack::SecretKey::make();
    VolatileDisk stick, settings, calibrations;
    KioskCopy copy{
        settings_of(key), settings::calibration_text(calibration(9)), {day(first_day, 3), day(today, 5)}};
};

TEST_F(TakeKioskCopy, NewDiskTakesEverything) {
    put_on_stick(copy, 50, key);
    const library::ImportedPack told = take();
    EXPECT_EQ(told.outcome, library::ImportOutcome::Taken) << told.reason;
    EXPECT_EQ(told.reason, "visits of 1 days, calibration, settings");
    EXPECT_EQ(text_of(settings, "kiosk.toml"), copy.settings);
    EXPECT_EQ(text_of(settings, "kiosk.toml.before"), shipped);
    EXPECT_EQ(text_of(settings, "kiosk.toml.serial"), "50\n");
    EXPECT_EQ(places(), 9);
    EXPECT_EQ(visits(first_day), 3U);
    EXPECT_EQ(visits(today), 0U) << "the exhibit writes today's";
    EXPECT_EQ(take().outcome, library::ImportOutcome::AlreadyThere);
    EXPECT_EQ(settings::list_calibrations(calibrations)->size(), 1U);
}

TEST_F(TakeKioskCopy, RejectsCopiesNotSignedByItsKey) {
    settings.put("kiosk.toml", settings_of(key, "[table]\nwidth_m = 0.8\n"));
    settings.put("kiosk.toml.serial", "50\n");
    put_on_stick(copy, 60, other);
    EXPECT_EQ(take().refusal, library::ImportRefusal::WrongKey);
    put_on_stick(copy, 49, key);
    EXPECT_EQ(take().refusal, library::ImportRefusal::Older);
    stick.take_away("kiosk.fsk.minisig");
    EXPECT_EQ(take().refusal, library::ImportRefusal::Unsigned);
    EXPECT_EQ(places(), 0);
    EXPECT_EQ(visits(first_day), 0U);
    put_on_stick(copy, 50, key);
    EXPECT_EQ(take().outcome, library::ImportOutcome::Taken);
}

TEST_F(TakeKioskCopy, KeepsTheKiosksOwnCounts) {
    ASSERT_TRUE(counts::keep_day(folder / "counts", day(first_day, 8)));
    put_on_stick(copy, 1, key);
    EXPECT_EQ(take().outcome, library::ImportOutcome::Taken);
    EXPECT_EQ(visits(first_day), 8U);
}

TEST_F(TakeKioskCopy, DamagedCopyChangesNothing) {
    Bytes bytes = write_kiosk_copy(copy).value();
    bytes.resize(bytes.size() - 1);
    stick.put(std::string(library::kiosk_copy_name), bytes);
    EXPECT_EQ(take().refusal, library::ImportRefusal::NotAPack);
    copy.settings = "[table]\nwidht_m = 1.0\n"; // settings of another version
    put_on_stick(copy, 1, key);
    const library::ImportedPack told = take();
    EXPECT_EQ(told.refusal, library::ImportRefusal::NotAPack);
    EXPECT_NE(told.reason.find("widht_m"), std::string::npos) << told.reason;
    EXPECT_EQ(text_of(settings, "kiosk.toml"), shipped);
    EXPECT_EQ(places(), 0);
    EXPECT_EQ(visits(first_day), 0U);
}

TEST_F(TakeKioskCopy, KeepsThePriorCalibration) {
    ASSERT_TRUE(settings::keep_calibration(calibrations, calibration(4)));
    put_on_stick(copy, 1, key);
    EXPECT_EQ(take().outcome, library::ImportOutcome::Taken);
    EXPECT_EQ(places(), 9);
    ASSERT_TRUE(settings::undo_calibration(calibrations));
    EXPECT_EQ(places(), 4);
}

TEST_F(TakeKioskCopy, ReportsAFullDiskAndThePartsTakenBefore) {
    put_on_stick(copy, 1, key);
    calibrations.plan = {.fail_from = 0, .error = ENOSPC};
    const library::ImportedPack told = take();
    EXPECT_EQ(told.refusal, library::ImportRefusal::Unwritable);
    EXPECT_NE(told.reason.find("taken before that: visits of 1 days"), std::string::npos) << told.reason;
    EXPECT_EQ(text_of(settings, "kiosk.toml"), shipped);
    calibrations.plan = {};
    EXPECT_EQ(take().outcome, library::ImportOutcome::Taken) << "the same stick is taken again";
    EXPECT_EQ(text_of(settings, "kiosk.toml"), copy.settings);
}

TEST_F(TakeKioskCopy, PowerCutLeavesTheOldOrTheNewFiles) {
    put_on_stick(copy, 50, key);
    const auto settings_before = settings.copy();
    ASSERT_EQ(take().outcome, library::ImportOutcome::Taken);
    ASSERT_GT(settings.operations, 10);
    ASSERT_GT(calibrations.operations, 3);
    int cuts = 0;
    for (int k = 0; k < settings.operations + calibrations.operations; ++k) {
        const bool cuts_settings = k < settings.operations;
        const auto its_settings = settings_before->copy();
        VolatileDisk its_calibrations;
        VolatileDisk& stopped = cuts_settings ? *its_settings : its_calibrations;
        stopped.plan.stop_before = cuts_settings ? k : k - settings.operations;
        EXPECT_THROW(static_cast<void>(
                         take_kiosk_copy(stick, {*its_settings, its_calibrations, folder / "counts"}, today)),
                     testing_disk::Stopped)
            << k;
        cuts += its_settings->cut_power(64, static_cast<unsigned>(k), [&](VolatileDisk& after) {
            const std::string text = text_of(after, "kiosk.toml");
            EXPECT_TRUE(text == shipped || text == copy.settings) << k;
        });
        cuts += its_calibrations.cut_power(64, static_cast<unsigned>(k), [&](VolatileDisk& after) {
            const auto kept = settings::list_calibrations(after).value();
            EXPECT_TRUE(kept.empty() || settings::read_calibration(after, kept.front())) << k;
        });
    }
    EXPECT_GT(cuts, 2 * settings.operations);
}

} // namespace
} // namespace frustumscreen::kiosk_copy

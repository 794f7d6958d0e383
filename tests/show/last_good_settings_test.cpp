#include "app/show/last_good_settings.h"
#include "firmware_host/base/file.h"
#include "firmware_host/service/watchdog_policy.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>

namespace frustumscreen::show {
namespace {

using std::chrono::seconds;

class LastGoodSettings : public WithTemporaryFolder {
protected:
    static RunStatus at(int second, service::Health health = service::Health::Well,
                        std::string_view artifact = "Rings") {
        RunStatus status;
        status.written.monotonic = MonotonicTime(seconds(second));
        status.health = service::word_of(health);
        status.artifact = artifact;
        return status;
    }
    [[nodiscard]] std::string kept() const { return text("kept.toml"); }
};

TEST_F(LastGoodSettings, AreKeptAfterHalfAMinuteWithoutAFault) {
    SettingsKeeper keeper(folder / "kept.toml", "a = 1\n");
    int second = 0;
    for (; second < 20; ++second) {
        keeper.note(at(second));
    }
    keeper.note(at(second++, service::Health::FrozenCode));
    keeper.note(at(second++, service::Health::Well, "")); // the alignment pattern
    const int begin = second;
    for (; second < begin + 30; ++second) {
        keeper.note(at(second));
        EXPECT_EQ(kept(), "");
    }
    keeper.note(at(second));
    EXPECT_EQ(kept(), "a = 1\n");
}

TEST_F(LastGoodSettings, AGapInTheReportsRestartsTheHalfMinute) {
    SettingsKeeper keeper(folder / "kept.toml", "a = 1\n");
    keeper.note(at(0));
    keeper.note(at(40));
    EXPECT_EQ(kept(), "");
}

TEST_F(LastGoodSettings, AreNotWrittenAgainIfUnchanged) {
    put("kept.toml", "a = 1\n");
    const auto before = std::filesystem::last_write_time(folder / "kept.toml") - std::chrono::hours(1);
    std::filesystem::last_write_time(folder / "kept.toml", before);
    const auto show_with = [&](const char* text) {
        SettingsKeeper keeper(folder / "kept.toml", text);
        for (int second = 0; second <= 30; second += 2) {
            keeper.note(at(second));
        }
    };
    show_with("a = 1\n");
    EXPECT_EQ(std::filesystem::last_write_time(folder / "kept.toml"), before);
    show_with("a = 2\n");
    EXPECT_EQ(kept(), "a = 2\n");
}

TEST_F(LastGoodSettings, ResolvePathsAgainstTheKiosksOwnFile) {
    std::filesystem::create_directory(folder / "etc");
    put("etc/kiosk.toml", "not TOML");
    put("kept.toml", "[exhibit]\npacks = [\"a.fspack\"]\n");
    EXPECT_FALSE(use_settings(folder / "etc/kiosk.toml", std::nullopt));
    const Result<UsedSettings> used =
        use_settings(folder / "etc/kiosk.toml", SettingsFallback{folder / "kept.toml", {}});
    ASSERT_TRUE(used) << used.error().message;
    EXPECT_EQ(used->settings->exhibit.packs.front(), folder / "etc/a.fspack");
}

TEST_F(LastGoodSettings, UseTheNewestCalibrationWithOwnOrKeptSettings) {
    const Result<settings::CheckedSettings> plain = settings::parse_settings("", folder / "kiosk.toml");
    ASSERT_TRUE(plain) << plain.error().message;
    settings::Calibration measured;
    measured.made = "2026-11-25 10:12 UTC";
    measured.places = 9;
    measured.pinhole = (*plain)->projector.pinhole;
    measured.pinhole.fx += 7.0;
    measured.table_from_projector = (*plain)->projector.table_from_projector;
    measured.registration = (*plain)->tracker.registration;
    std::filesystem::create_directory(folder / "measured");
    ASSERT_TRUE(write_file(folder / "measured/calibration-0001.toml",
                           as_bytes(settings::calibration_text(measured))));
    const std::string text = "[calibration]\nfolder = \"measured\"\n";
    put("kept.toml", text);
    for (const std::string& own : {text, std::string("not TOML")}) {
        put("kiosk.toml", own);
        const Result<UsedSettings> used =
            use_settings(folder / "kiosk.toml", SettingsFallback{folder / "kept.toml", {}});
        ASSERT_TRUE(used) << used.error().message;
        EXPECT_EQ(used->settings->calibration.used_name, "calibration-0001.toml");
        EXPECT_EQ(used->settings->projector.pinhole.fx, measured.pinhole.fx);
    }
}

} // namespace
} // namespace frustumscreen::show

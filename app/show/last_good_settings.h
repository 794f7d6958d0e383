/// The settings that the exhibit was seen to be good with, kept for the day on which the kiosk's own are spoilt.
///
/// Kept     a copy of the settings' text, once the exhibit has shown an artifact for `long_enough` in one piece with them.
/// Fallback for a kiosk that must show something: the kept copy in place of settings that are wrong, else those that were shipped.
///          Relative paths of the copy are those of the kiosk's own file.
/// Threads  `use_settings` any; the keeper has one caller, which writes files.
/// Errors   as load_settings; the keeper says once that it cannot write.
#pragma once

#include "app/settings/settings.h"
#include "app/show/run_report.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <optional>
#include <string>

namespace frustumscreen {

struct UsedSettings {
    CheckedSettings settings;
    std::string text; ///< of the file that they come from
    std::string
        instead; ///< why they are not those of the kiosk's file, and which they are: a sentence; empty: they are those
};
/// In place of settings that are wrong; an empty path: there are none.
struct SettingsFallback {
    std::filesystem::path last_good, shipped;
};
/// Without a fallback, wrong settings are the error.
[[nodiscard]] Result<UsedSettings> use_settings(const std::filesystem::path& file,
                                                const std::optional<SettingsFallback>& fallback);

class SettingsKeeper {
public:
    static constexpr Nanoseconds long_enough = std::chrono::seconds(30);
    static constexpr Nanoseconds longest_silence = std::chrono::seconds(5);

    SettingsKeeper(std::filesystem::path file, std::string text);
    /// About once a second. Writes once at most, and not if the file has this text already.
    void note(const RunStatus& status);

private:
    std::filesystem::path file_;
    std::string text_;
    std::optional<MonotonicTime> since_; ///< an artifact has been shown well
    MonotonicTime latest_;
    bool is_done_ = false;
};

} // namespace frustumscreen

/// The last settings with which the exhibit worked, kept as a fallback for invalid settings.
///
/// Kept     a copy of the settings' text, once the exhibit has shown an artifact with them for `long_enough` without
///          interruption.
/// Fallback for a kiosk that must show something: the kept copy in place of invalid settings, or else the shipped
///          settings. Relative paths in the copy start from the folder of the kiosk's own file.
/// Threads  `use_settings` any; the keeper has one caller, which writes files.
/// Errors   as load_settings; the keeper reports a failed write once.
#pragma once

#include "app/settings/settings.h"
#include "app/show/run_report.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <optional>
#include <string>

namespace frustumscreen::show {

struct UsedSettings {
    settings::CheckedSettings settings;
    std::string text; ///< of their file
    std::string
        instead; ///< why these are not the kiosk's own, and which they are, as a sentence; empty: its own
};
/// Replacements for invalid settings; an empty path: none.
struct SettingsFallback {
    std::filesystem::path last_good, shipped;
};
/// Without a fallback, invalid settings are an error.
[[nodiscard]] Result<UsedSettings> use_settings(const std::filesystem::path& file,
                                                const std::optional<SettingsFallback>& fallback);

class SettingsKeeper {
public:
    static constexpr Nanoseconds long_enough = std::chrono::seconds(30);
    static constexpr Nanoseconds longest_silence = std::chrono::seconds(5);

    SettingsKeeper(std::filesystem::path file, std::string text);
    /// Call about once a second. Writes at most once, and not if the file already has this text.
    void note(const RunStatus& status);

private:
    std::filesystem::path file_;
    std::string text_;
    std::optional<MonotonicTime> since_; ///< since when an artifact has been shown without a fault
    MonotonicTime latest_;
    bool is_done_ = false;
};

} // namespace frustumscreen::show

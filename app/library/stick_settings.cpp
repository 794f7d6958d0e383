#include "app/library/stick_settings.h"

#include "app/library/import_failure.h"
#include "app/library/own_settings.h"
#include "app/library/stick_pack.h"
#include "app/settings/settings.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace frustumscreen {

namespace {

template <typename T> using Outcome = tl::expected<T, ImportFailure>;

tl::unexpected<ImportFailure> failed(ImportRefusal refusal, std::string reason) {
    return tl::unexpected<ImportFailure>(ImportFailure{refusal, std::move(reason), false});
}

/// Detects a copy that was interrupted: an empty file, or a last line without its end. The signature shows that of
/// a signed file.
std::optional<std::string> fault_of_copy(const SignedText& file) {
    const std::string& text = *file.text;
    if (text.find_first_not_of(" \t\r\n\0\xef\xbb\xbf", 0, 8) == std::string::npos) {
        return fmt::format("{}: it is empty; copy it to the stick again", settings_file_name);
    }
    if (!file.signature && !text.ends_with('\n')) {
        return fmt::format("{}: its last line has no end, as after a copy that was cut off; look at it, "
                           "press Enter after the last line, and copy it again",
                           settings_file_name);
    }
    return std::nullopt;
}

Outcome<ImportOutcome> take(const SignedText& file, WritableTree& folder,
                            std::optional<std::chrono::sys_days> today) {
    const std::string& text = *file.text;
    TRY(const OwnSettings own, read_own_settings(folder));
    const Outcome<std::uint64_t> serial = serial_of_trusted(settings_file_name, file, own, today);
    if (!serial && own.text != text) {
        return tl::unexpected<ImportFailure>(serial.error());
    }
    if (std::optional<std::string> fault = fault_of_copy(file)) {
        return failed(ImportRefusal::NotAPack, *std::move(fault));
    }
    const Result<CheckedSettings> settings = parse_settings(text, settings_file_name);
    if (!settings) {
        return failed(ImportRefusal::NotAPack, settings.error().message);
    }
    const std::uint64_t seen = own.keys.empty()
                                   ? serial_of_first(settings_file_name, file, (*settings)->exhibit.keys)
                                   : serial.value_or(0);
    TRY_VOID(keep_serial(folder, own, seen));
    return replace_settings(folder, own, text);
}

} // namespace

std::optional<ImportedPack> take_settings(FileTree& stick, WritableTree& folder,
                                          std::optional<std::chrono::sys_days> today) {
    ImportedPack told{std::string(settings_file_name), "", {}, {}, ""};
    const Outcome<SignedText> file = read_signed_text(stick, settings_file_name, max_stick_settings_bytes);
    if (file && !file->text) {
        return std::nullopt;
    }
    const Outcome<ImportOutcome> outcome =
        file.and_then([&](const SignedText& found) { return take(found, folder, today); });
    if (outcome) {
        told.outcome = *outcome;
    } else {
        refuse(told, outcome.error());
    }
    return told;
}

} // namespace frustumscreen

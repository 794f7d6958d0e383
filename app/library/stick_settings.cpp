#include "app/library/stick_settings.h"

#include "app/library/import_failure.h"
#include "app/library/signed_text.h"
#include "app/library/stick_pack.h"
#include "app/settings/settings.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/tree_text.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::library {

namespace {

constexpr std::size_t max_serial_bytes = 64;
constexpr std::string_view next_name = "kiosk.toml.new";

template <typename T> using Outcome = tl::expected<T, ImportFailure>;

tl::unexpected<ImportFailure> failed(ImportRefusal refusal, std::string reason) {
    return tl::unexpected<ImportFailure>(
        ImportFailure{.refusal = refusal, .reason = std::move(reason), .whole = false});
}

tl::unexpected<ImportFailure> failed_on_disk(FileFault fault) {
    if (fault.number == ENOSPC || fault.number == EDQUOT) {
        return failed(ImportRefusal::NoRoom, "the kiosk's disk is full; call a technician");
    }
    return tl::unexpected<ImportFailure>(disk_failure(settings_file_name, fault));
}

/// The kiosk's present settings.
struct Own {
    std::string text;                   ///< of kiosk.toml; empty: unreadable
    bool sound = false;                 ///< `text` is valid settings
    std::vector<pack::TrustedKey> keys; ///< named by the settings
    std::uint64_t serial = 0;           ///< the highest that was taken; 0: none
};

/// Nothing if these are no settings.
std::optional<std::vector<pack::TrustedKey>> keys_named_by(const std::string& text) {
    const Result<settings::CheckedSettings> settings = settings::parse_settings(text, settings_file_name);
    return settings && !text.empty() ? std::optional((*settings)->exhibit.keys) : std::nullopt;
}

/// A failing disk must not open the kiosk to any file: if the settings are damaged, their predecessor says which
/// keys count.
Outcome<Own> read_own(WritableTree& folder) {
    Own own;
    own.text = read_text(folder, settings_file_name, max_stick_settings_bytes).value_or("");
    std::optional<std::vector<pack::TrustedKey>> keys = keys_named_by(own.text);
    own.sound = keys.has_value();
    if (!keys) {
        keys = keys_named_by(read_text(folder, settings_before_name, max_stick_settings_bytes).value_or(""));
    }
    if (!keys) {
        return failed(ImportRefusal::Unwritable, "the kiosk's own settings are damaged, so it does not know "
                                                 "which keys to trust; write the image onto its disk anew");
    }
    own.keys = *std::move(keys);
    const FileResult<std::string> serial = read_text(folder, settings_serial_name, max_serial_bytes);
    if (!serial && serial.error().number != ENOENT) {
        return failed_on_disk(serial.error());
    }
    const std::string digits = serial.value_or("0");
    std::from_chars(digits.data(), digits.data() + digits.size(), own.serial);
    return own;
}

/// The serial of a trusted file, which is not parsed; 0 if no signature is needed.
Outcome<std::uint64_t> believe(const SignedText& file, const Own& own,
                               std::optional<std::chrono::sys_days> today) {
    if (own.keys.empty()) {
        return 0;
    }
    TRY(const pack::Signer signer, signer_of(settings_file_name, file, own.keys, today));
    if (signer.serial < own.serial) {
        return tl::unexpected<ImportFailure>(lower_serial(settings_file_name, signer.serial, own.serial));
    }
    return signer.serial;
}

/// The serial of settings that needed no signature but are signed with one of their own keys: older ones are
/// refused afterwards.
std::uint64_t serial_of_first(const SignedText& file, const settings::CheckedSettings& settings) {
    const Outcome<pack::Signer> signer =
        signer_of(settings_file_name, file, settings->exhibit.keys, std::nullopt);
    return signer ? signer->serial : 0;
}

/// Comes before the settings: after a power cut between the two, the old settings stand, and the same stick is
/// taken again.
FileResult<void> keep_serial(WritableTree& folder, std::uint64_t serial, const Own& own) {
    if (serial <= own.serial) {
        return {};
    }
    return replace_text(folder, settings_serial_name, next_name, fmt::format("{}\n", serial)).and_then([&] {
        return folder.sync_folder("");
    });
}

/// Keeps what the kiosk goes back to. Settings that were not proved yet do not replace those that were: two bad
/// sticks in a row lead back to the last good settings.
FileResult<void> keep_before(WritableTree& folder, const Own& own) {
    if (!own.sound) {
        return {}; // damaged settings are nothing to go back to
    }
    const auto text_of = [&](std::string_view name) {
        return read_text(folder, name, max_stick_settings_bytes).value_or("");
    };
    const bool is_proved = text_of(settings_proved_name) == own.text;
    const bool has_before = keys_named_by(text_of(settings_before_name)).has_value();
    if (has_before && !is_proved) {
        return {};
    }
    return replace_text(folder, settings_before_name, next_name, own.text).and_then([&] {
        return folder.sync_folder("");
    });
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
    TRY(const Own own, read_own(folder));
    const Outcome<std::uint64_t> serial = believe(file, own, today);
    if (!serial && own.text != text) {
        return tl::unexpected<ImportFailure>(serial.error());
    }
    if (std::optional<std::string> fault = fault_of_copy(file)) {
        return failed(ImportRefusal::NotAPack, *std::move(fault));
    }
    const Result<settings::CheckedSettings> settings = settings::parse_settings(text, settings_file_name);
    if (!settings) {
        return failed(ImportRefusal::NotAPack, settings.error().message);
    }
    const std::uint64_t seen = own.keys.empty() ? serial_of_first(file, *settings) : serial.value_or(0);
    if (const FileResult<void> kept = keep_serial(folder, seen, own); !kept) {
        return failed_on_disk(kept.error());
    }
    if (own.text == text) {
        return ImportOutcome::AlreadyThere;
    }
    const FileResult<void> replaced = keep_before(folder, own).and_then([&] {
        return replace_text(folder, settings_file_name, next_name, text);
    });
    if (!replaced) {
        return failed_on_disk(replaced.error());
    }
    if (!folder.sync_folder("")) {
        return failed(ImportRefusal::Unwritable,
                      "the new settings are there, but a power cut may bring the old ones back, because the "
                      "kiosk's disk fails; call a technician");
    }
    return ImportOutcome::Taken;
}

} // namespace

std::optional<ImportedPack> take_settings(FileTree& stick, WritableTree& folder,
                                          std::optional<std::chrono::sys_days> today) {
    ImportedPack told{
        .file = std::string(settings_file_name), .title = "", .outcome = {}, .refusal = {}, .reason = ""};
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

} // namespace frustumscreen::library

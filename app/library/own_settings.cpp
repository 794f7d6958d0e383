#include "app/library/own_settings.h"

#include "app/library/stick_settings.h"
#include "app/settings/settings.h"
#include "firmware_host/base/tree_text.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <utility>

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

/// Nothing if these are no settings.
std::optional<std::vector<pack::TrustedKey>> keys_named_by(const std::string& text) {
    const Result<settings::CheckedSettings> settings = settings::parse_settings(text, settings_file_name);
    return settings && !text.empty() ? std::optional((*settings)->exhibit.keys) : std::nullopt;
}

/// Keeps what the kiosk goes back to. Settings that were not proved yet do not replace those that were: two bad
/// sticks in a row lead back to the last good settings.
FileResult<void> keep_before(WritableTree& folder, const OwnSettings& own) {
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

} // namespace

/// A failing disk must not open the kiosk to any file: if the settings are damaged, their predecessor says which
/// keys count.
Outcome<OwnSettings> read_own_settings(WritableTree& folder) {
    OwnSettings own;
    own.text = read_text(folder, settings_file_name, max_stick_settings_bytes).value_or("");
    std::optional<std::vector<pack::TrustedKey>> keys = keys_named_by(own.text);
    own.sound = keys.has_value();
    if (!keys) {
        keys = keys_named_by(read_text(folder, settings_before_name, max_stick_settings_bytes).value_or(""));
    }
    if (!keys) {
        return failed(ImportRefusal::Unwritable, "the kiosk's own settings are damaged, so it does not know "
                                                 "which keys to trust; write the image onto its disk again");
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

Outcome<std::uint64_t> serial_of_trusted(std::string_view name, const SignedText& file,
                                         const OwnSettings& own, std::optional<std::chrono::sys_days> today) {
    if (own.keys.empty()) {
        return 0;
    }
    TRY(const pack::Signer signer, signer_of(name, file, own.keys, today));
    if (signer.serial < own.serial) {
        return tl::unexpected<ImportFailure>(lower_serial(name, signer.serial, own.serial));
    }
    return signer.serial;
}

std::uint64_t serial_of_first(std::string_view name, const SignedText& file,
                              std::span<const pack::TrustedKey> brought) {
    const Outcome<pack::Signer> signer = signer_of(name, file, brought, std::nullopt);
    return signer ? signer->serial : 0;
}

Outcome<void> keep_serial(WritableTree& folder, const OwnSettings& own, std::uint64_t serial) {
    if (serial <= own.serial) {
        return {};
    }
    const FileResult<void> kept =
        replace_text(folder, settings_serial_name, next_name, fmt::format("{}\n", serial)).and_then([&] {
            return folder.sync_folder("");
        });
    return kept ? Outcome<void>() : failed_on_disk(kept.error());
}

Outcome<ImportOutcome> replace_settings(WritableTree& folder, const OwnSettings& own, std::string_view text) {
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

} // namespace frustumscreen::library

#include "app/library/stick_settings.h"

#include "app/library/import_failure.h"
#include "app/library/stick_pack.h"
#include "app/library/tree_text.h"
#include "app/pack/limits.h"
#include "app/settings/settings.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen {

namespace {

constexpr std::size_t most_serial_bytes = 64;
constexpr std::string_view next_name = "kiosk.toml.new";

template <typename T> using Outcome = tl::expected<T, ImportFailure>;

tl::unexpected<ImportFailure> failed(ImportRefusal refusal, std::string reason) {
    return tl::unexpected<ImportFailure>(ImportFailure{refusal, std::move(reason), false});
}

tl::unexpected<ImportFailure> failed_on_disk(FileFault fault) {
    if (fault.number == ENOSPC || fault.number == EDQUOT) {
        return failed(ImportRefusal::NoRoom, "the kiosk's disk is full; call a technician");
    }
    return tl::unexpected<ImportFailure>(disk_failure(settings_file_name, fault));
}

/// Nothing: there is no such file.
Outcome<std::optional<std::string>> read_from_stick(FileTree& stick, std::string_view name,
                                                    std::size_t most_bytes) {
    FileResult<std::string> text = read_text(stick, name, most_bytes);
    if (text) {
        return *std::move(text);
    }
    if (text.error().number == ENOENT) {
        return std::optional<std::string>();
    }
    if (text.error().number == EFBIG) {
        return failed(ImportRefusal::NotAPack,
                      fmt::format("{}: it is too large; allowed are at most {} bytes", name, most_bytes));
    }
    return tl::unexpected<ImportFailure>(stick_failure(name, text.error()));
}

/// What the kiosk has now.
struct Own {
    std::string text;             ///< of kiosk.toml; empty: it cannot be read
    std::vector<TrustedKey> keys; ///< that its settings name
    std::uint64_t serial = 0;     ///< the highest that was taken; 0: none
};

/// Nothing: these are no settings.
std::optional<std::vector<TrustedKey>> keys_named_by(const std::string& text) {
    const Result<CheckedSettings> settings = parse_settings(text, settings_file_name);
    return settings && !text.empty() ? std::optional((*settings)->exhibit.keys) : std::nullopt;
}

/// Settings that a failing disk has spoilt do not open the door: then those of before say whom to believe.
Outcome<Own> read_own(WritableTree& folder) {
    Own own;
    own.text = read_text(folder, settings_file_name, most_stick_settings_bytes).value_or("");
    std::optional<std::vector<TrustedKey>> keys = keys_named_by(own.text);
    if (!keys) {
        keys = keys_named_by(read_text(folder, settings_before_name, most_stick_settings_bytes).value_or(""));
    }
    if (!keys) {
        return failed(ImportRefusal::Unwritable,
                      "the kiosk's own settings are damaged, so it does not know whom to believe; write the "
                      "image onto its disk anew");
    }
    own.keys = *std::move(keys);
    const FileResult<std::string> serial = read_text(folder, settings_serial_name, most_serial_bytes);
    if (!serial && serial.error().number != ENOENT) {
        return failed_on_disk(serial.error());
    }
    const std::string digits = serial.value_or("0");
    std::from_chars(digits.data(), digits.data() + digits.size(), own.serial);
    return own;
}

/// Whether these bytes may be believed: their serial, 0 where nobody has to sign. Nothing of them is parsed.
Outcome<std::uint64_t> believe(const std::string& text, const std::optional<std::string>& signature,
                               const Own& own, std::optional<std::chrono::sys_days> today) {
    if (own.keys.empty()) {
        return 0;
    }
    if (!signature) {
        return failed(ImportRefusal::Unsigned,
                      fmt::format("{}: it is not signed, as no {} lies beside it; sign it with "
                                  "frustumscreen-pack sign, and put both on the stick",
                                  settings_file_name, settings_signature_name));
    }
    const tl::expected<Signer, SignatureRefusal> signer =
        check_signature(as_bytes(text), *signature, own.keys, today);
    if (!signer) {
        ImportFailure failure = failure_of(signer.error());
        failure.reason = fmt::format("{}: {}", settings_file_name, failure.reason);
        return tl::unexpected<ImportFailure>(std::move(failure));
    }
    if (signer->serial < own.serial) {
        return failed(ImportRefusal::Older,
                      fmt::format("{}: its serial {} is lower than that of the settings that were taken "
                                  "last, {}; sign it anew to go back to it",
                                  settings_file_name, signer->serial, own.serial));
    }
    return signer->serial;
}

/// Of settings that nobody had to sign, and that one of their own keys has signed all the same: older ones are refused from then on.
std::uint64_t serial_of_first(const std::string& text, const std::optional<std::string>& signature,
                              const CheckedSettings& settings) {
    const tl::expected<Signer, SignatureRefusal> signer =
        check_signature(as_bytes(text), signature, settings->exhibit.keys, std::nullopt);
    return signer ? signer->serial : 0;
}

/// The serial first: a power cut between the two leaves the old settings, and the same stick is taken again.
FileResult<void> keep_serial(WritableTree& folder, std::uint64_t serial, const Own& own) {
    if (serial <= own.serial) {
        return {};
    }
    return replace_text(folder, settings_serial_name, next_name, fmt::format("{}\n", serial)).and_then([&] {
        return folder.sync_folder("");
    });
}

FileResult<void> keep_before(WritableTree& folder, const Own& own) {
    if (!keys_named_by(own.text)) {
        return {}; // what is spoilt is nothing to go back to
    }
    return replace_text(folder, settings_before_name, next_name, own.text).and_then([&] {
        return folder.sync_folder("");
    });
}

Outcome<ImportOutcome> take(FileTree& stick, const std::string& text, WritableTree& folder,
                            std::optional<std::chrono::sys_days> today) {
    const auto signature = read_from_stick(stick, settings_signature_name, pack_format::most_signature_bytes);
    if (!signature) {
        return tl::unexpected<ImportFailure>(signature.error());
    }
    const Outcome<Own> own = read_own(folder);
    if (!own) {
        return tl::unexpected<ImportFailure>(own.error());
    }
    const Outcome<std::uint64_t> serial = believe(text, *signature, *own, today);
    if (!serial && own->text != text) {
        return tl::unexpected<ImportFailure>(serial.error());
    }
    const Result<CheckedSettings> settings = parse_settings(text, settings_file_name);
    if (!settings) {
        return failed(ImportRefusal::NotAPack, settings.error().message);
    }
    const std::uint64_t seen =
        own->keys.empty() ? serial_of_first(text, *signature, *settings) : serial.value_or(0);
    if (const FileResult<void> kept = keep_serial(folder, seen, *own); !kept) {
        return failed_on_disk(kept.error());
    }
    if (own->text == text) {
        return ImportOutcome::AlreadyThere;
    }
    const FileResult<void> replaced = keep_before(folder, *own).and_then([&] {
        return replace_text(folder, settings_file_name, next_name, text);
    });
    if (!replaced) {
        return failed_on_disk(replaced.error());
    }
    if (!folder.sync_folder("")) {
        return failed(ImportRefusal::Unwritable,
                      "the new settings are there, but a power cut may bring the "
                      "old ones back, as the kiosk's disk fails; call a technician");
    }
    return ImportOutcome::Taken;
}

} // namespace

std::optional<ImportedPack> take_settings(FileTree& stick, WritableTree& folder,
                                          std::optional<std::chrono::sys_days> today) {
    ImportedPack told{std::string(settings_file_name), "", {}, {}, ""};
    const auto text = read_from_stick(stick, settings_file_name, most_stick_settings_bytes);
    if (text && !*text) {
        return std::nullopt;
    }
    const Outcome<ImportOutcome> outcome = text.and_then(
        [&](const std::optional<std::string>& found) { return take(stick, *found, folder, today); });
    if (outcome) {
        told.outcome = *outcome;
    } else {
        refuse(told, outcome.error());
    }
    return told;
}

} // namespace frustumscreen

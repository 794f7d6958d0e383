#include "app/library/signed_exhibit_file.h"

#include "app/pack/limits.h"
#include "firmware_host/base/calendar_day.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <utility>

namespace frustumscreen {

namespace {

tl::unexpected<ImportFailure> failed(ImportFailure failure) {
    failure.whole = true;
    return tl::unexpected<ImportFailure>(std::move(failure));
}

/// Nothing: there is no such file.
tl::expected<std::optional<std::string>, ImportFailure> read_text(FileTree& stick, std::string_view path,
                                                                  std::size_t most_bytes) {
    const FileResult<std::unique_ptr<const FileContent>> file = stick.open(std::string(path));
    if (!file) {
        return file.error().number == ENOENT ? tl::expected<std::optional<std::string>, ImportFailure>()
                                             : failed(stick_failure(path, file.error()));
    }
    if ((*file)->bytes() > most_bytes) {
        return failed(
            {ImportRefusal::NotAPack,
             fmt::format("{}: is {} bytes; allowed are at most {}", path, (*file)->bytes(), most_bytes),
             true});
    }
    std::string text((*file)->bytes(), '\0');
    if (const int fault = (*file)->read(0, std::as_writable_bytes(std::span(text))); fault != 0) {
        return failed(stick_failure(path, {fault}));
    }
    return text;
}

tl::expected<std::uint64_t, ImportFailure>
serial_of(const std::string& text, const std::optional<std::string>& signature, const PackTrust& trust) {
    if (!signature && trust.unsigned_packs == UnsignedPacks::Allow) {
        return 0;
    }
    const tl::expected<Signer, SignatureRefusal> signer = check_signature(
        as_bytes(text), signature ? std::optional<std::string_view>(*signature) : std::nullopt, trust.keys,
        trust.today);
    if (!signer) {
        ImportFailure failure = failure_of(signer.error());
        failure.reason = fmt::format("{}: {}", exhibit_file_name, failure.reason);
        return failed(std::move(failure));
    }
    return signer->serial;
}

} // namespace

tl::expected<SignedExhibitFile, ImportFailure>
read_signed_exhibit_file(FileTree& stick, const PackTrust& trust, std::uint64_t highest) {
    const auto text = read_text(stick, exhibit_file_name, most_exhibit_file_bytes);
    if (!text) {
        return failed(text.error());
    }
    const auto signature = read_text(stick, exhibit_signature_name, pack_format::most_signature_bytes);
    if (!signature) {
        return failed(signature.error());
    }
    const tl::expected<std::uint64_t, ImportFailure> serial =
        serial_of(text->value_or(""), *signature, trust);
    if (!serial) {
        return failed(serial.error());
    }
    if (*serial < highest) {
        return failed({ImportRefusal::Older,
                       fmt::format("{}: its serial {} is lower than that of the one that was taken last, {}; "
                                   "sign it anew to go back to it",
                                   exhibit_file_name, *serial, highest),
                       true});
    }
    Result<ExhibitFile> file = parse_exhibit_file(text->value_or(""));
    if (!file) {
        return failed({ImportRefusal::NotAPack, file.error().message, true});
    }
    if (!file->keys.empty() && *serial == 0) {
        return failed(
            {ImportRefusal::Unsigned,
             fmt::format("{}: it brings keys and is unsigned; sign it with a key that the kiosk knows",
                         exhibit_file_name),
             true});
    }
    return SignedExhibitFile{*std::move(file), *serial};
}

void add_carried_keys(const std::vector<CarriedKey>& carried, std::vector<TrustedKey>& keys) {
    for (const CarriedKey& each : carried) {
        const Result<PublicKey> key = parse_public_key(each.public_key);
        const std::optional<std::chrono::sys_days> until = parse_day(each.until);
        if (key && (until || each.until.empty())) {
            keys.push_back({each.name, *key, until});
        }
    }
}

void remember(SetFile& known, const std::vector<StickPack>& packs,
              const std::optional<SignedExhibitFile>& exhibit) {
    for (const StickPack& each : packs) {
        if (each.told.outcome != ImportOutcome::Taken || each.pack.id.empty() || each.pack.serial == 0) {
            continue;
        }
        const auto place =
            std::find_if(known.serials.begin(), known.serials.end(),
                         [&](const AcceptedSerial& serial) { return serial.id == each.pack.id; });
        if (place == known.serials.end()) {
            known.serials.push_back({each.pack.id, each.pack.serial});
        } else {
            place->serial = std::max(place->serial, each.pack.serial);
        }
    }
    if (!exhibit) {
        return;
    }
    known.exhibit_serial = std::max(known.exhibit_serial, exhibit->serial);
    for (const CarriedKey& key : exhibit->file.keys) {
        const auto place = std::find_if(known.keys.begin(), known.keys.end(), [&](const CarriedKey& other) {
            return other.public_key == key.public_key;
        });
        if (place == known.keys.end()) {
            known.keys.push_back(key);
        } else {
            *place = key;
        }
    }
}

InstalledSet set_to_go_back_to(const SetChoice& choice, const std::optional<SetVerdict>& verdict) {
    const bool is_judged = verdict && verdict->number == choice.set.number;
    if (is_judged && verdict->verdict == Verdict::Good) {
        return choice.set;
    }
    if (choice.last_good) {
        return *choice.last_good;
    }
    return is_judged && verdict->verdict == Verdict::Bad ? InstalledSet() : choice.set;
}

} // namespace frustumscreen

#include "app/library/signed_exhibit_file.h"

#include "app/pack/limits.h"
#include "app/pack/sha256.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

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

/// Nothing: it is unsigned, and allowed.
tl::expected<std::optional<Signer>, ImportFailure>
signer_of(const std::string& text, const std::optional<std::string>& signature, const PackTrust& trust) {
    if (!signature && trust.unsigned_packs == UnsignedPacks::Allow) {
        return std::nullopt;
    }
    if (!signature) {
        return failed({ImportRefusal::Unsigned,
                       fmt::format("{}: it is not signed, as no {} lies beside it; sign it with "
                                   "frustumscreen-pack sign, and put both on the stick",
                                   exhibit_file_name, exhibit_signature_name),
                       true});
    }
    tl::expected<Signer, SignatureRefusal> signer =
        check_signature(as_bytes(text), *signature, trust.keys, trust.today);
    if (!signer) {
        ImportFailure failure = failure_of(signer.error());
        failure.reason = fmt::format("{}: {}", exhibit_file_name, failure.reason);
        return failed(std::move(failure));
    }
    return *std::move(signer);
}

/// Errors: another one that counts was taken before.
tl::expected<void, ImportFailure> weigh(const SignedExhibitFile& exhibit, const SetFile& known) {
    if (exhibit.serial() < known.exhibit_serial) {
        return failed({ImportRefusal::Older,
                       fmt::format("{}: its serial {} is lower than that of the one that was taken last, {}; "
                                   "sign it anew to go back to it",
                                   exhibit_file_name, exhibit.serial(), known.exhibit_serial),
                       true});
    }
    if (exhibit.signer && exhibit.serial() == known.exhibit_serial &&
        exhibit.sha256 != known.exhibit_sha256) {
        return failed({ImportRefusal::Older,
                       fmt::format("{}: it has the same serial {} as the one that was taken last, and other "
                                   "contents; sign it again with a higher serial",
                                   exhibit_file_name, exhibit.serial()),
                       true});
    }
    return {};
}

} // namespace

tl::expected<SignedExhibitFile, ImportFailure>
read_signed_exhibit_file(FileTree& stick, const PackTrust& trust, const SetFile& known) {
    const auto text = read_text(stick, exhibit_file_name, most_exhibit_file_bytes);
    if (!text) {
        return failed(text.error());
    }
    const auto signature = read_text(stick, exhibit_signature_name, pack_format::most_signature_bytes);
    if (!signature) {
        return failed(signature.error());
    }
    const std::string bytes = text->value_or("");
    tl::expected<std::optional<Signer>, ImportFailure> signer = signer_of(bytes, *signature, trust);
    if (!signer) {
        return failed(signer.error());
    }
    SignedExhibitFile exhibit{{}, *std::move(signer), sha256_hex(as_bytes(bytes))};
    if (const auto counts = weigh(exhibit, known); !counts) {
        return failed(counts.error());
    }
    Result<ExhibitFile> file = parse_exhibit_file(bytes);
    if (!file) {
        return failed({ImportRefusal::NotAPack, file.error().message, true});
    }
    if (!file->keys.empty() && !exhibit.signer) {
        return failed(
            {ImportRefusal::Unsigned,
             fmt::format("{}: it brings keys and is unsigned; sign it with a key that the kiosk knows",
                         exhibit_file_name),
             true});
    }
    exhibit.file = *std::move(file);
    return exhibit;
}

} // namespace frustumscreen

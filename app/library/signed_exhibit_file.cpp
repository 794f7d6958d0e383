#include "app/library/signed_exhibit_file.h"

#include "app/library/signed_text.h"
#include "app/pack/container/sha256.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace frustumscreen::library {

namespace {

tl::unexpected<ImportFailure> failed_whole(ImportFailure failure) {
    failure.whole = true;
    return tl::unexpected<ImportFailure>(std::move(failure));
}

/// nullopt: the file is unsigned, which is allowed.
tl::expected<std::optional<pack::Signer>, ImportFailure> signer_of(const SignedText& file,
                                                                   const pack::PackTrust& trust) {
    if (!file.signature && trust.unsigned_packs == pack::UnsignedPacks::Allow) {
        return std::nullopt;
    }
    return signer_of(exhibit_file_name, file, trust.keys, trust.today).map([](pack::Signer signer) {
        return std::optional(std::move(signer));
    });
}

/// Errors: a newer file, or another one of the same serial, was taken before.
tl::expected<void, ImportFailure> weigh(const SignedExhibitFile& exhibit, const SetFile& known) {
    if (exhibit.serial() < known.exhibit_serial) {
        return failed_whole(lower_serial(exhibit_file_name, exhibit.serial(), known.exhibit_serial));
    }
    if (exhibit.signer && exhibit.serial() == known.exhibit_serial &&
        exhibit.sha256 != known.exhibit_sha256) {
        return failed_whole(
            {.refusal = ImportRefusal::Older,
             .reason = fmt::format("{}: it has the same serial {} as the one that was taken last, and other "
                                   "contents; sign it again with a higher serial",
                                   exhibit_file_name, exhibit.serial()),
             .whole = true});
    }
    return {};
}

} // namespace

tl::expected<SignedExhibitFile, ImportFailure>
read_signed_exhibit_file(FileTree& stick, const pack::PackTrust& trust, const SetFile& known) {
    TRY(const SignedText read, read_signed_text(stick, exhibit_file_name, max_exhibit_file_bytes));
    TRY(std::optional<pack::Signer> signer, signer_of(read, trust));
    const std::string bytes = read.text.value_or("");
    SignedExhibitFile exhibit{{}, std::move(signer), pack::sha256_hex(as_bytes(bytes))};
    TRY_VOID(weigh(exhibit, known));
    Result<ExhibitFile> file = parse_exhibit_file(bytes);
    if (!file) {
        return failed_whole(
            {.refusal = ImportRefusal::NotAPack, .reason = file.error().message, .whole = true});
    }
    if (!file->keys.empty() && !exhibit.signer) {
        return failed_whole(
            {.refusal = ImportRefusal::Unsigned,
             .reason =
                 fmt::format("{}: it brings keys and is unsigned; sign it with a key that the kiosk knows",
                             exhibit_file_name),
             .whole = true});
    }
    exhibit.file = *std::move(file);
    return exhibit;
}

} // namespace frustumscreen::library

#include "app/library/signed_text.h"

#include "app/pack/container/limits.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/tree_text.h"

#include <fmt/format.h>

#include <cerrno>
#include <utility>

namespace frustumscreen::library {

namespace {

constexpr std::string_view signature_ending = ".minisig";

/// Nothing if there is no such file.
tl::expected<std::optional<std::string>, ImportFailure>
read_if_there(FileTree& stick, const std::string& name, std::size_t max_bytes) {
    FileResult<std::string> text = read_text(stick, name, max_bytes);
    if (text) {
        return *std::move(text);
    }
    if (text.error().number == ENOENT) {
        return std::optional<std::string>();
    }
    if (text.error().number == EFBIG) {
        return tl::unexpected<ImportFailure>(ImportFailure{
            .refusal = ImportRefusal::NotAPack,
            .reason = fmt::format("{}: it is too large; allowed are at most {} bytes", name, max_bytes),
            .whole = false});
    }
    return tl::unexpected<ImportFailure>(stick_failure(name, text.error()));
}

} // namespace

tl::expected<SignedText, ImportFailure> read_signed_text(FileTree& stick, std::string_view name,
                                                         std::size_t max_bytes) {
    TRY(auto text, read_if_there(stick, std::string(name), max_bytes));
    if (!text) {
        return SignedText();
    }
    TRY(auto signature,
        read_if_there(stick, fmt::format("{}{}", name, signature_ending), pack::max_signature_bytes));
    return SignedText{std::move(text), std::move(signature)};
}

tl::expected<pack::Signer, ImportFailure> signer_of(std::string_view name, const SignedText& file,
                                                    std::span<const pack::TrustedKey> keys,
                                                    std::optional<std::chrono::sys_days> today) {
    if (!file.signature) {
        return tl::unexpected<ImportFailure>(
            ImportFailure{.refusal = ImportRefusal::Unsigned,
                          .reason = fmt::format("{}: it is not signed: no {}{} lies beside it; sign it with "
                                                "frustumscreen-pack sign, and put both on the stick",
                                                name, name, signature_ending),
                          .whole = false});
    }
    return pack::check_signature(as_bytes(file.text.value_or("")), *file.signature, keys, today)
        .map_error([&](const pack::SignatureRefusal& refusal) {
            ImportFailure failure = failure_of(refusal);
            failure.reason = fmt::format("{}: {}", name, failure.reason);
            return failure;
        });
}

ImportFailure lower_serial(std::string_view name, std::uint64_t serial, std::uint64_t latest) {
    return {
        .refusal = ImportRefusal::Older,
        .reason = fmt::format(
            "{}: its serial {} is lower than {}, that of the last one taken; sign it again to go back to it",
            name, serial, latest),
        .whole = false};
}

} // namespace frustumscreen::library

#include "app/pack/signed_pack.h"

#include "app/pack/container/sha256.h"

namespace frustumscreen::pack {

namespace {

tl::unexpected<PackRefusal> refused(const Error& error) {
    const bool unreadable = error.kind == ErrorKind::DeviceLost;
    return tl::unexpected<PackRefusal>(
        PackRefusal{unreadable ? PackRefusal::Why::Unreadable : PackRefusal::Why::NotAPack,
                    SignatureFault::Unsigned, error});
}

tl::expected<SignedPack, PackRefusal> open_zip(Result<ZipReader> zip, const PackTrust& trust) {
    if (!zip) {
        return refused(zip.error());
    }
    const Result<Bytes> manifest = read_manifest_bytes(*zip);
    if (!manifest) {
        return refused(manifest.error());
    }
    const Result<std::optional<std::string>> signature = read_signature_entry(*zip);
    if (!signature) {
        return refused(signature.error());
    }
    std::optional<Signer> signer;
    if (*signature || trust.unsigned_packs == UnsignedPacks::Refuse) {
        tl::expected<Signer, SignatureRefusal> checked =
            check_signature(*manifest, *signature, trust.keys, trust.today);
        if (!checked) {
            return tl::unexpected<PackRefusal>(PackRefusal{PackRefusal::Why::Signature, checked.error().fault,
                                                           std::move(checked.error().error)});
        }
        signer = std::move(*checked);
    }
    Result<PackReader> reader = PackReader::open(*std::move(zip), *manifest);
    if (!reader) {
        return refused(reader.error());
    }
    return SignedPack{std::move(signer), *std::move(reader), sha256_hex(*manifest)};
}

} // namespace

tl::expected<SignedPack, PackRefusal> open_signed_pack(OpenFile file, const PackTrust& trust) {
    if (const Result<void> fits = check_pack_size(file.bytes()); !fits) {
        return refused(fits.error());
    }
    return open_zip(ZipReader::open(std::move(file)), trust);
}

tl::expected<SignedPack, PackRefusal> open_signed_pack(std::span<const std::byte> bytes,
                                                       const PackTrust& trust) {
    if (const Result<void> fits = check_pack_size(bytes.size()); !fits) {
        return refused(fits.error());
    }
    return open_zip(ZipReader::open(bytes), trust);
}

Result<std::optional<SignatureClaim>> claim_of(PackReader& reader) {
    TRY(const std::optional<std::string> signature, reader.signature());
    if (!signature) {
        return std::optional<SignatureClaim>();
    }
    return read_signature_claim(*signature).map([](SignatureClaim&& claim) {
        return std::optional(std::move(claim));
    });
}

} // namespace frustumscreen::pack

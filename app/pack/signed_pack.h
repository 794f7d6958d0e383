/// A pack file of which nothing is used before its signature was right.
///
/// Order    the container's directory, the bytes of `manifest.json` and `signature`; the signature; only then the manifest is
///          parsed, from those same bytes. Parts come from the reader, each held against its hash in that manifest.
/// Memory   bounded before anything is taken: limits.h; the directory has at most 65 535 entries.
/// Threads  one caller.
/// Errors   one sentence that does not begin with the file's name, and why as a value.
#pragma once

#include "app/pack/pack_reader.h"
#include "app/pack/signature/signature.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace frustumscreen {

/// Whom the kiosk believes.
struct PackTrust {
    std::span<const TrustedKey> keys;
    std::optional<std::chrono::sys_days> today; ///< none: no key has ended
    UnsignedPacks unsigned_packs = UnsignedPacks::Refuse;
};

struct PackRefusal {
    enum class Why : std::uint8_t {
        Unreadable, ///< the file could not be read: its stick is broken or was pulled out
        NotAPack,   ///< damaged, or of no known format; beyond a limit
        Signature,  ///< `fault`
    };
    Why why;
    SignatureFault fault; ///< where the signature is why
    Error error;
};

struct SignedPack {
    std::optional<Signer> signer; ///< none: it is unsigned, and allowed
    pack_format::PackReader reader;
    std::string manifest_sha256; ///< of the manifest's bytes, which stand for all that the pack holds

    /// 0: it is unsigned.
    [[nodiscard]] std::uint64_t serial() const { return signer ? signer->serial : 0; }
    [[nodiscard]] const PackDescription& description() const { return reader.manifest().description; }
};

[[nodiscard]] tl::expected<SignedPack, PackRefusal> open_signed_pack(OpenFile file, const PackTrust& trust);
/// `bytes` must outlive the reader.
[[nodiscard]] tl::expected<SignedPack, PackRefusal> open_signed_pack(std::span<const std::byte> bytes,
                                                                     const PackTrust& trust);

/// What an opened pack's signature says, checked or not; nothing if it has none.
[[nodiscard]] Result<std::optional<SignatureClaim>> claim_of(pack_format::PackReader& reader);

} // namespace frustumscreen

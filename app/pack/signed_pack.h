/// A pack file that is not used before its signature is checked.
///
/// Order    reads the container's directory and the bytes of `manifest.json` and `signature`; checks the signature;
///          only then parses the manifest, from the same bytes. Parts come from the reader, each checked against
///          its hash in that manifest.
/// Memory   bounded before anything is read: limits.h; the directory has at most 65 535 entries.
/// Threads  one caller.
/// Errors   one sentence that does not begin with the file's name, and the reason as a value.
#pragma once

#include "app/pack/pack_reader.h"
#include "app/pack/signature/signature.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace frustumscreen::pack {

/// The signatures that the kiosk accepts.
struct PackTrust {
    std::span<const TrustedKey> keys;
    std::optional<std::chrono::sys_days> today; ///< none: no key has expired
    UnsignedPacks unsigned_packs = UnsignedPacks::Refuse;
};

struct PackRefusal {
    enum class Why : std::uint8_t {
        Unreadable, ///< the file could not be read: the stick is broken or was pulled out
        NotAPack,   ///< damaged, of unknown format, or beyond a limit
        Signature,  ///< `fault`
    };
    Why why;
    SignatureFault fault; ///< valid if `why` is Signature
    Error error;
};

struct SignedPack {
    std::optional<Signer> signer; ///< none: unsigned, which is allowed
    PackReader reader;
    std::string manifest_sha256; ///< of the manifest's bytes, which have the hashes of all parts

    /// 0: unsigned.
    [[nodiscard]] std::uint64_t serial() const { return signer ? signer->serial : 0; }
    [[nodiscard]] const PackDescription& description() const { return reader.manifest().description; }
};

[[nodiscard]] tl::expected<SignedPack, PackRefusal> open_signed_pack(OpenFile file, const PackTrust& trust);
/// `bytes` must outlive the reader.
[[nodiscard]] tl::expected<SignedPack, PackRefusal> open_signed_pack(std::span<const std::byte> bytes,
                                                                     const PackTrust& trust);

/// The claims of an open pack's signature, verified or not; nothing if it has none.
[[nodiscard]] Result<std::optional<SignatureClaim>> claim_of(PackReader& reader);

} // namespace frustumscreen::pack

#include "app/pack/signature/signature.h"

#include "app/pack/container/limits.h"
#include "app/pack/signature/minisign_text.h"
#include "firmware_host/base/calendar_day.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

namespace frustumscreen::pack {

using namespace minisign;

namespace {

using AlgorithmName = std::array<std::uint8_t, 2>;
using SignatureBytes = std::array<std::uint8_t, crypto_sign_BYTES>;

constexpr AlgorithmName of_the_hash{'E', 'D'};
constexpr AlgorithmName of_the_bytes{'E', 'd'};
constexpr std::size_t max_comment_bytes = 8192; ///< of a trusted comment; minisign's own limit
constexpr std::size_t max_public_key_bytes = 4096;

/// A signature file, parsed but not verified.
struct ReadSignature {
    AlgorithmName algorithm{};
    std::array<std::uint8_t, 8> key_id{};
    SignatureBytes signature{};
    SignatureBytes global_signature{}; ///< over `signature` and the trusted comment
    std::string_view trusted_comment;
    std::uint64_t serial = 0;
};

/// True if the only control characters are tabs, which minisign puts between fields.
bool is_comment(std::string_view text) {
    while (!text.empty()) {
        const std::size_t bytes = character_bytes(text);
        if (bytes == 0 || (is_control(text.substr(0, bytes)) && text[0] != '\t')) {
            return false;
        }
        text.remove_prefix(bytes);
    }
    return true;
}

/// The text after `name` in each field of that name.
std::vector<std::string_view> fields_named(std::string_view name, std::string_view comment) {
    const char between = comment.find('\t') == std::string_view::npos ? ' ' : '\t';
    std::vector<std::string_view> values;
    while (!comment.empty()) {
        const std::string_view field = comment.substr(0, comment.find(between));
        comment.remove_prefix(std::min(field.size() + 1, comment.size()));
        if (field.starts_with(name)) {
            values.push_back(field.substr(name.size()));
        }
    }
    return values;
}

/// A comment with a `serial` uses no other field: if the serial is damaged, the time of signing must not
/// replace it.
std::optional<std::uint64_t> serial_in(std::string_view comment) {
    std::vector<std::string_view> values = fields_named("serial:", comment);
    if (values.empty()) {
        values = fields_named("timestamp:", comment);
    }
    if (values.size() != 1) {
        return std::nullopt;
    }
    const char* const end = values[0].data() + values[0].size();
    std::uint64_t serial = 0;
    const auto [stop, error] = std::from_chars(values[0].data(), end, serial);
    return error == std::errc() && stop == end && serial > 0 ? std::optional(serial) : std::nullopt;
}

Result<ReadSignature> read_signature(std::string_view text) {
    const auto damaged = [](std::string_view what) {
        return bad_input("signature.damaged", "its signature {}; sign it again", what);
    };
    if (text.size() > max_signature_bytes) {
        return damaged(fmt::format("has {} bytes, allowed are {}", text.size(), max_signature_bytes));
    }
    const std::vector<std::string_view> lines = lines_of(text, 5);
    if (lines.size() != 4) {
        return damaged("does not have the four lines of a minisign signature");
    }
    if (!lines[0].starts_with(untrusted_prefix) || !lines[2].starts_with(trusted_prefix)) {
        return damaged("lacks one of its two comments");
    }
    const auto record = from_base64<2 + 8 + crypto_sign_BYTES>(lines[1]);
    const auto global_signature = from_base64<crypto_sign_BYTES>(lines[3]);
    if (!record || !global_signature) {
        return damaged("is damaged in its second or fourth line");
    }
    Pieces pieces(*record);
    ReadSignature read;
    read.algorithm = pieces.take<2>();
    read.key_id = pieces.take<8>();
    read.signature = pieces.take<crypto_sign_BYTES>();
    read.global_signature = *global_signature;
    read.trusted_comment = lines[2].substr(trusted_prefix.size());
    if (read.algorithm != of_the_hash && read.algorithm != of_the_bytes) {
        return damaged("has an algorithm that is not minisign's");
    }
    if (read.trusted_comment.size() > max_comment_bytes || !is_comment(read.trusted_comment)) {
        return damaged("has a trusted comment that is too long or holds bytes that are not text");
    }
    const std::optional<std::uint64_t> serial = serial_in(read.trusted_comment);
    if (!serial) {
        return damaged(
            "has no serial in its trusted comment, or two; allowed is one serial:N or timestamp:N");
    }
    read.serial = *serial;
    return read;
}

std::span<const std::uint8_t> octets(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

bool is_signed_by(const PublicKey& key, const SignatureBytes& signature,
                  std::span<const std::uint8_t> bytes) {
    return crypto_sign_verify_detached(signature.data(), bytes.data(), bytes.size(), key.key.data()) == 0;
}

/// The algorithm is not signed. So 64 bytes could be the hash of another file that the museum did sign: bytes
/// of that length are refused with the older algorithm.
bool signs_bytes(const ReadSignature& read, const PublicKey& key, std::span<const std::byte> bytes) {
    if (read.algorithm == of_the_bytes) {
        return bytes.size() != crypto_generichash_BYTES_MAX &&
               is_signed_by(key, read.signature, octets(bytes));
    }
    std::array<std::uint8_t, crypto_generichash_BYTES_MAX> hash{}; // BLAKE2b-512
    crypto_generichash(hash.data(), hash.size(), octets(bytes).data(), bytes.size(), nullptr, 0);
    return is_signed_by(key, read.signature, hash);
}

bool signs_comment(const ReadSignature& read, const PublicKey& key) {
    std::vector<std::uint8_t> covered(read.signature.begin(), read.signature.end());
    covered.insert(covered.end(), read.trusted_comment.begin(), read.trusted_comment.end());
    return is_signed_by(key, read.global_signature, covered);
}

std::string names_of(std::span<const TrustedKey> keys) {
    constexpr std::size_t max_named = 4;
    std::vector<std::string> names;
    for (const TrustedKey& key : keys.first(std::min(keys.size(), max_named))) {
        names.push_back(printable(key.name, 40));
    }
    return fmt::format("{}{}", fmt::join(names, ", "), keys.size() > max_named ? ", ..." : "");
}

tl::unexpected<SignatureRefusal> refused(SignatureFault fault, MessageId id, std::string message) {
    return tl::unexpected<SignatureRefusal>(
        SignatureRefusal{fault, {ErrorKind::BadInput, id, std::move(message)}});
}

tl::unexpected<SignatureRefusal> refused_as_unknown(const ReadSignature& read,
                                                    std::span<const TrustedKey> keys) {
    const std::string id = text_of_key_id(read.key_id);
    return refused(SignatureFault::UnknownKey, "signature.unknown_key",
                   keys.empty()
                       ? fmt::format("it is signed with the key {}, and no key is known here; put the "
                                     "museum's public key into the settings",
                                     id)
                       : fmt::format("it is signed with the key {}, which is not one of those known here "
                                     "({}); sign it with one of them",
                                     id, names_of(keys)));
}

} // namespace

std::string text_of_key_id(std::span<const std::uint8_t, 8> id) {
    std::uint64_t number = 0;
    for (std::size_t k = id.size(); k-- > 0;) { // lowest byte first
        number = number << 8U | id[k];
    }
    return fmt::format("{:X}", number);
}

Result<PublicKey> parse_public_key(std::string_view text) {
    const auto refused = [] {
        return bad_input("key.not_public_key",
                         "this is not a minisign public key; use the file NAME.pub that frustumscreen-pack "
                         "keygen wrote, or its line of 56 letters, which begins with RW");
    };
    if (text.size() > max_public_key_bytes) {
        return refused();
    }
    const std::vector<std::string_view> lines = lines_of(text, 3);
    const bool with_comment = lines.size() == 2 && lines[0].starts_with(untrusted_prefix);
    if (!with_comment && lines.size() != 1) {
        return refused();
    }
    const auto record = from_base64<2 + 8 + crypto_sign_PUBLICKEYBYTES>(lines.back());
    if (!record) {
        return refused();
    }
    Pieces pieces(*record);
    const AlgorithmName algorithm = pieces.take<2>();
    PublicKey key;
    key.id = pieces.take<8>();
    key.key = pieces.take<crypto_sign_PUBLICKEYBYTES>();
    if (algorithm != of_the_bytes) {
        return refused();
    }
    return key;
}

std::string public_key_line(const PublicKey& key) {
    std::vector<std::uint8_t> record(of_the_bytes.begin(), of_the_bytes.end());
    record.insert(record.end(), key.id.begin(), key.id.end());
    record.insert(record.end(), key.key.begin(), key.key.end());
    return to_base64(record);
}

std::string write_public_key(const PublicKey& key) {
    return fmt::format("{}minisign public key {}\n{}\n", untrusted_prefix, text_of_key_id(key.id),
                       public_key_line(key));
}

Result<SignatureClaim> read_signature_claim(std::string_view signature) {
    return read_signature(signature).map([](const ReadSignature& read) {
        return SignatureClaim{text_of_key_id(read.key_id), read.serial, std::string(read.trusted_comment)};
    });
}

tl::expected<Signer, SignatureRefusal> check_signature(std::span<const std::byte> signed_bytes,
                                                       std::optional<std::string_view> signature,
                                                       std::span<const TrustedKey> keys,
                                                       std::optional<std::chrono::sys_days> today) {
    if (!signature) {
        return refused(SignatureFault::Unsigned, "signature.unsigned",
                       "it is not signed; sign it with frustumscreen-pack sign");
    }
    const Result<ReadSignature> read = read_signature(*signature);
    if (!read) {
        return tl::unexpected<SignatureRefusal>(SignatureRefusal{SignatureFault::Malformed, read.error()});
    }
    auto refusal = refused_as_unknown(*read, keys);
    // Two keys may have the same id, or one key two last days: the first valid one counts, otherwise the last
    // refusal is reported.
    for (const TrustedKey& trusted : keys) {
        const std::string name = printable(trusted.name, 40);
        if (trusted.key.id != read->key_id) {
            continue;
        }
        if (!signs_bytes(*read, trusted.key, signed_bytes)) {
            refusal =
                refused(SignatureFault::Altered, "signature.altered",
                        fmt::format("it was altered after it was signed with the key {}; copy it again, or "
                                    "sign it again",
                                    name));
        } else if (!signs_comment(*read, trusted.key)) {
            refusal =
                refused(SignatureFault::Altered, "signature.comment_altered",
                        fmt::format("the trusted comment of its signature was altered after it was signed "
                                    "with the key {}; sign it again",
                                    name));
        } else if (today && trusted.until && *today > *trusted.until) {
            refusal =
                refused(SignatureFault::KeyEnded, "signature.key_ended",
                        fmt::format("it is signed with the key {}, whose last day was {}, and here it is {}; "
                                    "sign it with a newer key, or set the clock right",
                                    name, text_of_day(*trusted.until), text_of_day(*today)));
        } else {
            return Signer{.key = trusted.name,
                          .serial = read->serial,
                          .trusted_comment = std::string(read->trusted_comment),
                          .public_key = trusted.key};
        }
    }
    return refusal;
}

} // namespace frustumscreen::pack

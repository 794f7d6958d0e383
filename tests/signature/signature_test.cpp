// Signatures by minisign, valid ones and ones altered in every possible way; and which keys are trusted.
#include "app/pack/signature/signature.h"
#include "firmware_host/base/file.h"
#include "tests/base/told.h"
#include "tests/signature/signature_testing.h"
#include "tests/signature/vectors.h"

#include <sodium.h>

namespace frustumscreen::pack {
namespace {

using testing::day;
using tl::expected;

TrustedKey minisigns_key() {
    return {"Collections", parse_public_key(vectors::open_public).value(), std::nullopt};
}

expected<Signer, SignatureRefusal> check(std::string_view text, std::optional<std::string_view> signature,
                                         const std::vector<TrustedKey>& keys = {minisigns_key()},
                                         std::optional<std::chrono::sys_days> today = std::nullopt) {
    return check_signature(as_bytes(text), signature, keys, today);
}

void expect_refused(const expected<Signer, SignatureRefusal>& checked, SignatureFault fault,
                    std::string_view words) {
    ASSERT_FALSE(checked);
    const std::string told = test::told(checked.error().error);
    EXPECT_EQ(checked.error().fault, fault) << told;
    EXPECT_TRUE(samples::is_one_line(told)) << told;
    EXPECT_NE(told.find(words), std::string::npos) << told;
}

std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
    std::string changed(text);
    const std::size_t at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return changed.replace(at, from.size(), to);
}

/// Replaces line `number` of `text`, counted from 0, by that of `other`.
std::string with_line_of(std::string_view text, std::string_view other, std::size_t number) {
    const auto line_at = [number](std::string_view whole) {
        std::size_t from = 0;
        for (std::size_t k = 0; k < number; ++k) {
            from = whole.find('\n', from) + 1;
        }
        return whole.substr(from, whole.find('\n', from) - from);
    };
    return replaced(text, line_at(text), line_at(other));
}

TEST(Signature, AcceptsBothMinisignAlgorithms) {
    const auto of_the_hash = check(vectors::signed_text, vectors::of_the_hash);
    ASSERT_TRUE(of_the_hash) << of_the_hash.error().error.message;
    EXPECT_EQ(of_the_hash->key, "Collections");
    EXPECT_EQ(of_the_hash->serial, 1795419910U);
    EXPECT_EQ(of_the_hash->trusted_comment, "timestamp:1795419910\tfile:a\thashed");
    const auto of_the_bytes = check(vectors::signed_text, vectors::of_the_bytes);
    ASSERT_TRUE(of_the_bytes) << of_the_bytes.error().error.message;
    EXPECT_EQ(of_the_bytes->trusted_comment, "timestamp:1795419910\tfile:a");
}

TEST(Signature, AcceptsWindowsLineEndsAndNoFinalNewline) {
    std::string windows;
    for (const char c : vectors::of_the_hash) {
        windows += c == '\n' ? "\r\n" : std::string(1, c);
    }
    EXPECT_TRUE(check(vectors::signed_text, windows));
    EXPECT_TRUE(check(vectors::signed_text, vectors::of_the_hash.substr(0, vectors::of_the_hash.size() - 1)));
}

TEST(Signature, ReportsAMissingSignature) {
    expect_refused(check(vectors::signed_text, std::nullopt), SignatureFault::Unsigned,
                   "[signature.unsigned]");
}

TEST(Signature, RejectsAlteredBytesAndComments) {
    for (const std::string_view text : {"hello", "Hello\n", "hello\n\n", ""}) {
        expect_refused(check(text, vectors::of_the_hash), SignatureFault::Altered,
                       "altered after it was signed");
        expect_refused(check(text, vectors::of_the_bytes), SignatureFault::Altered, "altered after");
    }
    expect_refused(
        check(vectors::signed_text, replaced(vectors::of_the_hash, "timestamp:17", "timestamp:18")),
        SignatureFault::Altered, "[signature.comment_altered]");
    // Lines of another valid signature of the same bytes by the same key.
    for (const std::size_t line : {2U, 3U}) {
        expect_refused(
            check(vectors::signed_text, with_line_of(vectors::of_the_hash, vectors::of_the_bytes, line)),
            SignatureFault::Altered, "[signature.comment_altered]");
    }
    expect_refused(check(vectors::signed_text, with_line_of(vectors::of_the_hash, vectors::of_the_bytes, 1)),
                   SignatureFault::Altered, "[signature.comment_altered]");
}

TEST(Signature, IgnoresTheUntrustedComment) {
    EXPECT_TRUE(
        check(vectors::signed_text,
              replaced(vectors::of_the_hash, "signature from minisign secret key", "anything at all")));
}

/// The two letters of the algorithm are not signed. With the older algorithm, a signature of the hash's bytes
/// would be valid too.
TEST(Signature, HashSignatureIsInvalidForTheHashItself) {
    const std::string forged = replaced(vectors::of_the_hash, "\nRUS", "\nRWS");
    std::array<unsigned char, 64> hash{};
    crypto_generichash(hash.data(), hash.size(),
                       reinterpret_cast<const unsigned char*>(vectors::signed_text.data()),
                       vectors::signed_text.size(), nullptr, 0);
    expect_refused(check({reinterpret_cast<const char*>(hash.data()), hash.size()}, forged),
                   SignatureFault::Altered, "altered");
}

TEST(Signature, RejectsMalformedText) {
    const std::string good(vectors::of_the_hash);
    const std::string long_comment =
        replaced(good, "timestamp:1795419910", "timestamp:1795419910 " + std::string(9000, 'a'));
    for (const std::string& bad :
         {std::string(), std::string("\n\n\n\n"), good + "one line more\n", good.substr(0, 200),
          replaced(good, "untrusted comment: ", "comment: "),
          replaced(good, "\ntrusted comment: ", "\ntrusted: "), replaced(good, "\nRUS", "\nRVS"),
          replaced(good, "\nRUS", "\n RUS"), replaced(good, "DgY=", "DgZ="), replaced(good, "DgY=", "DgY"),
          replaced(good, "\nhWz0", "\nhWz*"), replaced(good, "DA==", "DAAA"),
          replaced(good, "file:a", "file:\x01"), replaced(good, "file:a", "file:\xff"), long_comment,
          std::string(70000, 'a')}) {
        expect_refused(check(vectors::signed_text, bad), SignatureFault::Malformed, "sign it again");
    }
}

/// libsodium's base64 reader accepts some of these as letters.
TEST(Signature, RejectsBytesOutsideBase64) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t at = vectors::of_the_hash.find("BEsuB"); // within the signature
    for (int byte = 0; byte < 256; ++byte) {
        std::string changed(vectors::of_the_hash);
        changed[at] = static_cast<char>(byte);
        const SignatureFault fault = letters.find(changed[at]) != std::string_view::npos
                                         ? SignatureFault::Altered
                                         : SignatureFault::Malformed;
        const auto checked = check(vectors::signed_text, changed);
        EXPECT_EQ(checked.has_value(), changed == vectors::of_the_hash) << byte;
        EXPECT_TRUE(checked || checked.error().fault == fault) << byte;
    }
}

TEST(Signature, RejectsAnUnknownKey) {
    const TrustedKey other = testing::trusted(SecretKey::make(), "Another");
    expect_refused(check(vectors::signed_text, vectors::of_the_hash, {}), SignatureFault::UnknownKey,
                   "[signature.unknown_key]");
    expect_refused(check(vectors::signed_text, vectors::of_the_hash, {other}), SignatureFault::UnknownKey,
                   "the key E68B78C87897BA2, which is not one of those known here (Another)");
    EXPECT_TRUE(check(vectors::signed_text, vectors::of_the_hash, {other, minisigns_key()}));
    // The id names a key but proves nothing.
    TrustedKey same_id = other;
    same_id.key.id = minisigns_key().key.id;
    expect_refused(check(vectors::signed_text, vectors::of_the_hash, {same_id}), SignatureFault::Altered,
                   "the key Another");
    EXPECT_TRUE(check(vectors::signed_text, vectors::of_the_hash, {same_id, minisigns_key()}));
}

TEST(Signature, ReportsAnExpiredKeyWithTheDate) {
    TrustedKey key = minisigns_key();
    key.until = day(2026, 12, 31);
    const auto on = [&](std::optional<std::chrono::sys_days> today) {
        return check(vectors::signed_text, vectors::of_the_hash, {key}, today);
    };
    EXPECT_TRUE(on(day(1970, 1, 1)));
    EXPECT_TRUE(on(day(2026, 12, 31))) << "its last day counts";
    EXPECT_TRUE(on(std::nullopt));
    expect_refused(on(day(2027, 1, 1)), SignatureFault::KeyEnded,
                   "whose last day was 2026-12-31, and here it is 2027-01-01");
    expect_refused(on(day(2100, 1, 1)), SignatureFault::KeyEnded, "2100-01-01");
    // The same key with a later end.
    EXPECT_TRUE(check(vectors::signed_text, vectors::of_the_hash, {key, minisigns_key()}, day(2100, 1, 1)));
    expect_refused(check("other", vectors::of_the_hash, {key}, day(2100, 1, 1)), SignatureFault::Altered,
                   "altered");
}

TEST(Signature, ReadsTheSerialFromTheTrustedComment) {
    const SecretKey key = SecretKey::make();
    const auto serial_of = [&](std::string_view comment) -> std::optional<std::uint64_t> {
        const auto checked = check("x", key.sign(as_bytes("x"), comment), {testing::trusted(key)});
        return checked ? std::optional(checked->serial) : std::nullopt;
    };
    EXPECT_EQ(serial_of("serial:7\ttimestamp:9\tfile:a"), 7U);
    EXPECT_EQ(serial_of("timestamp:9\tserial:7"), 7U);
    EXPECT_EQ(serial_of("timestamp:9\tfile:a serial:7"), 9U) << "a name with a blank is one field";
    EXPECT_EQ(serial_of("the vase, serial:7 of 2026"), 7U);
    EXPECT_EQ(serial_of("serial:18446744073709551615"), 18446744073709551615U);
    for (const std::string_view none :
         {"", "hello", "serial:", "serial:0", "serial:-1", "serial:+1", "serial:1x", "serial: 1",
          "serial:1 serial:2", "serial:x\ttimestamp:9", "timestamp:1\ttimestamp:2", "aserial:7",
          "serial:18446744073709551616"}) {
        EXPECT_EQ(serial_of(none), std::nullopt) << none;
    }
}

TEST(Signature, ReadsTheClaimWithoutAKey) {
    const Result<SignatureClaim> claim = read_signature_claim(vectors::of_the_hash);
    ASSERT_TRUE(claim);
    EXPECT_EQ(claim->key_id, vectors::open_id);
    EXPECT_EQ(claim->serial, 1795419910U);
    EXPECT_FALSE(read_signature_claim("hello"));
}

TEST(PublicKeys, AreParsedFromAFileOrALine) {
    const PublicKey key = parse_public_key(vectors::open_public).value();
    EXPECT_EQ(text_of_key_id(key.id), vectors::open_id);
    const std::string line = public_key_line(key);
    EXPECT_NE(vectors::open_public.find(line), std::string_view::npos);
    EXPECT_EQ(parse_public_key(line).value(), key);
    EXPECT_EQ(parse_public_key(line + "\n").value(), key);
    EXPECT_EQ(parse_public_key(write_public_key(key)).value(), key);
    for (const std::string& bad : {std::string(), std::string("hello"), line.substr(1), line + "A",
                                   line + "\n" + line, "RU" + line.substr(2), std::string(vectors::open_key),
                                   std::string(vectors::open_public) + "more\n", std::string(10000, 'R')}) {
        const Result<PublicKey> refused = parse_public_key(bad);
        ASSERT_FALSE(refused) << bad;
        EXPECT_TRUE(samples::is_one_line(refused.error().message));
    }
}

} // namespace
} // namespace frustumscreen::pack

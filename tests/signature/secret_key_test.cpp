// Secret keys: minisign's own, ours with and without a password, and damaged ones.
#include "app/pack/signature/minisign_text.h"
#include "app/pack/signature/secret_key.h"
#include "tests/pack/samples.h"
#include "tests/signature/vectors.h"

namespace frustumscreen::pack {
namespace {

constexpr PasswordCost cheap{crypto_pwhash_scryptsalsa208sha256_OPSLIMIT_MIN * 4,
                             crypto_pwhash_scryptsalsa208sha256_MEMLIMIT_MIN};

bool signs_for(const SecretKey& key, const PublicKey& expected) {
    const std::vector<TrustedKey> keys{{"House", expected, std::nullopt}};
    return key.public_key() == expected &&
           check_signature(as_bytes("x"), key.sign(as_bytes("x"), "serial:1"), keys, std::nullopt)
               .has_value();
}

constexpr std::size_t line_bytes = 212; ///< in base64

std::string with_record(const std::array<std::uint8_t, 158>& record) {
    return "untrusted comment: a key\n" + minisign::to_base64(record) + "\n";
}
std::array<std::uint8_t, 158> record_of(std::string_view text) {
    return minisign::from_base64<158>(text.substr(text.find('\n') + 1, line_bytes)).value();
}

TEST(SecretKeys, ReadsAMinisignKeyWithoutAPassword) {
    EXPECT_FALSE(needs_password(vectors::open_key).value());
    const Result<SecretKey> key = parse_secret_key(vectors::open_key, std::nullopt);
    ASSERT_TRUE(key) << key.error().message;
    EXPECT_TRUE(signs_for(*key, parse_public_key(vectors::open_public).value()));
}

TEST(SecretKeys, ReadsAMinisignKeyWithAPassword) {
    EXPECT_TRUE(needs_password(vectors::encrypted_key).value());
    EXPECT_FALSE(parse_secret_key(vectors::encrypted_key, std::nullopt));
    const Result<SecretKey> key = parse_secret_key(vectors::encrypted_key, "pw");
    ASSERT_TRUE(key) << key.error().message;
    EXPECT_TRUE(signs_for(*key, parse_public_key(vectors::encrypted_public).value()));
}

TEST(SecretKeys, RoundTrip) {
    for (const std::optional<std::string_view> password :
         {std::optional<std::string_view>(), std::optional<std::string_view>("a \xC3\xA4 password")}) {
        const SecretKey key = SecretKey::make();
        const Result<std::string> text = write_secret_key(key, password, cheap);
        ASSERT_TRUE(text);
        EXPECT_EQ(needs_password(*text).value(), password.has_value());
        const Result<SecretKey> read = parse_secret_key(*text, password);
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_TRUE(signs_for(*read, key.public_key()));
    }
}

TEST(SecretKeys, AreAllDifferent) {
    const PublicKey one = SecretKey::make().public_key();
    const PublicKey other = SecretKey::make().public_key();
    EXPECT_NE(one.id, other.id);
    EXPECT_NE(one.key, other.key);
    const SecretKey key = SecretKey::make();
    EXPECT_NE(*write_secret_key(key, "a", cheap), *write_secret_key(key, "a", cheap))
        << "the salt is another";
}

TEST(SecretKeys, RejectsAWrongPassword) {
    const Result<std::string> text = write_secret_key(SecretKey::make(), "right", cheap);
    for (const std::string_view wrong : {"wrong", "", "Right", "right "}) {
        const Result<SecretKey> read = parse_secret_key(*text, wrong);
        ASSERT_FALSE(read);
        EXPECT_EQ(read.error().id, "key.wrong_password") << read.error().message;
    }
}

/// A signature with a partly wrong key would reveal the secret.
TEST(SecretKeys, RejectsAnyDamagedByte) {
    constexpr std::size_t first_of_the_key = 54;
    for (const bool with_checksum : {true, false}) {
        const std::string text = with_checksum ? *write_secret_key(SecretKey::make(), std::nullopt)
                                               : std::string(vectors::open_key);
        // Not covered: limits and salt of an absent password; the id, if there is no checksum.
        const std::size_t first = with_checksum ? first_of_the_key : first_of_the_key + 8;
        for (std::size_t at = 0; at < 158; ++at) {
            if (at >= 6 && at < first) {
                continue;
            }
            auto record = record_of(text);
            record[at] ^= 1U;
            const Result<SecretKey> read = parse_secret_key(with_record(record), std::nullopt);
            ASSERT_FALSE(read) << at;
            EXPECT_TRUE(samples::is_one_line(read.error().message)) << read.error().message;
        }
    }
}

TEST(SecretKeys, RejectsExcessivePasswordCost) {
    const std::string text = *write_secret_key(SecretKey::make(), "pw", cheap);
    for (const std::size_t high_byte_of : {38U, 46U}) { // operations, memory
        auto record = record_of(text);
        record[high_byte_of + 7] = 0x10;
        const Result<SecretKey> read = parse_secret_key(with_record(record), "pw");
        ASSERT_FALSE(read);
        EXPECT_NE(read.error().message.find("allowed are 1073 MB"), std::string::npos)
            << read.error().message;
    }
}

TEST(SecretKeys, RejectsTextThatIsNoKey) {
    const std::string good(vectors::open_key);
    for (const std::string& bad :
         {std::string(), std::string("hello"), std::string(vectors::open_public), good + "more\n",
          good.substr(20), good.substr(0, 100), std::string(10000, 'a')}) {
        ASSERT_FALSE(parse_secret_key(bad, std::nullopt)) << bad;
        ASSERT_FALSE(needs_password(bad)) << bad;
    }
}

} // namespace
} // namespace frustumscreen::pack

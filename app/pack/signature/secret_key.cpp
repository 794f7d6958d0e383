#include "app/pack/signature/secret_key.h"

#include "app/pack/signature/minisign_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace frustumscreen::pack {

using namespace minisign;

namespace {

constexpr std::size_t salt_bytes = crypto_pwhash_scryptsalsa208sha256_SALTBYTES;
constexpr std::size_t checksum_bytes = 32;
constexpr std::size_t hidden_bytes = 8 + crypto_sign_SECRETKEYBYTES + checksum_bytes; ///< with a password
constexpr std::size_t record_bytes = 2 + 2 + 2 + salt_bytes + 8 + 8 + hidden_bytes;
constexpr std::size_t max_file_bytes = 4096;
/// Upper limit for a file: the cost that minisign itself uses.
constexpr PasswordCost max_cost{};

using Name = std::array<std::uint8_t, 2>;
constexpr Name ed25519{'E', 'd'};
constexpr Name scrypt{'S', 'c'};
constexpr Name no_password{0, 0};
constexpr Name blake2b{'B', '2'};

using Checksum = std::array<std::uint8_t, checksum_bytes>;
using Hidden = std::array<std::uint8_t, hidden_bytes>;

/// Bytes that are wiped on destruction.
template <typename Bytes> struct Wiped {
    Bytes bytes{};
    Wiped() = default;
    Wiped(const Wiped&) = delete;
    Wiped& operator=(const Wiped&) = delete;
    ~Wiped() { sodium_memzero(bytes.data(), bytes.size()); }
};

/// A secret key's file before its password is known.
struct Record {
    Name kdf{};
    std::array<std::uint8_t, salt_bytes> salt{};
    PasswordCost cost;
    Wiped<Hidden> hidden;
};

std::uint64_t number_of(const std::array<std::uint8_t, 8>& bytes) {
    std::uint64_t number = 0;
    for (std::size_t k = bytes.size(); k-- > 0;) {
        number = number << 8U | bytes[k];
    }
    return number;
}

std::array<std::uint8_t, 8> bytes_of(std::uint64_t number) {
    std::array<std::uint8_t, 8> bytes{};
    for (std::uint8_t& byte : bytes) {
        byte = static_cast<std::uint8_t>(number & 0xFFU);
        number >>= 8U;
    }
    return bytes;
}

Checksum checksum_of(std::span<const std::uint8_t> id_and_key) {
    crypto_generichash_state state{};
    Checksum checksum{};
    crypto_generichash_init(&state, nullptr, 0, checksum.size());
    crypto_generichash_update(&state, ed25519.data(), ed25519.size());
    crypto_generichash_update(&state, id_and_key.data(), id_and_key.size());
    crypto_generichash_final(&state, checksum.data(), checksum.size());
    return checksum;
}

/// Encrypts or decrypts: XOR with scrypt's output.
Result<void> apply_password(Hidden& hidden, std::string_view password, const Record& record) {
    Wiped<Hidden> stream;
    if (crypto_pwhash_scryptsalsa208sha256(stream.bytes.data(), stream.bytes.size(), password.data(),
                                           password.size(), record.salt.data(), record.cost.operations,
                                           static_cast<std::size_t>(record.cost.memory_bytes)) != 0) {
        return fail(ErrorKind::Internal, "key.no_memory",
                    "there is not enough memory for the key's password, {} MB; close other programs",
                    record.cost.memory_bytes / 1'000'000);
    }
    for (std::size_t k = 0; k < hidden.size(); ++k) {
        hidden[k] ^= stream.bytes[k];
    }
    return {};
}

/// Reads into `record`, which cannot be moved: it is wiped in place.
Result<void> read_record(std::string_view text, Record& record) {
    const auto refused = [] {
        return bad_input(
            "key.not_secret_key",
            "this is not a minisign secret key; name the file NAME.key that frustumscreen-pack keygen wrote");
    };
    if (text.size() > max_file_bytes) {
        return refused();
    }
    const std::vector<std::string_view> lines = lines_of(text, 3);
    if (lines.size() != 2 || !lines[0].starts_with(untrusted_prefix)) {
        return refused();
    }
    auto bytes = from_base64<record_bytes>(lines[1]);
    if (!bytes) {
        return refused();
    }
    Pieces pieces(*bytes);
    const Name algorithm = pieces.take<2>();
    record.kdf = pieces.take<2>();
    const Name checksum = pieces.take<2>();
    record.salt = pieces.take<salt_bytes>();
    record.cost.operations = number_of(pieces.take<8>());
    record.cost.memory_bytes = number_of(pieces.take<8>());
    record.hidden.bytes = pieces.take<hidden_bytes>();
    sodium_memzero(bytes->data(), bytes->size());
    if (algorithm != ed25519 || checksum != blake2b || (record.kdf != scrypt && record.kdf != no_password)) {
        return refused();
    }
    if (record.kdf == scrypt &&
        (record.cost.operations > max_cost.operations || record.cost.memory_bytes > max_cost.memory_bytes)) {
        return bad_input("key.cost",
                         "the key's password asks for {} MB of memory and {} steps, allowed are {} MB "
                         "and {}; make a new key",
                         record.cost.memory_bytes / 1'000'000, record.cost.operations,
                         max_cost.memory_bytes / 1'000'000, max_cost.operations);
    }
    return {};
}

/// True if the public half of the key belongs to the secret half: a signature made with a wrong public half
/// would reveal the secret.
bool is_whole(std::span<const std::uint8_t, crypto_sign_SECRETKEYBYTES> key) {
    Wiped<std::array<std::uint8_t, crypto_sign_SECRETKEYBYTES>> made;
    std::array<std::uint8_t, crypto_sign_PUBLICKEYBYTES> other{};
    crypto_sign_seed_keypair(other.data(), made.bytes.data(), key.data());
    return std::equal(key.begin(), key.end(), made.bytes.begin());
}

} // namespace

SecretKey SecretKey::make() {
    [[maybe_unused]] const int ready = sodium_init();
    assert(ready >= 0);
    SecretKey key;
    std::array<std::uint8_t, crypto_sign_PUBLICKEYBYTES> ignored{};
    randombytes_buf(key.id_.data(), key.id_.size());
    crypto_sign_keypair(ignored.data(), key.key_.data());
    return key;
}

SecretKey::~SecretKey() {
    sodium_memzero(key_.data(), key_.size());
}

SecretKey::SecretKey(SecretKey&& other) noexcept : id_(other.id_), key_(other.key_) {
    sodium_memzero(other.key_.data(), other.key_.size());
}

PublicKey SecretKey::public_key() const {
    PublicKey key{id_, {}};
    crypto_sign_ed25519_sk_to_pk(key.key.data(), key_.data());
    return key;
}

std::string SecretKey::sign(std::span<const std::byte> bytes, std::string_view trusted_comment) const {
    assert(trusted_comment.find_first_of("\r\n") == std::string_view::npos);
    std::array<std::uint8_t, crypto_generichash_BYTES_MAX> hash{}; // BLAKE2b-512
    crypto_generichash(hash.data(), hash.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()),
                       bytes.size(), nullptr, 0);
    std::array<std::uint8_t, crypto_sign_BYTES> signature{};
    crypto_sign_detached(signature.data(), nullptr, hash.data(), hash.size(), key_.data());
    std::vector<std::uint8_t> covered(signature.begin(), signature.end());
    covered.insert(covered.end(), trusted_comment.begin(), trusted_comment.end());
    std::array<std::uint8_t, crypto_sign_BYTES> global_signature{};
    crypto_sign_detached(global_signature.data(), nullptr, covered.data(), covered.size(), key_.data());

    std::vector<std::uint8_t> record{'E', 'D'};
    record.insert(record.end(), id_.begin(), id_.end());
    record.insert(record.end(), signature.begin(), signature.end());
    return fmt::format("{}signature from FrustumScreen with the key {}\n{}\n{}{}\n{}\n", untrusted_prefix,
                       text_of_key_id(id_), to_base64(record), trusted_prefix, trusted_comment,
                       to_base64(global_signature));
}

Result<std::string> write_secret_key(const SecretKey& key, std::optional<std::string_view> password,
                                     const PasswordCost& cost) {
    [[maybe_unused]] const int ready = sodium_init();
    assert(ready >= 0);
    Record record;
    Hidden& hidden = record.hidden.bytes;
    std::copy(key.key_.begin(), key.key_.end(), std::copy(key.id_.begin(), key.id_.end(), hidden.begin()));
    const std::span<const std::uint8_t> open(hidden.data(), hidden.size() - checksum_bytes);
    const Checksum checksum = checksum_of(open);
    std::copy(checksum.begin(), checksum.end(), hidden.end() - checksum_bytes);
    record.cost = {0, 0};
    if (password) {
        record.kdf = scrypt;
        record.cost = cost;
        randombytes_buf(record.salt.data(), record.salt.size());
        TRY_VOID(apply_password(hidden, *password, record));
    }
    Wiped<std::array<std::uint8_t, record_bytes>> bytes;
    auto place = bytes.bytes.begin();
    const auto put = [&place](const auto& piece) { place = std::copy(piece.begin(), piece.end(), place); };
    put(ed25519);
    put(record.kdf);
    put(blake2b);
    put(record.salt);
    put(bytes_of(record.cost.operations));
    put(bytes_of(record.cost.memory_bytes));
    put(hidden);
    return fmt::format("{}minisign {} secret key\n{}\n", untrusted_prefix,
                       password ? "encrypted" : "unencrypted", to_base64(bytes.bytes));
}

Result<bool> needs_password(std::string_view text) {
    Record record;
    return read_record(text, record).map([&] { return record.kdf == scrypt; });
}

Result<SecretKey> parse_secret_key(std::string_view text, std::optional<std::string_view> password) {
    Record record;
    TRY_VOID(read_record(text, record));
    Hidden& hidden = record.hidden.bytes;
    const bool encrypted = record.kdf == scrypt;
    if (encrypted) {
        if (!password) {
            return bad_input("key.no_password", "the key has a password, and none was given; type it, or "
                                                "give it in one line on standard input");
        }
        TRY_VOID(apply_password(hidden, *password, record));
    }
    const std::span<const std::uint8_t> open(hidden.data(), hidden.size() - checksum_bytes);
    Checksum checksum{};
    std::copy(hidden.end() - checksum_bytes, hidden.end(), checksum.begin());
    // minisign writes no checksum into a key without a password.
    const bool left_out = !encrypted && checksum == Checksum{};
    const std::span<const std::uint8_t, crypto_sign_SECRETKEYBYTES> both_halves(hidden.data() + 8,
                                                                                crypto_sign_SECRETKEYBYTES);
    if ((!left_out && checksum != checksum_of(open)) || !is_whole(both_halves)) {
        return bad_input("key.wrong_password", encrypted
                                                   ? "the password is wrong, or the key's file is damaged"
                                                   : "the key's file is damaged; use your copy of it");
    }
    SecretKey key;
    std::copy_n(hidden.begin(), key.id_.size(), key.id_.begin());
    std::copy(both_halves.begin(), both_halves.end(), key.key_.begin());
    return key;
}

} // namespace frustumscreen::pack

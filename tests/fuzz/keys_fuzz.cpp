// Public and secret keys: refused in one line, or written again they are equal. Passwords are not tested:
// each takes seconds.
#include "app/pack/signature/secret_key.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

namespace {

void read_public(std::string_view text) {
    const Result<pack::PublicKey> key = pack::parse_public_key(text);
    if (!key) {
        fuzz::require_one_line(key.error().message);
        return;
    }
    for (const std::string& written : {pack::public_key_line(*key), pack::write_public_key(*key)}) {
        const Result<pack::PublicKey> again = pack::parse_public_key(written);
        fuzz::require(again && *again == *key, "a public key written again is the same", written);
    }
}

void read_secret(std::string_view text) {
    const Result<pack::SecretKey> key = pack::parse_secret_key(text, std::nullopt);
    if (!key) {
        fuzz::require_one_line(key.error().message);
        return;
    }
    fuzz::require(!pack::needs_password(text).value_or(true),
                  "a key that was read without a password needs none");
    const Result<std::string> written = pack::write_secret_key(*key, std::nullopt);
    const Result<pack::SecretKey> again = pack::parse_secret_key(*written, std::nullopt);
    fuzz::require(again && again->public_key() == key->public_key(),
                  "a secret key written again is the same");
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    read_public(fuzz::text_of(data, size));
    read_secret(fuzz::text_of(data, size));
    return 0;
}

// A signature file: refused in one line, or one of the two signatures that minisign made for these bytes with
// this key.
#include "app/pack/signature/signature.h"
#include "firmware_host/base/file.h"
#include "tests/fuzz/fuzz.h"
#include "tests/signature/vectors.h"

using namespace frustumscreen;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::text_of(data, size);
    const Result<pack::SignatureClaim> claim = pack::read_signature_claim(text);
    if (!claim) {
        fuzz::require_one_line(claim.error().message);
    } else {
        fuzz::require(claim->serial > 0, "a serial is 1 or more");
        fuzz::require(claim->trusted_comment.find('\n') == std::string::npos, "a comment is one line");
    }
    const std::vector<pack::TrustedKey> keys{
        {"House", *pack::parse_public_key(vectors::open_public), std::nullopt}};
    const auto checked = pack::check_signature(as_bytes(vectors::signed_text), text, keys, std::nullopt);
    if (!checked) {
        fuzz::require_one_line(checked.error().error.message);
        return 0;
    }
    fuzz::require(claim.has_value(), "what is right can be read");
    for (const std::string_view right : {vectors::of_the_hash, vectors::of_the_bytes}) {
        if (right.find("\ntrusted comment: " + checked->trusted_comment + "\n") != std::string_view::npos) {
            return 0;
        }
    }
    fuzz::require(false, "nothing is accepted that was not signed", checked->trusted_comment);
    return 0;
}

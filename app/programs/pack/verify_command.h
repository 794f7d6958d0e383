/// frustumscreen-pack verify: checks packs and their signatures.
///
/// Errors   one sentence for each pack, beginning with its name; the other packs are still checked.
/// Threads  one caller.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen::programs {

struct VerifyRequest {
    std::vector<std::string> packs;
    std::vector<std::filesystem::path> keys; ///< public keys; none: signatures are shown, not verified
    bool json = false;
};
/// Returns the exit status: 1 if a pack is damaged or, with keys, is not signed with one of them.
///
/// The JSON is a list of {file, sound, signed, reason (if refused), checked, key (its name, if checked), key_id,
/// serial, trusted_comment}. With keys, `signed` is true only for valid signatures.
[[nodiscard]] int verify_packs(const VerifyRequest& request);

} // namespace frustumscreen::programs

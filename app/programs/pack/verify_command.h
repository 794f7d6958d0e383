/// frustumscreen-pack verify: are packs sound, and who signed them?
///
/// Errors   one sentence for each pack, beginning with its name; the others are checked all the same.
/// Threads  one caller.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen {

struct VerifyRequest {
    std::vector<std::string> packs;
    std::vector<std::filesystem::path> keys; ///< public keys; none: signatures are told and not checked
    bool json = false;
};
/// The program's exit status: 1 if a pack is not sound, or not signed with one of the keys where there are keys.
///
/// As JSON, a list of {file, sound, signed, reason (of a refused one), checked, key (its name, of a checked one), key_id, serial,
/// trusted_comment}. With keys, `signed` is true only of signatures that are right.
[[nodiscard]] int verify_packs(const VerifyRequest& request);

} // namespace frustumscreen

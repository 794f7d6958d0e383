/// frustumscreen-pack sign: signatures into packs, and beside set files and a kiosk's settings.
///
/// Errors   one sentence, beginning with the file's name. A file that fails stays as it was, and the others are signed.
/// Threads  one caller.
#pragma once

#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

struct SignRequest {
    std::vector<std::string> files; ///< packs; set files (*.toml); a kiosk's settings (kiosk.toml)
    std::filesystem::path key;
    std::optional<std::uint64_t> serial; ///< none: `now_s`
    std::uint64_t now_s = 0;             ///< since 1970
    bool json = false;
};
/// The program's exit status.
[[nodiscard]] int sign_files(const SignRequest& request);

} // namespace frustumscreen

/// frustumscreen-pack sign: writes signatures into packs, and beside set files and a kiosk's settings.
///
/// Errors   one sentence, beginning with the file's name. A file that fails stays unchanged; the others are signed.
/// Threads  one caller.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::programs {

struct SignRequest {
    std::vector<std::string> files; ///< packs; set files (*.toml); a kiosk's settings (kiosk.toml)
    std::filesystem::path key;
    std::optional<std::uint64_t> serial; ///< none: `now_s`
    std::uint64_t now_s = 0;             ///< seconds since 1970
    bool json = false;
};
/// Returns the program's exit status.
[[nodiscard]] int sign_files(const SignRequest& request);

} // namespace frustumscreen::programs

/// What the start of an appliance has left of the system that runs: its version, its slot, and what was wrong.
///
/// Files    version, slot and notes in one folder, lines of text; the image's initrd writes them, and whatever marks a start as good.
/// Threads  any; reads small files.
/// Errors   none: without the folder, as on a computer that was not made from the image, nothing is known.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

inline constexpr std::string_view usual_boot_folder = "/run/frustumscreen-boot";

struct SystemImage {
    std::string version;            ///< empty: nothing is known
    std::string slot;               ///< of the disk: a or b
    std::vector<std::string> notes; ///< sentences, such as that an update did not start
    [[nodiscard]] bool there() const { return !version.empty(); }
};
[[nodiscard]] SystemImage read_system_image(const std::filesystem::path& folder);

} // namespace frustumscreen

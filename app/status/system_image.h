/// The running system of an appliance, as its start recorded it: version, slot, and faults.
///
/// Files    version, slot and notes in one folder, lines of text; written by the image's initrd and by the unit
///          that marks a start good.
/// Threads  any; reads small files.
/// Errors   none: without the folder, as on a computer not installed from the image, nothing is known.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::status {

inline constexpr std::string_view usual_boot_folder = "/run/frustumscreen-boot";

struct SystemImage {
    std::string version;            ///< empty: unknown
    std::string slot;               ///< of the disk: a or b
    std::vector<std::string> notes; ///< sentences, for example that an update did not start
    [[nodiscard]] bool there() const { return !version.empty(); }
};
[[nodiscard]] SystemImage read_system_image(const std::filesystem::path& folder);

} // namespace frustumscreen::status

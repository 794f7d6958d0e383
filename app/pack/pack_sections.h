/// Single parts of a pack's file, read without its levels: the artifact's picture and titles for the table, and the
/// parts of sections. Reads only the manifest and the requested parts; each part is checked against its hash.
///
/// Errors   as load_pack; messages begin with the file's name.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace frustumscreen::pack {

/// An artifact for the table.
struct PackCard {
    std::string id;    ///< empty: none
    std::string title; ///< if no language is asked for
    std::vector<std::string> languages;
    std::vector<PackLabel> titles; ///< one for each caption
    image::Image8 table_picture;   ///< cut out; empty: none
};
[[nodiscard]] Result<PackCard> load_pack_card(const std::filesystem::path& file);

/// Chooses the parts to read, each a part of one of the description's sections.
using ChooseParts = std::function<Result<std::vector<std::string>>(const PackDescription&)>;
/// The parts' bytes, by name.
[[nodiscard]] Result<std::map<std::string, Bytes>> load_section_parts(const std::filesystem::path& file,
                                                                      const ChooseParts& choose);

} // namespace frustumscreen::pack

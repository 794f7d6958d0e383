/// An artifact's texts and sounds as the kiosk shows and plays them, for the preview's page.
///
/// Pictures have the widest caption's width, the usual type size, white on black; lossless WebP.
///
/// Errors   as load_set_texts; no typeface for a text that needs one. Messages begin with the file's name.
/// Threads  one caller.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen::programs {

/// A text and its picture as on the table.
struct ProjectedText {
    std::string text;
    Bytes picture;      ///< none: the bake could not set it
    glm::ivec2 size{0}; ///< pixels
};

struct ProjectedLanguage {
    pack::PackCaption caption;
    ProjectedText title;                 ///< the title over the short text, the attribution below
    std::vector<ProjectedText> portions; ///< of the description, then the attribution
    bool ends_with_attribution = false;
    std::vector<ProjectedText> labels; ///< the hotspots' labels, in their order
    Bytes sound;                       ///< the description, Ogg Opus; none: it is silent
};

/// Largest width of a caption's lines, pixels.
[[nodiscard]] double widest_text_px();

/// Returns one for each caption of the pack.
[[nodiscard]] Result<std::vector<ProjectedLanguage>> projected_texts(const std::filesystem::path& pack_file,
                                                                     const pack::PackDescription& pack,
                                                                     double metres_per_box);

} // namespace frustumscreen::programs

/// Opens packs for the show: of each its manifest is read, what is needed of it is planned, and its texts are laid out. Levels,
/// textures and pictures of texts are left for later (residents.h), but for the levels of the first pack that is good.
///
/// Threads  any, never in a frame; needs no context.
/// Errors   as load_pack, as far as manifest and texts go; a technique that the pack does not have; no typeface where one
///          is needed. Messages begin with the file's name. Such a pack is left out with a line on standard error; if none is
///          left, BadConfiguration.
#pragma once

#include "app/library/pack_left_out.h"
#include "app/residency/prepared_artifact.h"
#include "app/settings/settings.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

[[nodiscard]] Catalogue catalogue_of(std::span<const KnownArtifact> artifacts);

struct OpenerOptions {
    std::string technique = "auto"; ///< this, `samples` and `economies`: as ArtifactShowOptions
    int samples = 1;
    unsigned economies = AllEconomies;
    bool other_languages = false; ///< a visitor can come to see them
    bool other_packs = false;     ///< the same of packs
    bool table_pictures = false;  ///< this and `most_blocks_on_gpu`: as SceneRequest
    std::uint32_t most_blocks_on_gpu = 0;
    double deadline_ms = 16.0;
    std::string_view program = "frustumscreen"; ///< this and `packs_key`: as ArtifactShowOptions
    std::string packs_key = {};
    std::function<bool()> goes_on = [] { return true; }; ///< asked before each pack; no: all is given up
};

/// What there is of the packs that can be shown.
struct OpenedArtifacts {
    std::vector<KnownArtifact> known;
    std::optional<PreparedArtifact> first; ///< of `known`; it is there
    std::vector<PackLeftOut> left_out;
    RenderNeeds needs;
    std::vector<std::string> languages; ///< of all captions of the packs opened, shown or not
    std::vector<std::string> notes;     ///< sentences about what a person may not have meant
};
[[nodiscard]] Result<OpenedArtifacts> open_artifacts(const Settings& settings,
                                                     std::span<const std::filesystem::path> packs,
                                                     const OpenerOptions& options);
/// What any pack that may come later needs of a renderer with room for so many samples a pixel. `reliefs_on_gpu`: the GPU may come to draw
/// reliefs.
[[nodiscard]] RenderNeeds needs_of_any_pack(const Settings& settings, int samples, bool reliefs_on_gpu);

/// How texts are set on the settings' table.
[[nodiscard]] TextStyle text_style(const Settings& settings);

} // namespace frustumscreen

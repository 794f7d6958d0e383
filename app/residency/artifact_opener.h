/// Opens packs for the show: reads each pack's manifest, plans its scene and lays out its texts. Levels,
/// textures and pictures of texts follow later (artifact_cache.h), except for the levels of the first usable pack.
///
/// Threads  any, never in a frame; needs no context.
/// Errors   as load_pack, as far as manifest and texts are concerned; a technique that the pack does not
///          have; no typeface where one is needed. Messages begin with the file's name. Such a pack is left
///          out with a line on standard error; if none is left, BadConfiguration.
#pragma once

#include "app/library/unshown_pack.h"
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

namespace frustumscreen::residency {

[[nodiscard]] exhibit::Catalogue catalogue_of(std::span<const KnownArtifact> artifacts);

struct OpenerOptions {
    std::string technique = "auto"; ///< `technique`, `samples`, `cull_kinds`: as ArtifactShowOptions
    int samples = 1;
    unsigned cull_kinds = scene::AllCullKinds;
    bool other_languages = false; ///< a visitor can change the language
    bool other_packs = false;     ///< a visitor can change the artifact
    bool table_pictures = false;  ///< `table_pictures`, `max_blocks_on_gpu`: as SceneRequest
    std::uint32_t max_blocks_on_gpu = 0;
    double deadline_ms = 16.0;
    std::string_view program = "frustumscreen"; ///< `program`, `packs_key`: as ArtifactShowOptions
    std::string packs_key = {};
    std::function<bool()> goes_on = [] { return true; }; ///< asked before each pack; false: stop opening
};

/// The packs that can be shown, and the renderer's needs for them.
struct OpenedArtifacts {
    std::vector<KnownArtifact> known;
    std::optional<PreparedArtifact> first; ///< levels of the first of `known`; set on success
    std::vector<library::UnshownPack> left_out;
    scene::RenderNeeds needs;
    std::vector<std::string> languages; ///< of all captions of the packs opened, shown or not
    std::vector<std::string> notes;     ///< sentences about settings that may be unintended
};
[[nodiscard]] Result<OpenedArtifacts> open_artifacts(const settings::Settings& settings,
                                                     std::span<const std::filesystem::path> packs,
                                                     const OpenerOptions& options);
/// The needs of any pack that may come later, for a renderer that holds `samples` samples a pixel.
/// `reliefs_on_gpu`: the GPU may draw reliefs.
[[nodiscard]] scene::RenderNeeds needs_of_any_pack(const settings::Settings& settings, int samples,
                                                   bool reliefs_on_gpu);

/// Size and resolution of texts on the settings' table.
[[nodiscard]] TextStyle text_style(const settings::Settings& settings);

} // namespace frustumscreen::residency

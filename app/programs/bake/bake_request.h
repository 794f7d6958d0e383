/// The inputs of a bake: the command line overrides the folder's artifact.toml, which overrides the defaults.
///
/// Errors   one line. `BadInput`: the folder's file; `BadConfiguration`: the command line (wrong use).
/// Threads  pure apart from reading the folder; any.
#pragma once

#include "app/pack/attribution.h"
#include "app/pack/pack.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/site_regions.h"
#include "assets_baked/folder/artifact_behaviours.h"
#include "assets_baked/folder/artifact_states.h"
#include "assets_baked/folder/artifact_torches.h"
#include "assets_baked/texts/speak_artifact.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::programs {

/// The command line as written; options that were not given are empty.
struct BakeArguments {
    std::filesystem::path input; ///< a scan, or a folder
    std::filesystem::path output;
    std::filesystem::path preview;    ///< page to write; empty: none
    bool watched = false;             ///< given by --watch: a coarse page that reloads itself
    std::filesystem::path new_folder; ///< --new: start a folder from the scan, bake nothing
    bool force = false;               ///< replace an output that is no pack
    bool clean = false;               ///< leave out scraps (last_look.h), turn what is inside out (winding.h)
    bool strict = false;              ///< losses are errors
    bool json = false;
    bool unlit = false;
    bool no_relief = false;
    bool far = false;
    std::string cells; ///< none, nodes, auto; empty: nodes if something moves
    bool site = false; ///< terrain and buildings, as [site] in artifact.toml
    std::optional<int> size;
    std::optional<std::string> prop;
    std::optional<std::string> up;
    std::optional<double> turn_deg;
    std::optional<double> scale;
    std::optional<double> lift;
    std::filesystem::path texture;
    std::string title;
    std::string licence;
    std::string author;
    std::vector<std::string> languages;
    std::vector<std::string> captions; ///< LANGUAGE=TEXT
    std::string speech;                ///< empty: espeak-ng; "none": no voice
};

struct BakeRequest {
    std::filesystem::path scan;
    std::filesystem::path folder; ///< the folder of artifact.toml; empty: a scan alone
    std::filesystem::path output;
    std::filesystem::path preview;             ///< as BakeArguments
    bool watched = false;                      ///< as BakeArguments
    std::vector<std::filesystem::path> inputs; ///< files that must not be overwritten, as known so far
    bool force = false;
    bool clean = false;
    bool strict = false;
    std::filesystem::path texture;
    std::optional<double> turn_deg; ///< nothing: the best
    std::string cells;              ///< as BakeArguments
    std::vector<folder::ArtifactBehaviour> behaviours;
    std::vector<folder::ArtifactTorch> torches;
    std::vector<folder::ArtifactState> states;
    std::optional<bake::SiteOptions> site; ///< nothing: the scan is none
    bake::BakeOptions options;
    std::string id;                          ///< empty: from the pack's name (scan_about.h)
    std::string usual_title;                 ///< title of a caption that has none of its own
    pack::ScanRights rights;                 ///< empty: as the scan's file has them
    std::vector<pack::PackCaption> captions; ///< at least one; a title may be empty
    texts::SpeechSources speech;
    std::vector<std::string> lost; ///< contents of the folder's file that are not shown, a sentence each
};

[[nodiscard]] Result<BakeRequest> request_of(const BakeArguments& arguments);

} // namespace frustumscreen::programs

/// What is to be baked: the command line over the folder's artifact.toml over what is usual.
///
/// Errors   one line. `BadInput`: the folder's file; `BadConfiguration`: the command line, which is wrong use.
/// Threads  pure apart from reading the folder; any.
#pragma once

#include "app/pack/attribution.h"
#include "app/pack/pack.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/texts/speak_artifact.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

/// The command line as it was written; nothing where an option was left out.
struct BakeArguments {
    std::filesystem::path input; ///< a scan, or a folder
    std::filesystem::path output;
    std::filesystem::path preview;    ///< page to write; empty: none
    bool watched = false;             ///< --watch asks for it: a coarse page, which loads itself again
    std::filesystem::path new_folder; ///< --new: start a folder from the scan, bake nothing
    bool force = false;               ///< replace an output that is no pack
    bool clean = false;               ///< leave out scraps (last_look.h)
    bool strict = false;              ///< what is lost is an error
    bool json = false;
    bool unlit = false;
    bool no_relief = false;
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
    std::filesystem::path output;
    std::filesystem::path preview;             ///< as above
    bool watched = false;                      ///< as above
    std::vector<std::filesystem::path> inputs; ///< what must not be replaced, as far as it is known now
    bool force = false;
    bool clean = false;
    bool strict = false;
    std::filesystem::path texture;
    std::optional<double> turn_deg; ///< nothing: the best
    BakeOptions options;
    std::string id;                    ///< empty: from the pack's name (default_id.h)
    std::string usual_title;           ///< of what has no title of its own
    ScanRights rights;                 ///< empty: what the scan's file says of itself
    std::vector<PackCaption> captions; ///< at least one; a title may be empty
    SpeechSources speech;
    std::vector<std::string> lost; ///< what the folder's file says and nobody will see, a sentence each
};

[[nodiscard]] Result<BakeRequest> request_of(const BakeArguments& arguments);

} // namespace frustumscreen

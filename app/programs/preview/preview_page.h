/// A pack as one HTML page for its curator: the artifact's look, its texts, its errors, and the losses of the bake.
///
/// The page is self-contained: pictures, sounds, style and script are in it, and its content security policy forbids it
/// to load anything. All texts of the pack are escaped. Without scripts the artifact turns by itself, and the pictures of
/// what moves, and those of a torch, lie side by side.
///
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include "app/pack/attribution.h"
#include "app/pack/pack.h"
#include "app/programs/preview/behaviour_pictures.h"
#include "app/programs/preview/state_pictures.h"
#include "app/programs/preview/text_pictures.h"
#include "app/programs/preview/torch_pictures.h"
#include "app/programs/preview/turn_pictures.h"

#include <cstdint>
#include <string>
#include <vector>

namespace frustumscreen::programs {

/// One level of detail, on a prop of usual size.
struct PreviewLevel {
    std::uint64_t triangles = 0;
    std::uint64_t bytes = 0;
    double mean_mm = 0.0, p95_mm = 0.0, largest_mm = 0.0;
    double colour_rmse = 0.0; ///< 8-bit codes
};

/// The bake's findings; those for reading are in words.
struct PreviewFacts {
    std::string pack_name; ///< file name without folders
    std::uint64_t pack_bytes = 0;
    double seconds = 0.0;
    glm::dvec3 size_m{0.0};
    std::string stands;
    std::string program; ///< name and version
    std::vector<PreviewLevel> levels;
    std::vector<std::string> lost, silent, guessed, taken, missing; ///< a sentence each
    pack::ScanRights rights;
};

struct PreviewMedia {
    TurnPictures turn;
    image::Image8 table_picture; ///< empty: none
    std::vector<ProjectedLanguage> languages;
    std::vector<BehaviourPictures> behaviours = {};
    std::vector<TorchPictures> torches = {};
    std::vector<StatePicture> states = {};
};

/// A page of a bake that is being watched reloads itself every two seconds.
enum class PageKind : std::uint8_t { Final, Reloading };

[[nodiscard]] std::string preview_page(const pack::PackDescription& pack, const PreviewFacts& facts,
                                       const PreviewMedia& media, PageKind kind = PageKind::Final);

/// The page as it remains after the watching: it does not reload itself.
[[nodiscard]] std::string without_reloading(std::string page);

} // namespace frustumscreen::programs

/// A pack's file, of which only what its pictures need was read: the whole artifact, or its cells for a
/// behaviour and where they are quicker.
///
/// Errors   as load_pack and plan_scene; a behaviour or a state that the pack does not have.
/// Threads  any.
#pragma once

#include "app/pack/pack_file.h"
#include "app/pack/pack_torches.h"
#include "app/relief/block_relief.h"
#include "app/scene/scene_plan.h"
#include "app/settings/settings.h"
#include "app/torch/content.h"
#include "app/world/behaviour.h"
#include "app/world/cell.h"
#include "app/world/site_view.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::show {

/// The place stands on the prop's ground, in the middle.
struct OfflineSite {
    glm::dvec2 place_box{0.0}; ///< on the site's ground, box frame
    double zoom = 1.0;         ///< relative to the miniature, 1 to world::max_zoom
};

struct OfflineOptions {
    std::string technique = "auto";
    int width = 0; ///< of the picture; 0 = the configured projector's. The intrinsics scale with it.
    int height = 0;
    bool light = true;
    bool hit_points = false; ///< of one eye's picture
    bool both_eyes = false;  ///< in the configured layout; otherwise one eye's picture, in the full size
    int samples = 0;         ///< a pixel; 0 = finest_samples for "finest", otherwise the pack's
    unsigned cull_kinds = scene::AllCullKinds;
    /// All poses that will be drawn, one entry for each eye; empty: any pose may be drawn.
    std::vector<scene::KnownView> views;
    std::string behaviour = {}; ///< that moves the artifact's cells; empty: it is drawn at rest
    std::string state = {};     ///< in which the artifact is drawn; empty: as it is
    std::string torch =
        {}; ///< content that torches throw: torch::white_name, or one of the pack's; empty: there are none
    std::size_t windows = 0; ///< that may be pinned, up to scene::max_windows
    bool window_patches =
        false; ///< draws windows by their points wherever an eye has some (scene/window_patches.h)
    /// A part of a site, drawn large; none: the whole.
    std::optional<OfflineSite> site = std::nullopt;
};

struct OfflineSetup {
    settings::CheckedSettings settings;
    OfflineOptions options;
};
struct OfflineCell {
    std::size_t cell = 0; ///< index into OfflineWorld::cells
    scene::ScenePlan plan;
    pack::VerifiedPack pack;
    std::shared_ptr<const relief::BlockRelief> relief;
};
struct OfflineWorld {
    std::vector<world::Cell> cells;
    world::Behaviour behaviour;     ///< moves nothing: the cells are drawn at rest
    std::vector<OfflineCell> drawn; ///< the cells with geometry
    std::optional<double> held_s{}; ///< of a state: the time in the behaviour at which every picture is
    std::optional<world::SiteView> site = std::nullopt;
};
/// The contents of torches.
struct OfflineTorch {
    torch::Content content;
    std::vector<image::Image8> picture{}; ///< its mips; of a film, those of the first frame
    pack::PackFilm film{};
    std::vector<Bytes> frames{};
    std::size_t layer = 0; ///< index into Drawable::layers
    /// In place of the texture or the colours of each thing drawn: the whole, or OfflineWorld::drawn; empty: it shows no layer.
    std::vector<image::Image8> textures{};
    std::vector<std::shared_ptr<const std::vector<glm::u8vec4>>> colours{};
};
struct OfflineScene {
    OfflineSetup setup;
    scene::ScenePlan plan; ///< of the whole artifact
    pack::VerifiedPack pack;
    std::shared_ptr<const relief::BlockRelief> relief; ///< in place of a level
    std::optional<OfflineWorld> world;                 ///< drawn in place of the whole
    std::optional<OfflineTorch> torch = std::nullopt;  ///< none: no torch is drawn
    std::optional<OfflineTorch> look =
        std::nullopt; ///< of a state, in place of its own: a layer's textures and colours
};

/// `setup_of` returns the set-up for a pack's outline.
[[nodiscard]] Result<OfflineScene>
load_offline(const std::filesystem::path& file,
             const std::function<Result<OfflineSetup>(const pack::PackOutline&)>& setup_of);

/// The settings in the size and layout of the options.
[[nodiscard]] settings::Settings sized(const OfflineSetup& setup);
/// Samples a pixel.
[[nodiscard]] int samples_of(const OfflineOptions& options, const pack::PackDescription& pack);

} // namespace frustumscreen::show

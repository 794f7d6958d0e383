/// The scenes of `frustumscreen-bench torch`: one artifact as polygons, as cast relief, and as cells of both, on a display of
/// its own.
///
/// Colours  each surface twice: in its own colours, to be timed, and in black, so that white light laid over it is its
///          intensity in linear light.
/// Samples  one a pixel, so that a pixel's intensity is that of the point through its centre; costs are taken at the
///          pack's own number too.
/// Lens     straight: the paper's pass does not bend.
/// Threads  the one that opened the set: the display's context is current there.
/// Errors   no display; a pack without cells or without reliefs; any error of reading and planning them.
#pragma once

#include "app/bench/mixed/cell_set.h"
#include "app/scene/placed_torch.h"

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::bench {

/// Plain white that covers the surface by the intensity.
[[nodiscard]] torch::Content white_over();

struct TorchSurface {
    std::vector<scene::Part> parts, black;
};
struct TorchScene {
    std::string name; ///< "mesh", "relief", "cells"
    TorchSurface drawn;
    TorchSurface polygons; ///< for the paper, which knows no relief: as fine as those of `drawn`
    std::size_t max_indices = 0;
    std::size_t triangles = 0; ///< of `polygons`
};

class TorchSet {
public:
    [[nodiscard]] static Result<std::unique_ptr<TorchSet>> open(settings::Settings settings,
                                                                const std::filesystem::path& pack);

    [[nodiscard]] const std::vector<TorchScene>& scenes() const { return scenes_; }
    [[nodiscard]] CellSet& cells() { return *cells_; }
    [[nodiscard]] const geometry::PropShape& prop() const { return cells_->prop(); }
    [[nodiscard]] const settings::Settings& settings() const { return cells_->settings(); }
    [[nodiscard]] int samples() const { return samples_; } ///< a pixel, of the pack
    [[nodiscard]] const glm::dmat4& prop_from_artifact() const { return prop_from_artifact_; }
    /// The artifact's box in the prop.
    [[nodiscard]] const geometry::Box& box() const { return box_; }
    /// Positions of a mesh's vertices over its box, 0..1: PackVertex::position / 65535.
    [[nodiscard]] const std::vector<glm::dvec3>& unit_positions(scene::MeshId mesh) const {
        return unit_positions_.at(mesh);
    }

private:
    TorchSet() = default;
    [[nodiscard]] Result<void> add_whole(const std::filesystem::path& file);
    void add_cells();
    void add_part(TorchSurface& surface, const scene::PlacedLevel& placed);
    void add_scene(std::string name, TorchSurface drawn, TorchSurface polygons);
    [[nodiscard]] scene::PlacedLevel in_black(const scene::PlacedLevel& placed);

    std::unique_ptr<CellSet> cells_;
    int samples_ = 1;
    scene::TextureId black_ = scene::TextureId::None;
    std::vector<TorchScene> scenes_;
    glm::dmat4 prop_from_artifact_{1.0};
    geometry::Box box_;
    std::map<scene::MeshId, std::vector<glm::dvec3>> unit_positions_;
};

} // namespace frustumscreen::bench

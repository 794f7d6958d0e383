#include "assets_baked/bake/world_cells.h"

#include "app/pack/container/limits.h"
#include "assets_baked/bake/bake_region.h"
#include "assets_baked/bake/cell_mesh.h"
#include "assets_baked/bake/source_scene.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/matrix_inverse.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

namespace frustumscreen::bake {

namespace {

constexpr int min_size = 16; ///< texels, as of a whole
constexpr double min_extent_box = 1e-6;
constexpr double min_measuring = 0.05; ///< share of the whole's: fewer points would find no largest error

/// False for a frame that is pressed flat: what hangs from it has no place of its own.
bool has_inverse(const glm::dmat4& transform) {
    constexpr double min_independence = 1e-8; // of its axes; pack_world.h allows a little less
    const glm::dmat3 linear(transform);
    const double lengths = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    return lengths > 0.0 && std::isfinite(lengths) &&
           std::abs(glm::determinant(linear)) >= min_independence * lengths;
}

/// Without what rounding, or a file, leaves in the last row.
glm::dmat4 affine(glm::dmat4 transform) {
    for (int column = 0; column < 4; ++column) {
        transform[column].w = column == 3 ? 1.0 : 0.0;
    }
    return transform;
}

struct Bounds {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    [[nodiscard]] double longest() const {
        const glm::dvec3 size = high - low;
        return std::max({size.x, size.y, size.z});
    }
};

Bounds bounds_of(const SourceMesh& mesh) {
    Bounds bounds;
    for (const glm::dvec3& position : mesh.positions) {
        bounds.low = glm::min(bounds.low, position);
        bounds.high = glm::max(bounds.high, position);
    }
    return bounds;
}

class Cells {
public:
    Cells(const SourceMesh& mesh, const BoxFrame& frame, const BakeOptions& options, CellSides sides)
        : mesh_(mesh), frame_(frame), options_(options), sides_(sides) {}

    [[nodiscard]] WorldCells bake() {
        make_tree();
        std::vector<std::optional<std::size_t>> cell_of_triangle;
        for (const std::uint32_t node : mesh_.triangle_nodes) {
            cell_of_triangle.push_back(holder_[node]);
        }
        CellMeshes meshes(mesh_, frame_, cell_of_triangle, made_.cells.size());
        for (std::size_t k = 0; k < made_.cells.size(); ++k) {
            weights_.push_back(meshes.triangles_of(k) == 0 ? 0.0 : 1.0);
        }
        if (!options_.unlit || sides_ == CellSides::OfSite) {
            whole_.emplace(mesh_, meshes.points());
        }
        const double all = std::max(1.0, std::accumulate(weights_.begin(), weights_.end(), 0.0));
        double done = 0.0;
        for (std::size_t k = 0; k < made_.cells.size(); ++k) {
            made_.geometry.emplace_back();
            if (meshes.triangles_of(k) > 0) {
                bake_cell(k, meshes.mesh_of(k), done / all, (done + weights_[k]) / all);
            }
            done += weights_[k];
        }
        tell();
        options_.progress("parts", 1.0);
        return std::move(made_);
    }

private:
    /// A cell for each node whose frame, and those above it, can be turned back.
    void make_tree() {
        made_.cell_of.resize(mesh_.nodes.size());
        holder_.resize(mesh_.nodes.size());
        for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) {
            const SourceNode& node = mesh_.nodes[n];
            const glm::dmat4 parent_from_base =
                affine(node.parent ? node.parent_from_base : frame_.box_from_file * node.parent_from_base);
            const glm::dmat4 above = node.parent && made_.cell_of[*node.parent]
                                         ? box_from_cell_[*made_.cell_of[*node.parent]]
                                         : glm::dmat4(1.0);
            const glm::dmat4 box_from_cell = above * parent_from_base * node.rest.matrix();
            const bool hangs = !node.parent || made_.cell_of[*node.parent];
            if (!hangs || !has_inverse(parent_from_base) || !has_inverse(node.rest.matrix()) ||
                !has_inverse(box_from_cell)) {
                holder_[n] = node.parent ? holder_[*node.parent] : std::nullopt;
                flat_.push_back(node.name);
                continue;
            }
            made_.cell_of[n] = holder_[n] = made_.cells.size();
            box_from_cell_.push_back(box_from_cell);
            pack::PackCell& cell = made_.cells.emplace_back();
            cell.cell.name = node.name;
            cell.cell.parent = node.parent ? made_.cell_of[*node.parent] : std::nullopt;
            cell.cell.parent_from_base = parent_from_base;
            cell.cell.rest = node.rest;
        }
    }

    [[nodiscard]] BakeOptions options_of(const Bounds& bounds, double begin, double end) const {
        const double longest = bounds.longest();
        BakeOptions options = options_;
        options.of_site = sides_ == CellSides::OfSite;
        const double shown = options.of_site ? 0.5 : longest; // a region of a site fills the prop
        options.size = std::clamp(static_cast<int>(std::ceil(options_.size * shown)), min_size,
                                  std::max(min_size, options_.size));
        options.relief = options_.relief && !options.of_site;
        options.up = "z";
        options.turn_deg = 0.0;
        options.lift = 0.0;
        options.scale =
            options.of_site ? 1.0 : std::clamp(options_.scale * longest, pack::min_scale, pack::max_scale);
        options.measuring = options_.measuring * std::clamp(longest, min_measuring, 1.0);
        options.hotspots.clear();
        options.torches = {}; // a cell has the layers alone
        options.torch_parts = {};
        options.table_picture = false;
        if (whole_ && !options_.unlit) {
            const glm::dvec3 middle = glm::mix(bounds.low, bounds.high, 0.5);
            options.part = {
                .whole = &*whole_, .origin = {middle.x, middle.y, bounds.low.z}, .scale = longest};
        }
        if (sides_ == CellSides::All) {
            options.prop.zone = ViewingZone::all_around();
        }
        options.progress = [this, begin, end](std::string_view, double done) {
            options_.progress("parts", std::lerp(begin, end, done));
        };
        return options;
    }

    void bake_cell(std::size_t k, const SourceMesh& mesh, double begin, double end) {
        const Bounds bounds = bounds_of(mesh);
        pack::PackCell& cell = made_.cells[k];
        if (!(bounds.longest() >= min_extent_box)) {
            flat_.push_back(cell.cell.name);
            return;
        }
        const std::vector<CurtainTriangle> curtains =
            sides_ == CellSides::OfSite ? site_curtains(mesh, *whole_, 0.5 * glm::dvec2(frame_.box_size))
                                        : std::vector<CurtainTriangle>();
        Result<pack::Pack> baked = bake_region(mesh, options_of(bounds, begin, end), curtains);
        if (!baked) { // has triangles, and yet no surface
            flat_.push_back(cell.cell.name);
            return;
        }
        pack::Pack pack = *std::move(baked);
        pack.title = cell.cell.name;
        cell.cell.has_geometry = true;
        cell.cell.cell_from_geometry = affine(glm::inverse(pack.box_from_file * box_from_cell_[k]));
        cell.triangles = mesh.triangles.size();
        cell.low = bounds.low;
        cell.high = bounds.high;
        made_.geometry[k] = std::move(pack);
    }

    void tell() {
        if (!flat_.empty() && sides_ == CellSides::OfSite) {
            made_.notes.push_back(
                {SourceNote::Kind::Lost,
                 fmt::format("parts of the site that have no surface ({}), where it is shown large",
                             printable(fmt::format("{}", fmt::join(flat_, ", ")), 200))});
        } else if (!flat_.empty()) {
            made_.notes.push_back(
                {SourceNote::Kind::Lost,
                 fmt::format(
                     "movements of parts that have no surface at rest ({}): give them one in the model; "
                     "they do not move",
                     printable(fmt::format("{}", fmt::join(flat_, ", ")), 200))});
        }
    }

    const SourceMesh& mesh_;
    const BoxFrame& frame_;
    const BakeOptions& options_;
    std::optional<SourceScene> whole_; ///< shadows the cells, and lies under their cuts
    CellSides sides_;
    WorldCells made_;
    std::vector<std::optional<std::size_t>> holder_; ///< of each node: the cell of its triangles
    std::vector<glm::dmat4> box_from_cell_;          ///< of each cell, at rest
    std::vector<double> weights_;                    ///< of each cell's bake, for the progress
    std::vector<std::string> flat_;
};

} // namespace

WorldCells bake_cells(const SourceMesh& mesh, const BoxFrame& frame, const BakeOptions& options,
                      CellSides sides) {
    return Cells(mesh, frame, options, sides).bake();
}

} // namespace frustumscreen::bake

#include "app/ldi/patch_relief.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace frustumscreen::ldi {

namespace {

constexpr double everything = std::numeric_limits<double>::infinity();

bool is_drawable(const TriangleWorld& world, std::size_t triangle) {
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t index = world.indices[3 * triangle + k];
        if (index >= world.positions.size()) {
            return false;
        }
        const glm::vec3& at = world.positions[index];
        if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z)) {
            return false;
        }
    }
    return true;
}

int pixels_for(double extent_m, double texel_m) {
    constexpr double max_pixels = 1024.0;
    return static_cast<int>(std::clamp(std::ceil(2.0 * extent_m / texel_m), 1.0, max_pixels));
}

template <typename Value> std::uint64_t capacity_bytes(const std::vector<Value>& values) {
    return values.capacity() * sizeof(Value);
}

} // namespace

PatchBuild::PatchBuild(const TriangleWorld& world, const Hemisphere& hemisphere, CameraViews& views,
                       std::size_t patch, const PatchLimits& limits)
    : world_(world), hemisphere_(hemisphere), views_(views), patch_(patch), limits_(limits),
      view_(hemisphere, patch, limits.half_extent_m, limits.texel_m), low_(everything), high_(-everything) {
    assert(limits.texel_m > 0.0 && limits.half_extent_m.x > 0.0 && limits.half_extent_m.y > 0.0);
}

bool PatchBuild::step(std::size_t triangles) {
    switch (stage_) {
    case Stage::Cameras:
        if (!views_.draw_part(hemisphere_.cameras_of(patch_), triangles)) {
            stage_ = Stage::Facing;
        }
        break;
    case Stage::Facing:
        find_facing(triangles);
        break;
    case Stage::Counting:
        count(triangles);
        break;
    case Stage::Sorting:
        sort(triangles);
        break;
    case Stage::Bands:
        make_band();
        break;
    case Stage::Done:
        break;
    }
    return stage_ != Stage::Done;
}

void PatchBuild::find_facing(std::size_t triangles) {
    const std::size_t count = world_.triangle_count();
    for (const std::size_t end = std::min(count, next_ + triangles); next_ < end; ++next_) {
        const auto triangle = static_cast<std::uint32_t>(next_);
        if (!is_drawable(world_, next_)) {
            continue;
        }
        const FacingTriangle facing = view_.facing(world_, triangle);
        if (facing.drawn != 0) {
            facing_.push_back(facing);
            view_.widen(world_, triangle, low_, high_);
        }
    }
    if (next_ == count) {
        if (facing_.empty()) {
            finish();
        } else {
            begin_grids(limits_.texel_m);
        }
    }
}

void PatchBuild::begin_grids(double texel_m) {
    texel_m_ = PatchGrids::allowed_texel_m(low_, high_, texel_m);
    grids_.emplace(view_, low_, high_, texel_m_);
    for (std::size_t k = 0; k < grid_directions; ++k) {
        first_band_[k + 1] = first_band_[k] + static_cast<std::size_t>(grids_->directions[k].bands());
    }
    first_of_band_.assign(first_band_.back() + 1, 0);
    of_bands_.clear();
    blocks_ = {};
    made_ = {};
    roughness_ = {};
    next_ = 0;
    stage_ = Stage::Counting;
}

template <typename Visit>
void PatchBuild::for_each_band(const FacingTriangle& facing, const Visit& visit) const {
    std::array<glm::dvec3, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = world_.positions[world_.indices[3 * std::size_t{facing.triangle} + k]];
    }
    for (std::size_t direction = 0; direction < grid_directions; ++direction) {
        if ((facing.drawn >> direction & 1U) == 0) {
            continue;
        }
        const PatchGrid& grid = grids_->directions[direction];
        const glm::dmat4& matrix = grid.grid_from_window;
        const auto row = [&matrix](const glm::dvec3& point) {
            return matrix[0].y * point.x + matrix[1].y * point.y + matrix[2].y * point.z + matrix[3].y;
        };
        const auto [low, high] = std::minmax({row(corners[0]), row(corners[1]), row(corners[2])});
        // A line between two bands belongs to both.
        const double first = std::max(0.0, std::ceil(low / relief::block_cells) - 1.0);
        const double last = std::min(grid.bands() - 1.0, std::floor(high / relief::block_cells));
        for (double band = first; band <= last; band += 1.0) {
            visit(first_band_[direction] + static_cast<std::size_t>(band));
        }
    }
}

void PatchBuild::count(std::size_t triangles) {
    for (const std::size_t end = std::min(facing_.size(), next_ + triangles); next_ < end; ++next_) {
        for_each_band(facing_[next_], [this](std::size_t band) { ++first_of_band_[band + 1]; });
    }
    if (next_ < facing_.size()) {
        return;
    }
    std::uint64_t all = 0;
    for (const std::uint32_t of_band : first_of_band_) {
        all += of_band;
    }
    if (sizeof(std::uint32_t) * all > limits_.max_bytes / 2 + 12 * facing_.size()) {
        begin_grids(2.0 * texel_m_);
        return;
    }
    for (std::size_t k = 1; k < first_of_band_.size(); ++k) {
        first_of_band_[k] += first_of_band_[k - 1];
    }
    of_bands_.resize(all);
    next_ = 0;
    stage_ = Stage::Sorting;
}

void PatchBuild::sort(std::size_t triangles) {
    // The start of each band moves to its end, which is the next one's start.
    for (const std::size_t end = std::min(facing_.size(), next_ + triangles); next_ < end; ++next_) {
        for_each_band(facing_[next_], [this](std::size_t band) {
            of_bands_[first_of_band_[band]++] = static_cast<std::uint32_t>(next_);
        });
    }
    if (next_ == facing_.size()) {
        for (std::size_t k = first_of_band_.size() - 1; k > 0; --k) {
            first_of_band_[k] = first_of_band_[k - 1];
        }
        first_of_band_[0] = 0;
        next_ = 0;
        stage_ = Stage::Bands;
    }
}

void PatchBuild::make_band() {
    while (next_ < first_band_.back() && first_of_band_[next_] == first_of_band_[next_ + 1]) {
        ++next_;
    }
    if (next_ == first_band_.back()) {
        finish();
        return;
    }
    const auto direction = static_cast<std::size_t>(
        std::upper_bound(first_band_.begin(), first_band_.end(), next_) - first_band_.begin() - 1);
    const BandScene scene{.world = world_,
                          .view = view_,
                          .views = views_,
                          .cameras = hemisphere_.cameras_of(patch_),
                          .grid = grids_->directions[direction],
                          .direction = direction,
                          .texel_m = texel_m_,
                          .max_bytes = limits_.max_bytes / 2};
    const std::uint32_t first = first_of_band_[next_];
    const std::uint32_t end = first_of_band_[next_ + 1];
    append_direction(direction);
    const bool made = band_.make(scene, static_cast<int>(next_ - first_band_[direction]), facing_,
                                 std::span(of_bands_).subspan(first, end - first), blocks_, roughness_);
    ++next_;
    if (!made || grown_bytes() > limits_.max_bytes) {
        coarsen(static_cast<double>(end) / static_cast<double>(of_bands_.size()));
    }
}

void PatchBuild::append_direction(std::size_t direction) {
    relief::BlockRelief& relief = made_.relief;
    const relief::ReliefGrid& grid = grids_->directions[direction].grid;
    if (relief.grids.empty() || relief.grids.back().axis != grid.axis ||
        relief.grids.back().sign != grid.sign) {
        relief.grids.push_back(grid);
        relief.first_block.push_back(static_cast<std::uint32_t>(blocks_.blocks.size()));
    }
}

std::uint64_t PatchBuild::grown_bytes() const {
    const std::uint64_t entries = capacity_bytes(of_bands_);
    return entries - std::min<std::uint64_t>(entries, 12 * facing_.size()) + capacity_bytes(first_of_band_) +
           band_.grown_bytes() + capacity_bytes(blocks_.blocks) + capacity_bytes(blocks_.corner_codes) +
           capacity_bytes(blocks_.covers) + capacity_bytes(blocks_.colours);
}

std::uint64_t PatchBuild::bytes() const {
    return grown_bytes() + std::min<std::uint64_t>(capacity_bytes(of_bands_), 12 * facing_.size()) +
           capacity_bytes(facing_) + band_.bytes() - band_.grown_bytes();
}

void PatchBuild::coarsen(double done_share) {
    const double over =
        static_cast<double>(grown_bytes()) / static_cast<double>(limits_.max_bytes) / done_share;
    band_ = {};
    is_refined_ = true; // the memory limits the texel: no second try
    begin_grids(texel_m_ * std::clamp(std::sqrt(over), 1.2, 8.0));
}

void PatchBuild::finish() {
    const double error = roughness_.lines == 0
                             ? 0.0
                             : std::sqrt(roughness_.squares / static_cast<double>(roughness_.lines)) *
                                   texel_m_ / limits_.texel_m;
    constexpr std::uint64_t finer = 4; // half the texel takes four times the bytes
    if (!is_refined_ && error > limits_.max_error_texels && finer * grown_bytes() <= limits_.max_bytes) {
        is_refined_ = true;
        begin_grids(0.5 * texel_m_);
        return;
    }
    relief::BlockRelief& relief = made_.relief;
    relief.first_block.push_back(static_cast<std::uint32_t>(blocks_.blocks.size()));
    relief.texel_box = static_cast<float>(limits_.texel_m);
    if (grids_) {
        relief.texel_box = static_cast<float>(grids_->texel_m / grids_->box_m);
        made_.window_from_box = grids_->window_from_box;
        made_.box_size = grids_->box_size;
    }
    relief.blocks = std::move(blocks_.blocks);
    relief.corner_codes = std::move(blocks_.corner_codes);
    relief.covers = std::move(blocks_.covers);
    relief.colours = std::move(blocks_.colours);
    relief.blocks.shrink_to_fit();
    relief.corner_codes.shrink_to_fit();
    relief.covers.shrink_to_fit();
    relief.colours.shrink_to_fit();
    made_.texel_m = texel_m_ > 0.0 ? texel_m_ : limits_.texel_m;
    made_.error_texels = error;
    facing_ = {};
    of_bands_ = {};
    first_of_band_ = {};
    band_ = {};
    stage_ = Stage::Done;
}

CameraViews camera_views_for(const TriangleWorld& world, const Hemisphere& hemisphere,
                             const PatchLimits& limits) {
    return {world, hemisphere, limits.half_extent_m, pixels_for(limits.half_extent_m.x, limits.texel_m),
            pixels_for(limits.half_extent_m.y, limits.texel_m)};
}

PatchRelief make_patch_relief(const TriangleWorld& world, const Hemisphere& hemisphere, std::size_t patch,
                              const PatchLimits& limits) {
    CameraViews views = camera_views_for(world, hemisphere, limits);
    PatchBuild build(world, hemisphere, views, patch, limits);
    while (build.step(world.triangle_count() + 1)) {
    }
    return build.take();
}

} // namespace frustumscreen::ldi

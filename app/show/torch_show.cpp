#include "app/show/torch_show.h"

#include "app/geometry/time_curves.h"
#include "app/scene/scene_level.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::show {

namespace {

constexpr int spot_px = 64;

/// A disc, soft from two thirds of its radius on.
image::Image<std::uint8_t> spot_picture() {
    image::Image<std::uint8_t> picture(spot_px, spot_px);
    const double middle = 0.5 * spot_px;
    for (int row = 0; row < spot_px; ++row) {
        for (int column = 0; column < spot_px; ++column) {
            const double radius = std::hypot(column + 0.5 - middle, row + 0.5 - middle) / middle;
            picture.at(column, row) =
                static_cast<std::uint8_t>(std::lround(255.0 * geometry::ease(3.0 * (1.0 - radius))));
        }
    }
    return picture;
}

bool is_tinted(torch::Source source) {
    return source == torch::Source::Plain || source == torch::Source::Ring || source == torch::Source::Grid ||
           source == torch::Source::Ruler;
}

/// A light on the surface's own colours restores, where it is full, the brightness that the house's light takes away. A content that
/// covers the surface fades with the artifact's light; a light on the artifact's colours does so without a factor.
double strength(torch::Blend blend, const exhibit::Presentation& presentation) {
    const double house_light = presentation.torches.house_light;
    return blend == torch::Blend::Light ? std::max(1.0, 1.0 / house_light - 1.0)
                                        : std::clamp(presentation.brightness / house_light, 0.0, 1.0);
}

} // namespace

ShownTorch shown_torch(const exhibit::Presentation& presentation, const residency::TorchContents* contents) {
    ShownTorch shown{.held = presentation.torches.held, .aim = presentation.torches.aim, .content = {}};
    for (const exhibit::PresentedLight& light : presentation.torches.lights()) {
        if (light.left || light.colour != shown.held) {
            continue;
        }
        const torch::Content* const content = light.content && contents != nullptr
                                                  ? contents->find(presentation.artifact, *light.content)
                                                  : nullptr;
        shown.lit = true;
        shown.content = content != nullptr ? std::string_view(content->name) : torch::white_name;
    }
    return shown;
}

status::TorchReport torch_report(const ShownTorch& shown, std::span<const tracking::TrackedTorch> torches) {
    constexpr std::array<std::string_view, tracking::max_tracked_torches> by{"tracker", "tag"};
    const auto nearest = std::max_element(
        torches.begin(), torches.end(), [](const tracking::TrackedTorch& a, const tracking::TrackedTorch& b) {
            return a.presence < b.presence;
        });
    if (!shown.held && (nearest == torches.end() || nearest->presence == tracking::TorchPresence::Lost)) {
        return {};
    }
    const std::size_t number = shown.held.value_or(static_cast<std::size_t>(nearest - torches.begin()));
    status::TorchReport report{.by = std::string(by.at(number)), .content = std::string(shown.content)};
    if (!shown.held && nearest->presence == tracking::TorchPresence::Lies) {
        report.state = "laid_down";
    } else if (shown.aim == exhibit::TorchAim::Past || shown.aim == exhibit::TorchAim::TooFar) {
        report.state = shown.aim == exhibit::TorchAim::Past ? "past" : "too_far";
    } else {
        report.state = shown.lit ? "lit" : "dark";
    }
    return report;
}

Result<void> TorchShow::prepare(render::GpuStore& store) {
    TRY(spot_, store.upload(spot_picture()));
    return {};
}

std::uint64_t TorchShow::planned_gpu_bytes() const {
    return scene::caption_gpu_bytes(spot_px, spot_px);
}

void TorchShow::place_spots(const exhibit::Presentation& presentation, residency::OnTable& on_table) const {
    for (const exhibit::PresentedLight& light : presentation.torches.lights()) {
        torch::Beam beam = beam_;
        beam.opening_rad = light.opening_rad;
        const std::optional<exhibit::TorchSpot> spot =
            light.left ? std::nullopt : exhibit::spot_on_table(beam, light.table_from_torch);
        if (spot) {
            on_table.add({.corners_m = residency::flat_corners(spot->corners()),
                          .brightness = spot_brightness * spot->share * light.brightness,
                          .texture = spot_});
        }
    }
}

std::span<const scene::PlacedTorch> TorchShow::place(const exhibit::Presentation& presentation,
                                                     const residency::TorchContents& contents) {
    std::size_t count = 0;
    for (const exhibit::PresentedLight& light : presentation.torches.lights()) {
        const torch::Content* const thrown =
            light.content ? contents.find(presentation.artifact, *light.content) : &white_;
        residency::TorchContents::Shown shown{.ready = !light.content};
        if (light.content && contents.artifact() == presentation.artifact) {
            shown = contents.shown(*light.content);
        }
        if (thrown == nullptr || !shown.ready) {
            continue;
        }
        torch::Beam beam = beam_;
        beam.opening_rad = light.opening_rad;
        scene::PlacedTorch& placed = placed_.at(count++);
        placed = scene::placed(*thrown, beam, light.table_from_torch, light.seconds);
        placed.picture = shown.picture;
        placed.picture_version = shown.version;
        placed.brightness = static_cast<float>(light.brightness * strength(thrown->blend, presentation));
        for (std::size_t k = 0; k < placed.stage_count; ++k) {
            if (is_tinted(placed.stages.at(k).source)) {
                placed.stages.at(k).colour *= exhibit::torch_colours.at(light.colour);
            }
        }
    }
    return std::span(placed_).first(count);
}

std::span<const scene::PlacedTorch> TorchShow::sample(const glm::dvec2& place_m) {
    constexpr double height_m = 0.4;
    placed_[0] =
        scene::placed(white_, beam_, {glm::dquat(0.0, 1.0, 0.0, 0.0), glm::dvec3(place_m, height_m)}, 0.0);
    return std::span(placed_).first(1);
}

WantedContents wanted_contents(const exhibit::Presentation& presentation,
                               const residency::TorchContents& contents) {
    WantedContents wanted;
    for (const exhibit::PresentedLight& light : presentation.torches.lights()) {
        if (light.content && contents.find(presentation.artifact, *light.content) != nullptr) {
            wanted.contents.at(wanted.count++) = {*light.content, light.seconds};
        }
    }
    return wanted;
}

} // namespace frustumscreen::show

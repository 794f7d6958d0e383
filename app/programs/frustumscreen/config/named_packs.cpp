#include "app/programs/frustumscreen/config/named_packs.h"

#include "app/pack/pack_file.h"
#include "app/pack/pack_hull.h"
#include "app/residency/artifact_opener.h"
#include "app/residency/artifact_texts.h"
#include "app/show/exhibit_place.h"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

namespace frustumscreen::programs {

namespace {

std::optional<NamedPack> read(const settings::Settings& settings, const std::filesystem::path& file) {
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    const auto no_levels = [](const pack::PackOutline&) { return Result<std::vector<std::uint32_t>>(); };
    const Result<pack::VerifiedPack> pack = pack::load_pack(file, no_levels);
    if (!pack) {
        return std::nullopt;
    }
    NamedPack named{**pack, {}, {}};
    std::vector<std::size_t> captions(named.description.captions.size());
    std::iota(captions.begin(), captions.end(), std::size_t{0});
    const auto texts = residency::lay_out_texts({file, named.description, captions},
                                                pack::place(named.description, prop).metres_per_box,
                                                residency::text_style(settings), false);
    const auto hull = pack::hull_in(named.description, prop);
    if (!texts || !hull) {
        return std::nullopt;
    }
    named.entry = texts->entry;
    named.hull = *hull;
    return named;
}

} // namespace

std::vector<NamedPack> named_packs(const settings::Settings& settings) {
    std::vector<NamedPack> packs;
    for (const std::filesystem::path& file : settings.exhibit.packs) {
        if (std::optional<NamedPack> pack = read(settings, file)) {
            packs.push_back(std::move(*pack));
        }
    }
    return packs;
}

double caption_share(const settings::Settings& settings, const std::vector<NamedPack>& packs,
                     const settings::Rectangle& zone) {
    exhibit::Catalogue catalogue;
    std::transform(packs.begin(), packs.end(), std::back_inserter(catalogue),
                   [](const NamedPack& pack) { return pack.entry; });
    exhibit::ExhibitPlace place = show::exhibit_place(settings);
    place.guidance.reset(); // advice takes the caption's place
    constexpr int columns = 7;
    constexpr int rows = 5;
    constexpr std::array turns{0.0, 0.25 * std::numbers::pi};
    int shown = 0;
    for (int k = 0; k < columns * rows; ++k) {
        const glm::ivec2 node(k % columns, k / columns);
        const glm::dvec2 at = 2.0 * glm::dvec2(node) / glm::dvec2(columns - 1, rows - 1) - 1.0;
        for (const double turn : turns) {
            tracking::TrackedState tracked_state;
            tracked_state.table_from_prop = {glm::angleAxis(turn, glm::dvec3(0.0, 0.0, 1.0)),
                                             glm::dvec3(zone.centre_m + at * zone.half_m, 0.0)};
            tracked_state.eye_m = settings.eye.default_m;
            tracked_state.prop_known = tracked_state.head_known = true;
            // Long enough for all fades, and too short for a narration.
            constexpr int steps = 20;
            constexpr Nanoseconds step = std::chrono::milliseconds(100);
            exhibit::Exhibit exhibit(catalogue, place, settings.exhibit.language, MonotonicTime());
            bool lies = false;
            for (int k_step = 0; k_step <= steps; ++k_step) {
                constexpr double readable = 0.5;
                const exhibit::Presentation presented =
                    exhibit.step(MonotonicTime() + k_step * step, {}, tracked_state);
                lies = presented.caption && presented.caption->brightness > readable;
            }
            shown += lies ? 1 : 0;
        }
    }
    return static_cast<double>(shown) / (columns * rows * static_cast<int>(turns.size()));
}

} // namespace frustumscreen::programs

#include "app/bench/room/room_bench.h"

#include "app/bench/measures/timing.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <utility>

namespace frustumscreen::bench {

void time_room(std::span<TimedTechnique> timed, std::span<const RoomWalk> walks, int passes,
               const RoomProgress& progress) {
    for (TimedTechnique& each : timed) {
        each.times.frames.clear();
        for (std::size_t walk = 0; walk < walks.size(); ++walk) {
            for (std::size_t frame = 0; frame < walks[walk].frames.size();
                 frame += static_cast<std::size_t>(each.every)) {
                each.times.frames.push_back({walk, frame, std::numeric_limits<double>::infinity(), 0.0});
            }
        }
    }
    const double turns = static_cast<double>(timed.size()) * passes;
    for (int pass = 0; pass < passes; ++pass) {
        for (std::size_t k = 0; k < timed.size(); ++k) {
            progress("times", static_cast<double>(static_cast<std::size_t>(pass) * timed.size() + k) / turns);
            for (RoomFrameTime& at : timed[k].times.frames) {
                const auto start = std::chrono::steady_clock::now();
                keep_min_ms(at.ms, [&] { timed[k].technique->draw(walks[at.walk].frames[at.frame]); });
                const std::chrono::duration<double, std::milli> wall =
                    std::chrono::steady_clock::now() - start;
                at.wall_ms = pass == 0 ? wall.count() : at.wall_ms;
            }
        }
    }
}

namespace {

using Made = std::unique_ptr<RoomTechnique>;

/// A technique's settings from the coarsest, which is the cheapest, to the finest.
struct Settings {
    std::size_t count = 0;
    std::function<Made(std::size_t)> make;
};
struct Chosen {
    Made technique;
    RoomError error;
    std::size_t setting = 0;
};

/// The coarsest setting whose error is not above `max_mm`; otherwise the finest.
Result<Chosen> coarsest_within(RoomErrors& errors, const Settings& settings, double max_mm) {
    std::size_t low = 0; // all before it err more
    std::size_t high = settings.count - 1;
    Chosen chosen{settings.make(high), {}, high};
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        Made technique = settings.make(middle);
        TRY(const RoomError error, errors.measure(*technique, false));
        if (error.mean_mm <= max_mm) {
            chosen = {std::move(technique), error, middle};
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    if (chosen.error.ms <= 0.0) {
        TRY(chosen.error, errors.measure(*chosen.technique, false));
    }
    return chosen;
}

/// From `coarsest` down in equal ratios, then 0: the finest.
template <std::size_t Count> constexpr std::array<double, Count> steps_from(double coarsest, double ratio) {
    std::array<double, Count> steps{};
    for (std::size_t k = 0; k + 1 < Count; ++k, coarsest *= ratio) {
        steps[k] = coarsest;
    }
    return steps;
}
/// The pack's mean error in millimetres that each object may have; of reliefs a pack has few.
constexpr std::array error_steps_mm = steps_from<24>(16.0, 0.8);
constexpr std::array relief_steps_mm = steps_from<4>(8.0, 0.25);
constexpr std::array error_steps_px = steps_from<24>(8.0, 0.8);
/// Shares of all polygons that a frame may draw.
constexpr std::array budget_shares{0.0, 0.005, 0.01, 0.02, 0.03, 0.05, 0.1, 0.15,
                                   0.2, 0.3,   0.4,  0.55, 0.7,  0.85, 1.0};

class Peers {
public:
    Peers(RoomSet& set, RoomErrors& errors, double max_mm) : set_(set), errors_(errors), max_mm_(max_mm) {}

    [[nodiscard]] Result<Chosen> polygons() {
        TRY(Chosen chosen, coarsest_within(errors_,
                                           {error_steps_mm.size(),
                                            [this](std::size_t k) {
                                                return make_room_polygons(set_, error_steps_mm.at(k));
                                            }},
                                           max_mm_));
        paper_polygons_.error_mm = error_steps_mm.at(chosen.setting);
        return chosen;
    }
    /// Floor and walls in the way that suits it better.
    [[nodiscard]] Result<Chosen> relief() {
        std::array<Chosen, 2> chosen;
        for (const bool shell_as_polygons : {false, true}) {
            TRY(chosen.at(shell_as_polygons ? 1 : 0),
                coarsest_within(errors_,
                                {relief_steps_mm.size(),
                                 [this, shell_as_polygons](std::size_t k) {
                                     return make_room_relief(set_, relief_steps_mm.at(k), shell_as_polygons);
                                 }},
                                max_mm_));
        }
        auto& [relief, mixed] = chosen;
        const bool both = (relief.error.mean_mm <= max_mm_) == (mixed.error.mean_mm <= max_mm_);
        const bool second = both ? mixed.error.ms < relief.error.ms : mixed.error.mean_mm <= max_mm_;
        return std::move(second ? mixed : relief);
    }
    [[nodiscard]] Result<Chosen> lod() {
        return coarsest_within(errors_,
                               {error_steps_px.size(),
                                [this](std::size_t k) { return make_room_lod(set_, error_steps_px.at(k)); }},
                               max_mm_);
    }
    /// `learned`: frames of another walk. After `polygons`, whose level it draws.
    [[nodiscard]] Result<Chosen> paper(std::span<const RoomFrame> learned, PaperWeights& weights) {
        weights = room_weights(set_, paper_polygons_, learned);
        const double all = all_room_polygons(set_, paper_polygons_);
        return coarsest_within(errors_,
                               {budget_shares.size(),
                                [&](std::size_t k) {
                                    return make_room_paper(set_, weights, paper_polygons_,
                                                           budget_shares.at(k) * all);
                                }},
                               max_mm_);
    }

private:
    RoomSet& set_;
    RoomErrors& errors_;
    double max_mm_;
    PaperPolygons paper_polygons_;
};

std::vector<RoomFrame> every(std::size_t step, const RoomWalk& walk) {
    std::vector<RoomFrame> thin;
    for (std::size_t k = step / 2; k < walk.frames.size(); k += step) {
        thin.push_back(walk.frames[k]);
        thin.back().eye_m.x = -thin.back().eye_m.x; // another walk
    }
    return thin;
}

} // namespace

Result<RoomResult> measure_room(RoomSet& set, const std::vector<RoomWalk>& walks, const RoomOptions& options,
                                const RoomProgress& progress) {
    RoomResult result{.objects = set.room().objects.size(),
                      .triangles = set.source_triangles(),
                      .walks = {},
                      .weights = {},
                      .rows = {},
                      .paper = {}};
    for (const RoomWalk& walk : walks) {
        result.walks.push_back(walk.name);
    }
    progress("the truth", 0.0);
    TRY(const std::unique_ptr<RoomTruth> truth,
        RoomTruth::build(set.room(), set.sources(), set.box_from_file()));
    TRY(const std::unique_ptr<RoomErrors> errors,
        RoomErrors::create(set, *truth, walks, options.errors,
                           [&](double done) { progress("the truth", done); }));
    progress("the peers' settings", 0.0);
    std::vector<Chosen> chosen(1);
    TRY(chosen[0].technique, make_room_ours(set));
    TRY(chosen[0].error, errors->measure(*chosen[0].technique, true));

    Peers peers(set, *errors, chosen[0].error.mean_mm);
    const auto add = [&](Result<Chosen> peer) -> Result<void> {
        TRY(Chosen found, std::move(peer));
        chosen.push_back(std::move(found));
        progress("the peers' settings", static_cast<double>(chosen.size() - 1) / 4.0);
        return {};
    };
    TRY_VOID(add(peers.polygons()));
    TRY_VOID(add(peers.relief()));
    TRY_VOID(add(peers.lod()));
    const std::vector<RoomFrame> learned =
        every(std::max<std::size_t>(walks.front().frames.size() / 12, 1), walks.front());
    TRY_VOID(add(peers.paper(learned, result.weights)));

    std::vector<TimedTechnique> timed;
    for (const Chosen& each : chosen) {
        timed.push_back({each.technique.get(), timed.empty() ? 1 : options.peer_every});
    }
    time_room(timed, walks, options.passes, progress);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        const RoomTechnique& technique = *chosen[k].technique;
        result.rows.push_back(
            {technique.name(), technique.setting(), std::move(timed[k].times), chosen[k].error});
    }
    TRY(result.paper,
        measure_paper_numbers(set, *truth, *chosen[0].technique, walks.front(), options, progress));
    return result;
}

} // namespace frustumscreen::bench

#include "app/bench/room/room_bench.h"
#include "firmware_host/base/quantile.h"

#include <algorithm>
#include <array>
#include <utility>

namespace frustumscreen::bench {

namespace {

/// The paper's machine, and faster ones.
constexpr std::array machines_polygons_s{paper_polygons_s, 1e1 * paper_polygons_s, 1e2 * paper_polygons_s,
                                         1e3 * paper_polygons_s, 4e3 * paper_polygons_s};

/// The polygons that each frame that is timed hands to the driver.
std::vector<double> polygons_of(RoomTechnique& technique, const RoomWalk& walk, int every_frames) {
    std::vector<double> polygons;
    for (std::size_t frame = 0; frame < walk.frames.size(); frame += static_cast<std::size_t>(every_frames)) {
        technique.draw(walk.frames[frame]);
        polygons.push_back(static_cast<double>(technique.plan().indices.size() / 3));
    }
    return polygons;
}

} // namespace

Result<std::vector<RoomPaperRow>> measure_paper_numbers(RoomSet& set, RoomTruth& truth, RoomTechnique& ours,
                                                        const RoomWalk& walk, const RoomOptions& options,
                                                        const RoomProgress& progress) {
    const std::string step = "the paper's own numbers";
    progress(step, 0.0);
    const std::vector<RoomWalk> walks{walk};
    TRY(const std::unique_ptr<RoomErrors> errors,
        RoomErrors::create(set, truth, walks, options.errors, [](double) {}));
    const PaperPolygons each{.error_mm = 0.0, .each = paper_polygons_each};
    std::vector<RoomFrame> learned(walk.frames.begin(), walk.frames.begin() + 1);
    learned.push_back(walk.frames[walk.frames.size() / 2]);
    const PaperWeights weights = room_weights(set, each, learned);

    std::vector<std::unique_ptr<RoomTechnique>> made;
    std::vector<RoomPaperRow> rows;
    for (const double polygons_s : machines_polygons_s) {
        made.push_back(make_room_paper(set, weights, each, polygons_s / paper_min_fps));
        rows.push_back({.technique = "paper", .polygons_s = polygons_s});
    }
    made.push_back(make_room_paper(set, weights, each, all_room_polygons(set, each)));
    rows.push_back({.technique = "paper"});
    rows.push_back({.technique = "ours"});
    std::vector<TimedTechnique> timed;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        timed.push_back({k < made.size() ? made[k].get() : &ours, options.peer_every});
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
        TRY(rows[k].error, errors->measure(*timed[k].technique, k >= made.size()));
        std::vector<double> polygons = polygons_of(*timed[k].technique, walk, options.peer_every);
        rows[k].polygons_p50 = quantile(polygons, 0.5);
        rows[k].polygons_max = *std::max_element(polygons.begin(), polygons.end());
        progress(step, 0.5 * static_cast<double>(k + 1) / static_cast<double>(rows.size()));
    }
    time_room(timed, walks, options.passes,
              [&](const std::string&, double done) { progress(step, 0.5 + 0.5 * done); });
    for (std::size_t k = 0; k < rows.size(); ++k) {
        rows[k].times = std::move(timed[k].times);
    }
    return rows;
}

} // namespace frustumscreen::bench

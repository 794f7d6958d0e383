/// Ours against its peers (room_techniques.h) in a hall of many objects behind the screen, on three walks of an eye.
///
/// Time     processor time of all threads for choice, culling, plan and a full redraw, without read-back: for each frame the
///          least of some passes over the walks; then the median and the 99th percentile over frames. Peers draw every Nth
///          frame, the same ones each. The rate is that of the slowest frame.
/// Error    as room_errors.h; mean over some frames of each walk.
/// Peers    each at the cheapest of its settings whose error is not above ours, otherwise at its finest. Settings are
///          ordered from coarse to fine, and the search bisects them.
/// Paper    the paper's own experiment with its own numbers: its polygons a second at 10 frames a second or more,
///          objects of 10,000 polygons, on its walk; then with larger numbers, up to what this machine keeps.
///
/// Threads  the caller's, which holds a context of its own during the call.
/// Errors   as RoomSet, RoomTruth and RoomShow.
#pragma once

#include "app/bench/room/room_errors.h"

#include <functional>
#include <string>
#include <vector>

namespace frustumscreen::bench {

struct RoomOptions {
    int frames = 60; ///< of each walk
    int passes = 3;
    int peer_every = 4; ///< frames
    int errors = 3;     ///< frames of each walk
};

/// The paper's own numbers.
inline constexpr double paper_min_fps = 10.0;
inline constexpr double paper_polygons_s = 5000.0;
inline constexpr std::size_t paper_polygons_each = 10'000;

struct RoomFrameTime {
    std::size_t walk = 0, frame = 0;
    double ms = 0.0;      ///< the least of the passes
    double wall_ms = 0.0; ///< of the first pass
};
/// Times of one technique.
struct RoomTimes {
    std::vector<RoomFrameTime> frames;

    [[nodiscard]] double ms_p50() const;
    [[nodiscard]] double ms_p99() const;
    [[nodiscard]] double fps_min() const;      ///< by processor time
    [[nodiscard]] double wall_fps_min() const; ///< by the wall's clock, one pass
};

struct RoomRow {
    std::string technique;
    std::string setting;
    RoomTimes times;
    RoomError error;
};
struct RoomPaperRow {
    std::string technique;
    double polygons_s = 0.0;                       ///< the machine's; 0: no limit
    double polygons_p50 = 0.0, polygons_max = 0.0; ///< of a frame, after culling
    RoomTimes times{};
    RoomError error{};
};
struct RoomResult {
    std::size_t objects = 0;
    std::size_t triangles = 0; ///< of all objects' sources
    std::vector<std::string> walks;
    PaperWeights weights;
    std::vector<RoomRow> rows; ///< ours first
    std::vector<RoomPaperRow> paper;
};

using RoomProgress = std::function<void(const std::string& step, double done)>;

[[nodiscard]] Result<RoomResult> measure_room(RoomSet& set, const std::vector<RoomWalk>& walks,
                                              const RoomOptions& options, const RoomProgress& progress);

/// The least times of several passes; the techniques take turns.
struct TimedTechnique {
    RoomTechnique* technique = nullptr;
    int every = 1; ///< frames
    RoomTimes times{};
};
void time_room(std::span<TimedTechnique> timed, std::span<const RoomWalk> walks, int passes,
               const RoomProgress& progress);

/// The paper's own experiment.
[[nodiscard]] Result<std::vector<RoomPaperRow>>
measure_paper_numbers(RoomSet& set, RoomTruth& truth, RoomTechnique& ours, const RoomWalk& walk,
                      const RoomOptions& options, const RoomProgress& progress);

[[nodiscard]] std::string room_csv(const RoomResult& result);
[[nodiscard]] std::string room_frames_csv(const RoomResult& result);
[[nodiscard]] std::string room_paper_csv(const RoomResult& result);
[[nodiscard]] std::string room_table(const RoomResult& result);
/// "held" or "unmet": steady, quick enough, and cheaper than the best of the others.
[[nodiscard]] std::string room_verdicts(const RoomResult& result);

} // namespace frustumscreen::bench

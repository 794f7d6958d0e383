/// The limits for the picture, and whether they are held.
///
/// Limits   apply to the worst pose unless they say mean. A silhouette passes in a pose if either its share
///          of the artifact's pixels or its shift of the outline is within the limit (thin objects).
/// Threads  pure; any.
#pragma once

#include "app/bench/measures/error_time.h"

#include <limits>
#include <span>

namespace frustumscreen::bench {

struct Limits {
    double silhouette_percent = 0.0;
    /// Also applies to the picture as shown: its shift, its coverage error against exact outlines, and its
    /// coverage bias.
    double outline_shift_px = 0.0;
    double geometric_mean_mm = 0.0;
    double colour_rmse = 0.0; ///< against 16 rays, and as shown
    double times_floor = 0.0; ///< 0: no limit
};
/// Shift of a shown level or relief against its own surface: below what a person can see, and far below half
/// a pixel. Against the scan, it may be displaced as far as its outlines may.
inline constexpr double max_drawn_shift_px = 0.05;
inline constexpr Limits default_level_limits{.silhouette_percent = 0.6,
                                             .outline_shift_px = 0.3,
                                             .geometric_mean_mm = 0.2,
                                             .colour_rmse = 14.0,
                                             .times_floor = 4.0};
inline constexpr Limits finest_level_limits{.silhouette_percent = 0.15,
                                            .outline_shift_px = 0.1,
                                            .geometric_mean_mm = 0.05,
                                            .colour_rmse = 8.0,
                                            .times_floor = 0.0};
/// Stricter limits: for the default level, and for some fine level of the pack.
inline constexpr Limits pushed_default_limits{.silhouette_percent = 0.35,
                                              .outline_shift_px = 0.175,
                                              .geometric_mean_mm = 0.16,
                                              .colour_rmse = 14.0,
                                              .times_floor = 0.0};
inline constexpr Limits fine_level_limits{.silhouette_percent = 0.1,
                                          .outline_shift_px = 0.067,
                                          .geometric_mean_mm = 0.05,
                                          .colour_rmse = 14.0,
                                          .times_floor = 8.0};
/// Applies to the cheapest level or relief of the pack that keeps them, regardless of its colours. They are
/// reported and never end a run.
inline constexpr Limits wished_cheap_limits{.silhouette_percent = 0.15,
                                            .outline_shift_px = 0.1,
                                            .geometric_mean_mm = 0.05,
                                            .colour_rmse = std::numeric_limits<double>::infinity(),
                                            .times_floor = 2.0};
inline constexpr Limits wished_fine_limits{.silhouette_percent = 0.05,
                                           .outline_shift_px = 0.05,
                                           .geometric_mean_mm = 0.01,
                                           .colour_rmse = std::numeric_limits<double>::infinity(),
                                           .times_floor = 4.0};
/// Required speed-up over the two-pass method at no larger errors, for a source of a million triangles and of
/// four million; sources more than 5 % smaller are not judged.
inline constexpr std::uint64_t min_two_pass_triangles = 950'000;
[[nodiscard]] double min_two_pass_speed_up(std::uint64_t triangles);

struct LimitVerdict {
    std::string what; ///< the limit, with its number
    std::string found;
    bool held = false;
    bool wished = false; ///< a wish, not a limit: not an error if it is not held
};

/// One line per verdict: held, MISSED or unmet (a wish that is not held), the limit, the measured value.
[[nodiscard]] std::string lines_of(std::span<const LimitVerdict> verdicts);

[[nodiscard]] std::vector<LimitVerdict> judge(const TechniqueResult& level, const Limits& limits);

/// The cheapest level whose mean silhouette, geometric and colour errors do not exceed the two-pass method's;
/// null if there is none.
[[nodiscard]] const TechniqueResult* cheapest_as_good(const SetUpResult& result,
                                                      const TechniqueResult& two_pass);

/// Verdicts on the default level, the finest level, the two-pass picture of a large enough source at its best
/// eye image, a fine level or relief, the wishes, and whether a peer dominates a level.
[[nodiscard]] std::vector<LimitVerdict> judge(const SetUpResult& result);

/// Ignores wishes. The error names the number of missed verdicts, and the first of them.
[[nodiscard]] Result<void> require_limits(std::span<const SetUpResult> results);

} // namespace frustumscreen::bench

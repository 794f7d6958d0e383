/// frustumscreen-bench guidance: how often a single advice helps, and how much advice helps visitors.
///
/// Threads  pure; any.
#pragma once

#include "app/bench/guidance/visitor.h"
#include "app/bench/measures/verdicts.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace frustumscreen::bench {

struct GuidanceOptions {
    int situations = 100000; ///< for each prop
    int visitors = 200;      ///< for each prop and adviser
    double seconds = 60.0;   ///< length of a visit
    std::uint64_t seed = 1;
};

/// Results of advice for seeded situations, carried out with the inaccuracy of people.
struct AdviceProof {
    int situations = 0;
    int valid = 0;                   ///< valid from the start
    std::vector<int> restored_after; ///< [k]: whole after k + 1 moves
    int never = 0;                   ///< not whole within that many moves
    int without_advice = 0;          ///< situations without an advice: no sequence was found
    long single = 0;                 ///< advices of a single move that were carried out
    long failed = 0;                 ///< neither whole afterwards nor a smaller unlit area
    double median_ms = 0.0;          ///< time to find an advice
    double p99_ms = 0.0;
};

struct VisitsOf {
    Adviser adviser = Adviser::None;
    std::vector<double> restored_s; ///< ascending
    double whole_share = 0.0;
    double advices_a_minute = 0.0;
    double losses_a_minute = 0.0;
    std::array<double, dark_while_count> dark_share{}; ///< shares of the time, by `DarkWhile`
    /// Seconds within which the picture is whole again after this share of the losses.
    [[nodiscard]] double quantile_s(double share) const;
};

struct GuidedProp {
    std::string name;
    AdviceProof proof;
    std::vector<VisitsOf> visits;
};

/// `progress`: share of the work that is done.
[[nodiscard]] GuidedProp measure_guidance(const std::string& name, const guidance::GuidanceSetup& setup,
                                          const GuidanceOptions& options,
                                          const std::function<void(double)>& progress);

[[nodiscard]] std::string guidance_table(const GuidedProp& prop);
[[nodiscard]] std::string guidance_csv(const std::vector<GuidedProp>& props);
/// Targets: no advice fails, the picture is whole again within 6 s of 95 % of the losses, and it is whole for 95 % of the time.
[[nodiscard]] std::vector<LimitVerdict> judge(const GuidedProp& prop);

} // namespace frustumscreen::bench

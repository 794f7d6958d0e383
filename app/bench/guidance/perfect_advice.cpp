#include "app/bench/guidance/perfect_advice.h"

#include "app/bench/guidance/motion.h"
#include "app/guidance/advise.h"
#include "app/guidance/candidates.h"
#include "app/guidance/steadiness.h"

#include <limits>

namespace frustumscreen::bench {

namespace {

/// Time to mend the picture again after an unsteady pose loses it.
constexpr double unsteady_s = 4.0;

} // namespace

std::optional<guidance::Move> perfect_advice(const guidance::FaceReader& reader,
                                             const guidance::GuidedState& tracked_state) {
    if (reader.whole(tracked_state)) {
        return std::nullopt;
    }
    std::optional<guidance::Move> best;
    double min_cost_s = std::numeric_limits<double>::infinity();
    for (const guidance::MoveSet set : {guidance::MoveSet::Only, guidance::MoveSet::Last}) {
        for (const guidance::Candidate& candidate :
             guidance::candidates(reader.setup(), tracked_state, set).all()) {
            const guidance::GuidedState next = guidance::after(candidate.move, reader.setup(), tracked_state);
            const double lasts_s = time_for_s(candidate.move, tracked_state, next);
            if (lasts_s < min_cost_s && reader.whole(next)) {
                int looks = 0;
                const double cost_s =
                    lasts_s + unsteady_s * (1.0 - guidance::steadiness(reader, next, looks));
                if (cost_s < min_cost_s) {
                    best = candidate.move;
                    min_cost_s = cost_s;
                }
            }
        }
    }
    return best ? best : guidance::advise(reader, tracked_state).value_or(guidance::Advice{}).move;
}

} // namespace frustumscreen::bench

#include "app/bench/guidance/perfect_advice.h"

#include "app/bench/guidance/motion.h"
#include "app/guidance/advise.h"
#include "app/guidance/candidates.h"
#include "app/guidance/steadiness.h"

#include <limits>

namespace frustumscreen {

namespace {

/// Time to mend the picture again after an unsteady pose loses it.
constexpr double unsteady_s = 4.0;

} // namespace

std::optional<Move> perfect_advice(const FaceReader& reader, const GuidedState& tracked_state) {
    if (reader.whole(tracked_state)) {
        return std::nullopt;
    }
    std::optional<Move> best;
    double min_cost_s = std::numeric_limits<double>::infinity();
    for (const MoveSet set : {MoveSet::Only, MoveSet::Last}) {
        for (const Candidate& candidate : candidates(reader.setup(), tracked_state, set).all()) {
            const GuidedState next = after(candidate.move, reader.setup(), tracked_state);
            const double lasts_s = time_for_s(candidate.move, tracked_state, next);
            if (lasts_s < min_cost_s && reader.whole(next)) {
                int looks = 0;
                const double cost_s = lasts_s + unsteady_s * (1.0 - steadiness(reader, next, looks));
                if (cost_s < min_cost_s) {
                    best = candidate.move;
                    min_cost_s = cost_s;
                }
            }
        }
    }
    return best ? best : advise(reader, tracked_state).value_or(Advice{}).move;
}

} // namespace frustumscreen

#include "app/bench/guidance/paper_rule.h"

#include "app/guidance/candidates.h"

#include <glm/gtc/quaternion.hpp>

#include <limits>
#include <numbers>

namespace frustumscreen::bench {

namespace {

constexpr double usual_way_m = 0.10;
constexpr double usual_turn_rad = std::numbers::pi / 6.0;

/// The action with the amount that a person takes if none is advised.
guidance::Move without_amount(guidance::Move move) {
    if (move.action == guidance::Action::Turn) {
        move.turn_rad = move.turn_rad > 0.0 ? usual_turn_rad : -usual_turn_rad;
    } else if (move.action == guidance::Action::Slide || move.action == guidance::Action::Raise ||
               move.action == guidance::Action::Lower) {
        move.by_m = glm::normalize(move.by_m) * usual_way_m;
    }
    return move;
}

/// A turn that brings the face towards the projector, for a face that no single action opens.
guidance::Move towards_light(const guidance::FaceReader& reader, const guidance::GuidedState& tracked_state,
                             std::uint32_t face) {
    const guidance::GuidanceSetup& setup = reader.setup();
    guidance::Move move{guidance::Action::Turn};
    for (std::size_t k = 0; k < setup.prop.faces.size(); ++k) {
        if ((face >> k & 1U) != 0) {
            const glm::dvec3 normal =
                tracked_state.table_from_prop.direction(setup.prop.faces[k].plane.normal);
            const glm::dvec3 way =
                setup.table_from_projector.translation - tracked_state.table_from_prop.translation;
            const bool left = normal.x * way.y - normal.y * way.x > 0.0;
            move.turn_rad = left ? usual_turn_rad : -usual_turn_rad;
        }
    }
    return move;
}

} // namespace

std::optional<guidance::Move> paper_advice(const guidance::FaceReader& reader,
                                           const guidance::GuidedState& tracked_state) {
    const guidance::FaceSets now = reader.read(tracked_state);
    if (now.valid()) {
        return std::nullopt;
    }
    const std::uint32_t largest = reader.largest_of(tracked_state, now.unlit());
    const std::uint32_t valid = now.seen & now.lit;
    std::optional<guidance::Move> best;
    double least = std::numeric_limits<double>::infinity();
    for (const guidance::Candidate& candidate :
         guidance::candidates(reader.setup(), tracked_state, guidance::MoveSet::Only).all()) {
        if (candidate.move.action == guidance::Action::ComeRound ||
            guidance::stands_elsewhere(candidate.move) || candidate.effort >= least) {
            continue;
        }
        const guidance::FaceSets next =
            reader.read(guidance::after(candidate.move, reader.setup(), tracked_state));
        if ((next.unlit() & (largest | valid)) == 0) {
            best = candidate.move;
            least = candidate.effort;
        }
    }
    return without_amount(best ? *best : towards_light(reader, tracked_state, largest));
}

} // namespace frustumscreen::bench

#include "firmware_host/tracker/space_mouse_session.h"

namespace frustumscreen::tracker {

namespace {

/// A longer pause between two calls means that the machine slept; it produces no samples.
constexpr Nanoseconds longest_pause = std::chrono::seconds(1);

/// Counts to a fraction of full deflection; the dead zone is subtracted, so motion begins from rest.
glm::dvec3 deflection(const glm::dvec3& counts) {
    constexpr double range = SpaceMouseSession::full_deflection - SpaceMouseSession::dead_zone;
    const glm::dvec3 beyond = glm::max(glm::abs(counts) - SpaceMouseSession::dead_zone, glm::dvec3(0.0));
    return glm::sign(counts) * glm::min(beyond / range, glm::dvec3(1.0));
}

/// Length of the part of `from` .. `to` that lies before `until`.
double seconds_before(MonotonicTime until, MonotonicTime from, MonotonicTime to) {
    return std::max(to_seconds(std::min(until, to) - from), 0.0);
}

} // namespace

SpaceMouseSession::SpaceMouseSession(const glm::dvec2& table_half_m)
    : lowest_m_(-table_half_m.x, -table_half_m.y, 0.0),
      highest_corner_m_(table_half_m.x, table_half_m.y, highest_m), intake_(1.0) {}

std::span<const std::byte> SpaceMouseSession::due(MonotonicTime /*now*/) {
    return {};
}

void SpaceMouseSession::advance(MonotonicTime to) {
    const glm::dvec3 way_m = push_.per_second * seconds_before(push_.until, at_, to);
    position_m_ = glm::clamp(position_m_ + way_m, lowest_m_, highest_corner_m_);
    const glm::dvec3 turn_rad = turn_.per_second * seconds_before(turn_.until, at_, to);
    if (const double angle_rad = glm::length(turn_rad); angle_rad > 0.0) {
        rotation_ = glm::normalize(glm::angleAxis(angle_rad, turn_rad / angle_rad) * rotation_);
    }
    at_ = to;
}

void SpaceMouseSession::sample(MonotonicTime to, std::vector<PoseSample>& samples) {
    for (; *next_sample_ <= to; *next_sample_ += sample_period) {
        advance(*next_sample_);
        samples.push_back({.time = at_,
                           .station = prop_station,
                           .position_m = position_m_,
                           .rotation = rotation_,
                           .ok = true});
    }
}

void SpaceMouseSession::receive(std::span<const std::byte> report, MonotonicTime arrival,
                                std::vector<PoseSample>& samples) {
    if (!next_sample_ || arrival - at_ > longest_pause) {
        at_ = arrival;
        next_sample_ = arrival;
    }
    arrival = std::max(arrival, at_);
    sample(arrival, samples);
    if (report.empty()) {
        return;
    }
    const SpaceMouseMessage message = parse_space_mouse(report);
    if (const auto* motion = std::get_if<SpaceMouseMotion>(&message)) {
        advance(arrival); // with the motion that was valid until now
        if (motion->push) {
            push_ = {full_push_m_per_s * deflection(*motion->push), arrival + report_holds};
        }
        if (motion->turn) {
            turn_ = {full_turn_rad_per_s * deflection(*motion->turn), arrival + report_holds};
        }
    } else if (std::holds_alternative<DiscardReason>(message)) {
        intake_.count_refusal();
    }
}

} // namespace frustumscreen::tracker

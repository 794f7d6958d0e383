#include "app/guidance/steadiness.h"

#include "app/guidance/move.h"

#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::guidance {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr std::array<double, 6> turns_deg{-75.0, -45.0, -20.0, 20.0, 45.0, 75.0};
constexpr double push_m = 0.04;
constexpr double lean_rad = 20.0 * degree;

class Count {
public:
    Count(const FaceReader& reader, int& looks) : reader_(reader), looks_(looks) {}
    void add(const GuidedState& tracked_state) {
        ++all_;
        ++looks_;
        whole_ += reader_.whole(tracked_state) ? 1 : 0;
    }
    [[nodiscard]] double share() const { return static_cast<double>(whole_) / all_; }

private:
    const FaceReader& reader_;
    int& looks_;
    int all_ = 0;
    int whole_ = 0;
};

} // namespace

double steadiness(const FaceReader& reader, const GuidedState& tracked_state, int& looks) {
    const GuidanceSetup& setup = reader.setup();
    Count count(reader, looks);
    for (const double turn_deg : turns_deg) {
        Move turn{Action::Turn};
        turn.turn_rad = turn_deg * degree;
        count.add(after(turn, setup, tracked_state));
    }
    for (int side = 0; side < 4; ++side) {
        const double azimuth = 0.5 * std::numbers::pi * side;
        const glm::dvec3 way(std::cos(azimuth), std::sin(azimuth), 0.0);
        count.add(after({Action::Slide, push_m * way}, setup, tracked_state));
        if (setup.in_hand) {
            GuidedState leaning = tracked_state;
            geometry::RigidTransform& pose = leaning.table_from_prop;
            pose.rotation = glm::angleAxis(lean_rad, way) * pose.rotation;
            pose.translation +=
                tracked_state.table_from_prop.point(setup.prop.middle) - pose.point(setup.prop.middle);
            count.add(leaning);
        }
    }
    return count.share();
}

} // namespace frustumscreen::guidance

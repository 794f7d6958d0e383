// Poses as they may arrive: quaternions of any length and sign, of zero length, not finite.

#include "app/bench/stability/exact.h"
#include "app/bench/stability/picture.h"
#include "app/bench/stability/themes.h"
#include "app/tracking/tracked_state.h"
#include "firmware_host/tracker/pose_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

namespace frustumscreen::bench {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
const glm::dquat turned(0.5, -0.1, 0.7, 0.3); // not normalised

const std::array no_rotations{glm::dquat(0.0, 0.0, 0.0, 0.0), glm::dquat(nan, 0.0, 0.0, 1.0),
                              glm::dquat(1.0, nan, nan, nan), glm::dquat(infinity, 0.0, 0.0, 0.0),
                              glm::dquat(0.5, 0.5, -infinity, 0.5)};

/// Largest distance between points of the unit sphere rotated by `q` and rotated by `turned`.
double off_turn(const glm::dquat& q) {
    const exact::Rigid truth({turned, glm::dvec3(0.0)});
    double off = 0.0;
    for (const glm::dvec3& p : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0.6, 0.0, -0.8)}) {
        off =
            std::fmax(off, static_cast<double>(exact::length(exact::of(q * p) - truth.point(exact::of(p)))));
    }
    return off;
}

tracker::PoseSample sample_of(const glm::dquat& rotation, std::int64_t t_us = 0) {
    tracker::PoseSample sample;
    sample.time = from_microseconds(t_us);
    sample.position_m = {0.1, -0.05, 0.0};
    sample.rotation = rotation;
    return sample;
}

StabilityResult of_any_length(const StabilityOptions&) {
    double off = 0.0;
    double off_tracked = 0.0;
    for (int exponent = -299; exponent <= 307; exponent += 3) {
        const glm::dquat q = turned * std::pow(10.0, exponent);
        const auto unit = geometry::normalised(q);
        off = std::fmax(off, unit ? off_turn(*unit) : 1.0);
        tracking::TrackedStateTracker tracker(glm::dvec3(0.0));
        const bool taken = tracker.take(sample_of(q));
        off_tracked = std::fmax(off_tracked, taken ? off_turn(tracker.at({}).table_from_prop.rotation) : 1.0);
    }
    return {{{"normalised, length 1e-299 to 1e307: a unit point off", 16 * 0x1p-53, off},
             {"through the tracker: a unit point off", 16 * 0x1p-53, off_tracked}}};
}

StabilityResult of_none(const StabilityOptions&) {
    double taken = 0.0;
    for (const glm::dquat& q : no_rotations) {
        taken += geometry::normalised(q) ? 1.0 : 0.0;
    }
    return {{{"normalised: zero, NaN, infinite", 0.0, taken}}};
}

/// The tracker refuses such poses and keeps its state.
StabilityResult into_the_tracker(const StabilityOptions&) {
    tracking::TrackedStateTracker tracker(glm::dvec3(0.0, -0.5, 0.5));
    double wrong = tracker.take(sample_of(turned)) ? 0.0 : 1.0;
    const geometry::RigidTransform before = tracker.at({}).table_from_prop;
    std::vector<tracker::PoseSample> bad;
    bad.reserve(no_rotations.size() + 9);
    for (const glm::dquat& q : no_rotations) {
        bad.push_back(sample_of(q, 1000));
    }
    for (const double number : {nan, infinity, -infinity}) {
        for (int axis = 0; axis < 3; ++axis) {
            bad.push_back(sample_of(turned, 1000));
            bad.back().position_m[axis] = number;
        }
    }
    for (const tracker::PoseSample& sample : bad) {
        tracker::PoseSample head = sample;
        head.station = tracker::head_station;
        wrong += tracker.take(sample) || tracker.take(head) ? 1.0 : 0.0;
    }
    const tracking::TrackedState after = tracker.at(from_microseconds(2000));
    wrong += after.table_from_prop.rotation == before.rotation ? 0.0 : 1.0;
    wrong += after.table_from_prop.translation == before.translation ? 0.0 : 1.0;
    wrong += after.head_known ? 1.0 : 0.0;
    return {{{fmt::format("of {} samples that are no pose: taken, or of effect", bad.size()), 0.0, wrong}}};
}

StabilityResult from_a_file(const StabilityOptions&) {
    const std::string header = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
    double off = 0.0;
    for (const double length : {1e-5, 1e-3, 1.0, 1e3, 1e150}) {
        const glm::dquat q = turned * length;
        const auto poses = tracker::parse_poses(
            header + fmt::format("0,1,0.1,0.2,0,{},{},{},{},1\n", q.w, q.x, q.y, q.z), "poses.csv");
        off = std::fmax(off, poses ? off_turn(poses->front().rotation) : 1.0);
    }
    double taken = 0.0;
    for (const std::string numbers :
         {"0,0,0,0,0,0,0", "0,0,0,nan,0,0,1", "0,0,0,inf,0,0,0", "nan,0,0,1,0,0,0", "0,inf,0,1,0,0,0",
          "0,0,0,1e-7,0,0,0", "0,1e30,0,1,0,0,0"}) {
        taken += tracker::parse_poses(fmt::format("{}0,1,{},1\n", header, numbers), "poses.csv") ? 1.0 : 0.0;
    }
    return {{{"length 1e-5 to 1e150: a unit point off", 16 * 0x1p-53, off},
             {"rows that are no pose, taken", 0.0, taken}}};
}

/// q and -q are one pose: their pictures are equal to the last bit.
StabilityResult of_either_sign(const StabilityOptions&) {
    double other = 0.0;
    const auto negated = [](const geometry::RigidTransform& t) {
        return geometry::RigidTransform{-t.rotation, t.translation};
    };
    for (int k = 0; k < 50; ++k) {
        exact::SetUp set_up = usual_set_up();
        set_up.table_from_prop = {
            glm::normalize(glm::dquat(std::cos(0.1 * k), 0.05 * std::sin(0.3 * k), -0.04, std::sin(0.1 * k))),
            {0.05, -0.02, 0.0}};
        const SeenArtifact artifact = seen_artifact(set_up, 200);
        const std::uint64_t hash = plan_of(set_up, artifact).hash;
        exact::SetUp flipped = set_up;
        flipped.table_from_prop = negated(set_up.table_from_prop);
        other += plan_of(flipped, artifact).hash == hash ? 0.0 : 1.0;
        flipped.table_from_projector = negated(set_up.table_from_projector);
        other += plan_of(flipped, artifact).hash == hash ? 0.0 : 1.0;
    }
    return {{{"of 100 plans with the sign flipped, other than without", 0.0, other}}};
}

/// If such a pose still reaches the plan, the plan's numbers stay finite and nothing crashes.
StabilityResult into_the_plan(const StabilityOptions&) {
    double wrong = 0.0;
    const SeenArtifact artifact = seen_artifact(usual_set_up(), 2000);
    const auto check = [&](const exact::SetUp& set_up) {
        const scene::FramePlan plan = plan_of(set_up, artifact);
        for (const scene::Draw& draw : plan.draws) {
            for (int column = 0; column < 4; ++column) {
                const glm::vec4 c = draw.clip_from_unit[column];
                wrong += std::isfinite(c.x + c.y + c.z + c.w) ? 0.0 : 1.0;
            }
        }
        for (const PixelRectangle& r : plan.lit.rectangles()) {
            const bool inside = r.x >= 0 && r.y >= 0 && r.x + r.width <= 1280 && r.y + r.height <= 800;
            wrong += inside ? 0.0 : 1.0;
        }
    };
    for (const glm::dquat& q : no_rotations) {
        exact::SetUp set_up = usual_set_up();
        set_up.table_from_prop.rotation = q;
        check(set_up);
        set_up = usual_set_up();
        set_up.table_from_projector.rotation = q;
        check(set_up);
    }
    for (const double number : {nan, infinity, -infinity, 1e300}) {
        for (int axis = 0; axis < 3; ++axis) {
            exact::SetUp set_up = usual_set_up();
            set_up.table_from_prop.translation[axis] = number;
            check(set_up);
            set_up = usual_set_up();
            set_up.eye_m[axis] = number;
            check(set_up);
        }
    }
    return {{{"numbers not finite, rectangles outside the picture", 0.0, wrong}}};
}

} // namespace

std::vector<StabilityCase> pose_cases() {
    const std::string theme = "pose";
    return {{theme, "quaternions that are not unit", FloatingPoint::Free, of_any_length},
            {theme, "quaternions that are none", FloatingPoint::Free, of_none},
            {theme, "samples that are no pose", FloatingPoint::Free, into_the_tracker},
            {theme, "pose files", FloatingPoint::Free, from_a_file},
            {theme, "quaternions with the sign flipped", FloatingPoint::Strict, of_either_sign},
            {theme, "no pose, in the plan", FloatingPoint::Free, into_the_plan}};
}

} // namespace frustumscreen::bench

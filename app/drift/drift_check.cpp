#include "app/drift/drift_check.h"

#include "app/calibration/homography.h"
#include "firmware_host/base/quantile.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace frustumscreen::drift {

namespace {

constexpr std::size_t min_anchors = 3; // tags; fewer determine little away from themselves
constexpr double max_anchor_misfit_px = 1.5;

Eigen::Vector2d eigen(const glm::dvec2& v) {
    return {v.x, v.y};
}

double median(std::vector<double> values) {
    return quantile(std::move(values), 0.5);
}

glm::dvec2 median(const std::vector<glm::dvec2>& places) {
    std::vector<double> x, y;
    for (const glm::dvec2& place : places) {
        x.push_back(place.x);
        y.push_back(place.y);
    }
    return {median(std::move(x)), median(std::move(y))};
}

/// Homography from the camera's pixels to the table, from the reference.
std::optional<Eigen::Matrix3d> table_from_pixels(const DriftReference& reference) {
    std::vector<Eigen::Vector2d> pixels, places;
    for (std::size_t k = 0; k < reference.marks_px.size(); ++k) {
        if (reference.marks_px[k]) {
            pixels.push_back(eigen(*reference.marks_px[k]));
            places.push_back(eigen(reference.marks_m[k]));
        }
    }
    return calibration::homography(pixels, places);
}

struct CameraWay {
    Eigen::Matrix3d reference_from_now = Eigen::Matrix3d::Identity(); ///< pixels
    bool known = false;
};

CameraWay camera_way(const std::vector<AnchorTag>& before, const std::vector<AnchorTag>& now) {
    std::vector<Eigen::Vector2d> from, to;
    CameraWay way;
    for (const AnchorTag& tag : now) {
        const auto same = std::find_if(before.begin(), before.end(),
                                       [&](const AnchorTag& other) { return other.id == tag.id; });
        for (std::size_t k = 0; same != before.end() && k < tag.corners_px.size(); ++k) {
            from.push_back(eigen(tag.corners_px.at(k)));
            to.push_back(eigen(same->corners_px.at(k)));
        }
    }
    const auto found = from.size() >= 4 * min_anchors ? calibration::homography(from, to) : std::nullopt;
    if (!found) {
        return way;
    }
    double misfit = 0.0;
    for (std::size_t k = 0; k < from.size(); ++k) {
        misfit += (calibration::mapped(*found, from[k]) - to[k]).norm() / static_cast<double>(from.size());
    }
    way.known = misfit <= max_anchor_misfit_px; // otherwise one of the tags was moved
    if (way.known) {
        way.reference_from_now = *found;
    }
    return way;
}

/// Sets each mark to the median of its places in the sets, and the tags to those of the last set.
void fill(DriftReference& reference, const std::vector<MarkSet>& sets) {
    for (std::size_t mark = 0; mark < reference.marks_m.size(); ++mark) {
        std::vector<glm::dvec2> seen;
        for (const MarkSet& set : sets) {
            if (set.marks_px[mark]) {
                seen.push_back(*set.marks_px[mark]);
            }
        }
        reference.marks_px[mark] = 2 * seen.size() > sets.size() ? std::optional(median(seen)) : std::nullopt;
    }
    reference.anchors = sets.back().anchors;
}

/// Distance of each mark from its place by a homography of four marks, in metres; empty: there is no such
/// homography.
std::vector<double> misfits_m(const DriftReference& reference, const std::vector<std::size_t>& four) {
    std::vector<Eigen::Vector2d> pixels, places;
    for (const std::size_t k : four) {
        pixels.push_back(eigen(*reference.marks_px[k]));
        places.push_back(eigen(reference.marks_m[k]));
    }
    const std::optional<Eigen::Matrix3d> table = calibration::homography(pixels, places);
    std::vector<double> misfits;
    for (std::size_t k = 0; table && k < reference.marks_px.size(); ++k) {
        misfits.push_back(
            reference.marks_px[k]
                ? (calibration::mapped(*table, eigen(*reference.marks_px[k])) - eigen(reference.marks_m[k]))
                      .norm()
                : std::numeric_limits<double>::infinity());
    }
    return misfits;
}

/// Removes marks that were lifted or displaced while learning: those far from the places given by most others
/// (least median of squares; a lens distorts by some millimetres).
void leave_out_strays(DriftReference& reference) {
    constexpr double max_misfit_m = 0.012;
    std::vector<std::size_t> seen;
    for (std::size_t k = 0; k < reference.marks_px.size(); ++k) {
        if (reference.marks_px[k]) {
            seen.push_back(k);
        }
    }
    std::vector<bool> chosen(seen.size(), false);
    std::fill(chosen.begin(),
              chosen.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(4, seen.size())), true);
    std::vector<double> best;
    double least = std::numeric_limits<double>::infinity();
    do { // all combinations of four: 210 for ten marks
        std::vector<std::size_t> four;
        for (std::size_t k = 0; k < seen.size(); ++k) {
            if (chosen[k]) {
                four.push_back(seen[k]);
            }
        }
        const std::vector<double> misfits = misfits_m(reference, four);
        std::vector<double> of_seen;
        for (const std::size_t k : seen) {
            of_seen.push_back(misfits.empty() ? least : misfits[k]);
        }
        if (!misfits.empty() && median(of_seen) < least) {
            least = median(of_seen);
            best = misfits;
        }
    } while (std::prev_permutation(chosen.begin(), chosen.end()));
    for (std::size_t k = 0; k < best.size(); ++k) {
        if (best[k] > max_misfit_m) {
            reference.marks_px[k].reset();
        }
    }
}

/// Whether the marks seen in both sets are at equal places; one mark may differ.
bool agree(const MarkSet& a, const MarkSet& b, double max_px) {
    std::size_t same = 0, apart = 0;
    for (std::size_t k = 0; k < a.marks_px.size(); ++k) {
        if (a.marks_px[k] && b.marks_px[k]) {
            ++(glm::distance(*a.marks_px[k], *b.marks_px[k]) < max_px ? same : apart);
        }
    }
    return same >= DriftCheck::min_marks && apart <= 1;
}

} // namespace

std::optional<DriftMeasure> measure_drift(const DriftReference& reference, const MarkSet& set) {
    const std::optional<Eigen::Matrix3d> table = table_from_pixels(reference);
    if (!table) {
        return std::nullopt;
    }
    const CameraWay camera = camera_way(reference.anchors, set.anchors);
    std::vector<glm::dvec2> ways;
    std::vector<double> lengths;
    std::size_t known = 0;
    for (std::size_t k = 0; k < reference.marks_px.size() && k < set.marks_px.size(); ++k) {
        known += reference.marks_px[k] ? 1 : 0;
        if (reference.marks_px[k] && set.marks_px[k]) {
            const Eigen::Vector2d now =
                calibration::mapped(camera.reference_from_now, eigen(*set.marks_px[k]));
            const Eigen::Vector2d way =
                calibration::mapped(*table, now) - calibration::mapped(*table, eigen(*reference.marks_px[k]));
            ways.emplace_back(way.x(), way.y());
            lengths.push_back(way.norm());
        }
    }
    if (ways.size() < DriftCheck::min_marks || 2 * ways.size() < known) {
        return std::nullopt;
    }
    return DriftMeasure{
        .off_m = median(lengths), .shift_m = median(ways), .marks = ways.size(), .anchored = camera.known};
}

void DriftCheck::know(DriftReference reference) {
    reference_ = std::move(reference);
    known_ = true;
    verdict_.state = DriftState::Looking;
}

bool DriftCheck::take(const MarkSet& set) {
    ++verdict_.looks;
    verdict_.marks = set.seen();
    if (!known_) {
        return learn(set);
    }
    latest_.push_back({set.time, measure_drift(reference_, set)});
    while (latest_.size() > agreeing && latest_.back().time - latest_[1].time >= min_time) {
        latest_.pop_front();
    }
    judge();
    return false;
}

/// The first sets may be from a time when people still worked at the table, so only sets that agree count.
bool DriftCheck::learn(const MarkSet& set) {
    if (set.marks_px.size() != reference_.marks_m.size()) {
        return false;
    }
    if (!first_.empty() && !agree(first_.back(), set, learn_agree_px)) {
        first_.clear();
    }
    first_.push_back(set);
    if (first_.size() < learned_from) {
        verdict_.state = set.seen() < min_marks ? DriftState::Blind : DriftState::Learning;
        return false;
    }
    fill(reference_, first_);
    leave_out_strays(reference_);
    known_ = table_from_pixels(reference_).has_value();
    first_.clear();
    verdict_.state = known_ ? DriftState::Well : DriftState::Blind;
    return known_;
}

/// The verdict changes only if all of the latest sets agree.
void DriftCheck::judge() {
    const bool enough = latest_.size() >= agreeing && latest_.back().time - latest_.front().time >= min_time;
    const auto blind = static_cast<std::size_t>(
        std::count_if(latest_.begin(), latest_.end(), [](const Dated& each) { return !each.measure; }));
    if (blind > 0) {
        verdict_.state = enough && blind == latest_.size() ? DriftState::Blind : verdict_.state;
        return;
    }
    std::vector<double> offs;
    std::vector<glm::dvec2> shifts;
    for (const Dated& each : latest_) {
        offs.push_back(each.measure->off_m);
        shifts.push_back(each.measure->shift_m);
    }
    verdict_.off_m = median(offs);
    verdict_.anchored = latest_.back().measure->anchored;
    if (verdict_.state == DriftState::Looking || verdict_.state == DriftState::Blind) {
        verdict_.state = verdict_.off_m <= tolerance_m ? DriftState::Well : DriftState::Looking;
    }
    const glm::dvec2 middle = median(shifts);
    const bool all_say_so = std::all_of(latest_.begin(), latest_.end(), [&](const Dated& each) {
        return each.measure->off_m > tolerance_m && glm::distance(each.measure->shift_m, middle) < agree_m;
    });
    const bool none_says_so = std::all_of(
        latest_.begin(), latest_.end(), [](const Dated& each) { return each.measure->off_m < well_again_m; });
    if (enough && all_say_so) {
        verdict_.state = DriftState::Moved;
    } else if (enough && none_says_so) {
        verdict_.state = DriftState::Well;
    }
}

} // namespace frustumscreen::drift

#include "tests/simulators/visitor/visitor_figures.h"

#include "firmware_host/base/quantile.h"

#include <cmath>
#include <utility>

namespace frustumscreen::simulators {

namespace {

constexpr double visit_s = 7.0;

struct Lists {
    std::vector<double> off_mm, azimuth_deg, picture_mm, ms;
    double there = 0.0, seen = 0.0;
    double jitter_squares = 0.0, jitters = 0.0;
    double said_squares = 0.0;
    double behind = 0.0, gone = 0.0; ///< for the lag
};

void take_eye(Lists& lists, const glm::dvec3& prop_m, const VisitMoment& moment) {
    const glm::dvec3 line = glm::normalize(moment.eye_m - prop_m);
    const glm::dvec3 off = moment.shown_eye_m - moment.eye_m;
    const double across = glm::length(off - glm::dot(off, line) * line);
    lists.off_mm.push_back(1e3 * across);
    lists.said_squares += 0.5 * std::pow(across / moment.said_sd_m, 2.0);
    const auto azimuth = [&prop_m](const glm::dvec3& eye) {
        return std::atan2(eye.y - prop_m.y, eye.x - prop_m.x);
    };
    const double turned = azimuth(moment.shown_eye_m) - azimuth(moment.eye_m);
    lists.azimuth_deg.push_back(glm::degrees(std::abs(std::atan2(std::sin(turned), std::cos(turned)))));
    for (const double mm : picture_errors_mm(prop_m, moment.eye_m, moment.shown_eye_m)) {
        lists.picture_mm.push_back(mm);
    }
}

/// Least-squares estimate of the lag of the shown eye. Excludes sway, which carries no information about lag.
void take_lag(Lists& lists, const VisitMoment& before, const VisitMoment& now) {
    constexpr double walks_m_s = 0.15;
    const glm::dvec3 velocity = (now.eye_m - before.eye_m) / (now.t_s - before.t_s);
    if (glm::length(velocity) > walks_m_s) {
        lists.behind += glm::dot(now.eye_m - now.shown_eye_m, velocity);
        lists.gone += glm::dot(velocity, velocity);
    }
}

/// Unwanted movement of the picture: the shown position minus the correct one, about its mean over a second.
void take_jitter(Lists& lists, const std::vector<glm::dvec3>& offs_mm) {
    const auto second = static_cast<std::size_t>(visit_rate_hz);
    for (std::size_t from = 0; from + second <= offs_mm.size(); from += second) {
        glm::dvec3 mean(0.0);
        for (std::size_t k = from; k < from + second; ++k) {
            mean += offs_mm[k] / visit_rate_hz;
        }
        for (std::size_t k = from; k < from + second; ++k) {
            lists.jitter_squares += glm::dot(offs_mm[k] - mean, offs_mm[k] - mean);
            lists.jitters += 1.0;
        }
    }
}

void take(Lists& lists, const Visit& visit) {
    std::vector<glm::dvec3> offs_mm;
    const VisitMoment* before = nullptr;
    for (const VisitMoment& moment : visit.moments) {
        lists.ms.push_back(moment.ms);
        if (before != nullptr && before->is_there && moment.seen) {
            take_lag(lists, *before, moment);
        }
        before = &moment;
        lists.there += moment.is_there ? 1.0 : 0.0;
        lists.seen += moment.is_there && moment.seen ? 1.0 : 0.0;
        if (moment.is_there && moment.seen) {
            take_eye(lists, visit.prop_m, moment);
            offs_mm.push_back(1e3 * (shown_middle_m(visit.prop_m, moment.eye_m, moment.shown_eye_m) -
                                     shown_middle_m(visit.prop_m, moment.eye_m, moment.eye_m)));
        }
    }
    take_jitter(lists, offs_mm);
}

} // namespace

VisitorFigures measure(const VisitorCase& of, std::size_t visits, std::uint64_t seed) {
    Lists lists;
    for (std::size_t k = 0; k < visits; ++k) {
        take(lists, run_visit(of, visit_s, seed + k));
    }
    VisitorFigures figures{.name = of.name, .visits = visits};
    const auto eyes = static_cast<double>(lists.off_mm.size());
    figures.seen = lists.seen / std::fmax(1.0, lists.there);
    figures.jitter_mm = std::sqrt(lists.jitter_squares / std::fmax(1.0, lists.jitters));
    figures.said = std::sqrt(lists.said_squares / std::fmax(1.0, eyes));
    figures.lag_ms = 1e3 * lists.behind / std::fmax(1e-9, lists.gone);
    for (const auto& [list, pair] : {std::pair(&lists.off_mm, figures.off_mm),
                                     {&lists.azimuth_deg, figures.azimuth_deg},
                                     {&lists.picture_mm, figures.picture_mm},
                                     {&lists.ms, figures.ms}}) {
        pair[0] = quantile(*list, 0.5);
        pair[1] = quantile(*list, 0.95);
    }
    return figures;
}

WrongPresence measure_empty(const VisitorCase& of, double minutes, std::uint64_t seed) {
    const Visit visit = run_empty(of, 60.0 * minutes, seed);
    WrongPresence wrong{of.name, minutes / 60.0, 0.0, 0.0};
    bool before = false;
    for (const VisitMoment& moment : visit.moments) {
        wrong.times += moment.seen && !before ? 1.0 / wrong.hours : 0.0;
        wrong.share += moment.seen ? 1.0 / static_cast<double>(visit.moments.size()) : 0.0;
        before = moment.seen;
    }
    return wrong;
}

} // namespace frustumscreen::simulators

#include "tests/simulators/visitor/visitor_figures.h"

#include <fmt/format.h>

#include <iterator>

namespace frustumscreen::simulators {

namespace {

/// The usual case with one change.
VisitorCase usual_but(const std::string& name, const std::function<void(VisitorCase&)>& change) {
    VisitorCase one;
    one.name = name;
    change(one);
    return one;
}

void add_people_cases(std::vector<VisitorCase>& cases) {
    cases.push_back(usual_but("a child", [](VisitorCase& one) { one.build = Build::Child; }));
    cases.push_back(usual_but("seated", [](VisitorCase& one) { one.build = Build::Seated; }));
    cases.push_back(usual_but("long hair", [](VisitorCase& one) { one.hair = Hair::Long; }));
    cases.push_back(usual_but("a hat", [](VisitorCase& one) { one.hair = Hair::Hat; }));
    cases.push_back(usual_but("three people", [](VisitorCase& one) { one.people = 3; }));
    cases.push_back(usual_but("walks at 0.3 m/s", [](VisitorCase& one) { one.walks_m_s = 0.3; }));
    cases.push_back(usual_but("two walk by behind", [](VisitorCase& one) { one.passers_by = 2; }));
}

void add_light_cases(std::vector<VisitorCase>& cases) {
    cases.push_back(
        usual_but("a dark room, 0.15 of the light", [](VisitorCase& one) { one.light.room = 0.12; }));
    cases.push_back(usual_but("the picture three times as bright as the room", [](VisitorCase& one) {
        one.light = {0.25, 2.0};
    }));
    cases.push_back(
        usual_but("daylight comes and goes by a fifth", [](VisitorCase& one) { one.lamps_drift = 0.2; }));
    cases.push_back(usual_but("a third of the light is switched off before",
                              [](VisitorCase& one) { one.lamps_switched = true; }));
}

void add_camera_cases(std::vector<VisitorCase>& cases) {
    cases.push_back(usual_but("noise three times as large", [](VisitorCase& one) {
        one.camera.read_noise *= 3.0;
        one.camera.shot_noise *= 9.0;
    }));
    cases.push_back(usual_but("the camera's aim is off by half a degree",
                              [](VisitorCase& one) { one.camera_off_deg = 0.5; }));
    cases.push_back(
        usual_but("camera 0.25 m above the table", [](VisitorCase& one) { one.camera.place_m.z = 0.25; }));
    cases.push_back(usual_but("camera beside the projector, 1.4 m above the far edge", [](VisitorCase& one) {
        one.camera.place_m = {0.0, 0.5, 1.4};
        one.camera.aim_m = {0.0, -0.6, 0.5};
    }));
}

} // namespace

std::vector<VisitorCase> visitor_cases() {
    std::vector<VisitorCase> cases{usual_but("as usual", [](VisitorCase&) {})};
    add_people_cases(cases);
    add_light_cases(cases);
    add_camera_cases(cases);
    return cases;
}

std::vector<VisitorCase> empty_cases() {
    std::vector<VisitorCase> cases{usual_but("the picture changes", [](VisitorCase&) {})};
    add_light_cases(cases);
    cases.push_back(usual_but("two walk by behind", [](VisitorCase& one) { one.passers_by = 2; }));
    cases.push_back(
        usual_but("a coat is hung beside the table", [](VisitorCase& one) { one.coat_s = 10.0; }));
    return cases;
}

std::string table_of(const std::vector<VisitorFigures>& figures) {
    std::string text =
        "| scene | seen | eye off across, mm, median | 95 % | azimuth, degrees, median | 95 % | picture, mm, "
        "median | 95 % | jitter, mm RMS | error / said | lag, ms | ms a frame | 95 % |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const VisitorFigures& one : figures) {
        fmt::format_to(std::back_inserter(text),
                       "| {} | {:.1f} % | {:.0f} | {:.0f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.2f} | "
                       "{:.1f} | {:.1f} | "
                       "{:.1f} | {:.1f} |\n",
                       one.name, 100.0 * one.seen, one.off_mm[0], one.off_mm[1], one.azimuth_deg[0],
                       one.azimuth_deg[1], one.picture_mm[0], one.picture_mm[1], one.jitter_mm, one.said,
                       one.lag_ms, one.ms[0], one.ms[1]);
    }
    return text;
}

std::string csv_of(const std::vector<VisitorFigures>& figures) {
    std::string text =
        "scene,visits,seen,median_mm,p95_mm,azimuth_median_deg,azimuth_p95_deg,picture_median_mm,"
        "picture_p95_mm,jitter_mm,error_by_said,lag_ms,median_ms,p95_ms\n";
    for (const VisitorFigures& one : figures) {
        fmt::format_to(std::back_inserter(text), "\"{}\",{},{},{},{},{},{},{},{},{},{},{},{},{}\n", one.name,
                       one.visits, one.seen, one.off_mm[0], one.off_mm[1], one.azimuth_deg[0],
                       one.azimuth_deg[1], one.picture_mm[0], one.picture_mm[1], one.jitter_mm, one.said,
                       one.lag_ms, one.ms[0], one.ms[1]);
    }
    return text;
}

std::string table_of(const std::vector<WrongPresence>& figures) {
    std::string text =
        "| nobody there | minutes | wrong presence, times an hour | share of the time |\n|---|---|---|---|\n";
    for (const WrongPresence& one : figures) {
        fmt::format_to(std::back_inserter(text), "| {} | {:.0f} | {:.1f} | {:.2f} % |\n", one.name,
                       60.0 * one.hours, one.times, 100.0 * one.share);
    }
    return text;
}

std::string csv_of(const std::vector<WrongPresence>& figures) {
    std::string text = "scene,hours,times_an_hour,share\n";
    for (const WrongPresence& one : figures) {
        fmt::format_to(std::back_inserter(text), "\"{}\",{},{},{}\n", one.name, one.hours, one.times,
                       one.share);
    }
    return text;
}

} // namespace frustumscreen::simulators

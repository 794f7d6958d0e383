#include "tests/simulators/tags/tag_figures.h"

#include <fmt/format.h>

#include <iterator>

namespace frustumscreen::simulators {

namespace {

using Change = std::function<void(TagCase&)>;

/// The usual case with one change.
TagCase usual_but(const std::string& name, const Change& change) {
    TagCase one;
    one.name = name;
    change(one);
    return one;
}

void add_tag_cases(std::vector<TagCase>& cases) {
    for (const std::size_t tags : {1U, 2U, 3U}) {
        cases.push_back(usual_but(fmt::format("{} tag{}", tags, tags > 1 ? "s" : ""),
                                  [tags](TagCase& one) { one.tags = tags; }));
    }
    cases.push_back(usual_but("1 tag of 80 mm", [](TagCase& one) {
        one.tags = 1;
        one.skirt.tag_m = 0.08;
    }));
    for (const double mm : {20.0, 40.0}) {
        cases.push_back(usual_but(fmt::format("tags of {:g} mm", mm),
                                  [mm](TagCase& one) { one.skirt.tag_m = 1e-3 * mm; }));
    }
    cases.push_back(
        usual_but("skirt sloped by 35 degrees", [](TagCase& one) { one.skirt.slope_deg = 35.0; }));
    for (const double metres : {1.0, 1.8, 2.5}) {
        cases.push_back(usual_but(fmt::format("camera at {:g} m", metres),
                                  [metres](TagCase& one) { one.distance_m = metres; }));
    }
}

void add_light_cases(std::vector<TagCase>& cases) {
    for (const double room : {0.2, 0.05}) {
        cases.push_back(usual_but(fmt::format("room's light {:g} of the brightest", room),
                                  [room](TagCase& one) { one.light.room = room; }));
    }
    for (const double times : {0.5, 1.0, 3.0}) {
        cases.push_back(usual_but(fmt::format("picture on the tags, {:g} times the room's light", times),
                                  [times](TagCase& one) {
                                      one.light = {0.2, times * 0.2};
                                  }));
    }
    for (const double px : {1.2, 2.0}) {
        cases.push_back(usual_but(fmt::format("defocus {:g} px", px),
                                  [px](TagCase& one) { one.camera.defocus_px = px; }));
    }
    cases.push_back(usual_but("noise three times as large", [](TagCase& one) {
        one.camera.read_noise *= 3.0;
        one.camera.shot_noise *= 9.0;
    }));
}

void add_motion_cases(std::vector<TagCase>& cases) {
    const auto add = [&cases](double speed, double turn, double exposure_ms, double rolling_ms) {
        const std::string shutter = rolling_ms > 0.0 ? fmt::format("rolling {:g} ms", rolling_ms) : "global";
        cases.push_back(usual_but(fmt::format("{:g} m/s, {:g} degrees/s, exposure {:g} ms, {} shutter", speed,
                                              turn, exposure_ms, shutter),
                                  [=](TagCase& one) {
                                      one.speed_m_s = speed;
                                      one.turn_deg_s = turn;
                                      one.camera.exposure_ms = exposure_ms;
                                      one.camera.rolling_ms = rolling_ms;
                                  }));
    };
    add(0.1, 0.0, 5.0, 0.0);
    add(0.3, 0.0, 5.0, 0.0);
    add(0.3, 0.0, 15.0, 0.0);
    add(0.0, 90.0, 5.0, 0.0);
    add(0.1, 0.0, 5.0, 25.0);
    add(0.3, 0.0, 5.0, 25.0);
    add(0.0, 90.0, 5.0, 25.0);
    add(0.3, 90.0, 15.0, 25.0);
    for (std::size_t k = cases.size() - 4, end = cases.size(); k < end; ++k) {
        cases.push_back(with_known_shutter(cases[k]));
    }
}

} // namespace

TagCase with_known_shutter(TagCase rolling) {
    rolling.name += ", taken out";
    rolling.is_shutter_known = true;
    return rolling;
}

std::vector<TagCase> tag_cases() {
    std::vector<TagCase> cases{usual_but("as usual", [](TagCase&) {})};
    cases.push_back(usual_but("a table full of small squares", [](TagCase& one) { one.light.busy = true; }));
    add_tag_cases(cases);
    add_light_cases(cases);
    add_motion_cases(cases);
    return cases;
}

std::string table_of(const std::vector<TagFigures>& figures) {
    std::string text =
        "| scene | tags found | followed | mm, median | 95 % | worst | said | degrees, median | 95 % | "
        "error / said | find ms | 95 % | fit ms |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const TagFigures& one : figures) {
        fmt::format_to(
            std::back_inserter(text),
            "| {} | {:.1f} | {:.0f} % | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} | "
            "{:.1f} | {:.1f} | {:.2f} |\n",
            one.name, one.tags, 100.0 * one.trusted, one.off_mm[0], one.off_mm[1], one.worst_mm, one.said_mm,
            one.off_deg[0], one.off_deg[1], one.normalised, one.find_ms[0], one.find_ms[1], one.fit_ms);
    }
    return text;
}

std::string csv_of(const std::vector<TagFigures>& figures) {
    std::string text =
        "scene,pictures,posed,followed,tags,median_mm,p95_mm,worst_mm,said_mm,median_deg,p95_deg,"
        "error_by_said,find_ms,find_p95_ms,fit_ms\n";
    for (const TagFigures& one : figures) {
        fmt::format_to(std::back_inserter(text), "\"{}\",{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                       one.name, one.pictures, one.posed, one.trusted, one.tags, one.off_mm[0], one.off_mm[1],
                       one.worst_mm, one.said_mm, one.off_deg[0], one.off_deg[1], one.normalised,
                       one.find_ms[0], one.find_ms[1], one.fit_ms);
    }
    return text;
}

} // namespace frustumscreen::simulators
